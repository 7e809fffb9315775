# SPDX-License-Identifier: BSD-3-Clause
"""DGTk: images and exact ground truth of described 3D scenes.

    import dgtk
    scene = dgtk.load("scene.json")
    depth = dgtk.render(scene, "depth", camera="left", frame=3)   # numpy, height x width, float64
    dgtk.generate(scene, "out", layers=["color", "depth"], frames=(0, 9))
    color = dgtk.dataset("out").read("color", camera="left", frame=3)

Classes whose names begin with dgtk are VTK's and can be used as such.
"""
import sys

from ._build import EXECUTABLE, PYTHON, VERSION

__version__ = VERSION
__all__ = ["load", "scene", "Scene", "sample", "random", "render", "generate", "dataset", "Dataset", "export", "exporters", "truth", "Truth", "snapshot", "Snapshot", "correspond", "visible_cells",
           "dgtkScene", "dgtkSceneSampler", "dgtkRenderer", "dgtkLayerOutputs", "dgtkDatasetGenerator", "dgtkDatasetReader", "dgtkDatasetExporter", "dgtkSnapshot", "dgtkGroundTruthSource", "dgtkPointCloudSource",
           "dgtkDepthFromZBuffer"]

if sys.version_info[:2] != PYTHON:
    raise ImportError("dgtk %s is for Python %d.%d (%s), this is %d.%d (%s)" % (VERSION, *PYTHON, EXECUTABLE, *sys.version_info[:2], sys.executable))
try:
    from ._dataset import Dataset, dataset
    from ._export import export, exporters
    from ._generate import generate
    from ._render import render
    from ._sample import random, sample
    from ._scenes import Scene, load, scene
    from ._vtk import Snapshot, Truth, correspond, snapshot, truth, visible_cells
    from .dgtkFromVTK import dgtkDepthFromZBuffer, dgtkGroundTruthSource, dgtkPointCloudSource, dgtkSnapshot
    from .dgtkPipeline import dgtkDatasetExporter, dgtkDatasetGenerator, dgtkDatasetReader, dgtkLayerOutputs, dgtkRenderer, dgtkScene, dgtkSceneSampler
except ImportError as error:
    raise ImportError("dgtk %s needs NumPy and VTK as %s has them (Debian: python3-numpy, python3-vtk9), this is %s: %s"
                      % (VERSION, EXECUTABLE, sys.executable, error)) from None
