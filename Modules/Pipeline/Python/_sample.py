# SPDX-License-Identifier: BSD-3-Clause
"""Plain scenes of random ones, and random numbers that are functions of their names."""
import json
import warnings

from . import _check
from ._scenes import _plain
from .dgtkPipeline import dgtkSceneSampler

_SEEDS = 1 << 53
_NATURAL = range(1 << 31)


def _seed(value):
    return _check.integer("seed", value, range(_SEEDS), "an integer from 0 to 2**53 - 1")


def sample(scene, number, seed=None, folder=None):
    """Draws one plain scene of a scene with random values, as `dgtk sample` does.

    scene: a dict as in a .json file with random values (Documentation/UserGuide/sampling.md), or the path of such a
    file. number: the sample's, from 0 to 999999. seed: instead of the scene's, from 0 to 2**53 - 1. folder: where the
    relative paths of a dict start; default: the current folder.

        plain = dgtk.sample("table.json", 700)
        depth = dgtk.render(dgtk.scene(plain), "depth")

    Returns a dict that `scene()` takes; its relative paths start in the current folder. It is a function of scene,
    seed and number alone. An object or a camera whose rule cannot be kept, and that the sample goes without, is a warning.
    Raises ValueError, one line with the value that cannot be used, or with the rule that cannot
    be kept in this sample, and RuntimeError for what the machine cannot do.
    """
    sampler = dgtkSceneSampler()
    if isinstance(scene, dict):
        text = json.dumps(_plain(scene, ""), allow_nan=False)
        loaded = sampler.LoadText(text, _check.absolute("folder", "." if folder is None else folder))
    else:
        if folder is not None:
            _check.fail("folder", "none beside a file", folder)
        loaded = sampler.Load(_check.path("scene", scene))
    sampler.SetSeed(-1 if seed is None else _seed(seed))
    if not loaded or not sampler.Draw(_check.integer("number", number), _check.absolute("folder", ".")):
        _check.raise_error(sampler)
    for line in sampler.GetLeftOut().splitlines():
        warnings.warn(f"left out: {line}", stacklevel=2)
    return json.loads(sampler.GetDescription())


def random(seed, sample, path, draw=0):
    """A uniform random number in [0, 1): a function of its arguments alone, on every machine.

    seed: from 0 to 2**53 - 1. sample: a sample's number, from 0 to 2**31 - 1. path: what the number is for, any text but an
    empty one. draw: from 0 to 2**31 - 1, where one thing needs several numbers. A value `{"uniform": [0, 1]}` of object
    `cup` at key `scale` of a scene is `random(seed, sample, "objects/cup/scale")`.

    Returns a float. Raises ValueError for arguments out of these ranges.
    """
    number = _check.integer("sample", sample, _NATURAL, "an integer from 0 to 2**31 - 1")
    which = _check.integer("draw", draw, _NATURAL, "an integer from 0 to 2**31 - 1")
    name = _check.text("path", path, "a text without a character 0")
    return dgtkSceneSampler.Uniform(_seed(seed), number, name, which)
