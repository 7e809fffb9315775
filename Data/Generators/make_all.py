#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes every file of Data/Models, Data/Scenes and Data/Textures.

    python3 Data/Generators/make_all.py             writes what is missing or differs
    python3 Data/Generators/make_all.py --check     says what differs; exit status 1 if something does
"""

import pathlib
import sys

import models_appendix
import models_head
import models_moving
import models_other
import models_parts
import models_plants
import models_still
import models_street
import models_tableware
import models_targets
import models_windmill
import pictures
import scenes
import scenes_abilities
import scenes_datasets
import scenes_images
import scenes_noise
import textures

DATA = pathlib.Path(__file__).resolve().parent.parent


def products():
    """(path below Data, contents) of every file."""
    for name, make in textures.ALL.items():
        yield f"Textures/{name}", pictures.png(make())
    for name, make in (("tuxedo", models_appendix.tuxedo_skin), ("face", models_appendix.face_skin), ("head", models_head.head_skin)):
        yield f"Textures/{name}.png", pictures.png(make())
    yield "Textures/heights.png", pictures.png(scenes_images.heights())
    yield "Textures/evening.hdr", scenes_images.evening()
    yield "Textures/speckles.png", pictures.png(models_targets.speckle_picture())
    yield "Models/creature.png", pictures.png(models_moving.creature_skin())
    yield "Models/rocket.png", pictures.png(models_other.rocket_skin())
    yield "Models/flag.pcx", pictures.pcx(models_moving.flag_skin())
    for make in (models_still.table, models_still.crate, models_still.ball, models_still.house, models_still.ground, models_still.floor,
                 models_still.room, models_plants.tree, models_plants.fir, models_plants.grass, models_plants.reeds, models_targets.chessboard,
                 models_targets.speckled_wall, models_targets.speckled_box, models_targets.speckled_ball, models_parts.bolt, models_parts.nut,
                 models_parts.bracket, models_parts.gear, models_parts.cup, models_parts.plate, models_parts.book, models_street.car,
                 models_street.van, models_street.road, models_street.sign):
        yield f"Models/{make.__name__}.ac", make()
    for make in (models_tableware.bowl, models_tableware.bottle, models_tableware.torus, models_tableware.brick, models_tableware.bin_):
        yield f"Models/{make.__name__.rstrip('_')}.ac", make()
    yield "Models/terrain.acc", models_still.terrain()
    for make in (models_moving.creature, models_moving.flag):
        yield f"Models/{make.__name__}.md2", make()
    for make in (models_other.rocket, models_other.chair):
        yield f"Models/{make.__name__}.3ds", make()
    for make in (models_other.vase, models_head.head):
        yield f"Models/{make.__name__}.pov", make()
    column, material = models_other.obj_column()
    yield "Models/column.obj", column
    yield "Models/column.mtl", material
    yield "Models/windmill.gltf", models_windmill.windmill()
    for make in (models_appendix.tuxedo, models_appendix.world):
        yield f"Scenes/{make.__name__}.ac", make()
    for name, make in (scenes.FILES | scenes_abilities.FILES | scenes_datasets.FILES | scenes_images.FILES | scenes_noise.FILES).items():
        yield f"Scenes/{name}", make()


def same(path, contents):
    if not path.is_file():
        return False
    there = path.read_bytes()
    if path.suffix == ".png" and there != contents:
        return pictures.png_contents(there) == pictures.png_contents(contents)
    return there == contents


def main(arguments):
    check = arguments == ["--check"]
    if arguments and not check:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    pictures.LEVEL = 1 if check else 9  # what they hold is compared
    differing, made = [], set()
    for name, contents in products():
        contents = contents.encode() if isinstance(contents, str) else contents
        path = DATA / name
        made.add(path)
        if same(path, contents):
            continue
        differing.append(name)
        if not check:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(contents)
    stray = [str(p.relative_to(DATA)) for folder in ("Models", "Scenes", "Textures") for p in sorted((DATA / folder).glob("*"))
             if p not in made]
    for name in differing:
        print(("differs: " if check else "written: ") + name)
    for name in stray:
        print("not made by a generator: " + name)
    print(f"{len(made)} files, {len(differing)} {'different' if check else 'written'}")
    return 1 if check and (differing or stray) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
