# SPDX-License-Identifier: BSD-3-Clause
"""The built package `dgtk`, and small scenes for its tests."""
import os
import sys

from harness import SCENES, SOURCE

PACKAGES = os.path.join(os.environ["DGTK_BUILD"], "lib", "python3", "dist-packages")
sys.path.insert(0, PACKAGES)
import dgtk  # noqa: E402

DEMO = os.path.join(SCENES, "demo.json")
SIZE = (64, 48)
# VTK's own methods of every class, which its wrapper does not guard.
OF_VTK = {"IsA", "IsTypeOf", "NewInstance", "SafeDownCast", "GetNumberOfGenerationsFromBase", "GetNumberOfGenerationsFromBaseType"}


def square():
    """A small scene: one square in front of one camera."""
    return {"objects": [{"name": "floor", "model": os.path.join(SOURCE, "Data", "Models", "floor.ac")}],
            "cameras": [{"name": "above", "eye": [0, 3, 4], "lookAt": [0, 0, 0]}]}
