# SPDX-License-Identifier: BSD-3-Clause
"""DGTk: images and exact ground truth of described 3D scenes.

    import dgtk
    scene = dgtk.load("scene.json")
    depth = dgtk.render(scene, "depth", camera="left", frame=3)   # numpy, height x width, float64

dgtkScene and dgtkRenderer are VTK classes and can be used as such.
"""
from .dgtkPipeline import dgtkRenderer, dgtkScene

__all__ = ["dgtkRenderer", "dgtkScene", "load", "render"]


def load(path):
    """Returns the loaded dgtkScene; raises ValueError with one line when the file cannot be used."""
    scene = dgtkScene()
    if not scene.Load(str(path)):
        raise ValueError(scene.GetErrorMessage())
    return scene


def render(scene, layers, camera=None, frame=None, size=None, samples=1, visibility="auto", gl="auto", renderer=None):
    """Renders one layer, or several, of one camera at one frame.

    layers: a name ("depth"), or a list of names, then a dict is returned.
    size: (width, height) in pixels. renderer: a dgtkRenderer to use again, which saves loading the scene's geometry.
    Returns numpy arrays of height x width (x channels); raises RuntimeError with one line on failure.
    """
    from vtkmodules.util.numpy_support import vtk_to_numpy

    renderer = renderer or dgtkRenderer()
    renderer.SetScene(scene)
    renderer.SetCamera(camera or scene.GetCameraName(0))
    renderer.SetFrame(scene.GetFirstFrame() if frame is None else frame)
    renderer.SetSize(*(size or (0, 0)))
    renderer.SetSamples(samples)
    renderer.SetVisibility(visibility)
    renderer.SetGL(gl)
    images = {}
    for layer in [layers] if isinstance(layers, str) else layers:
        array = renderer.Render(layer)
        if array is None:
            raise RuntimeError(renderer.GetErrorMessage())
        shape = (renderer.GetHeight(), renderer.GetWidth())
        if array.GetNumberOfComponents() > 1:
            shape += (array.GetNumberOfComponents(),)
        images[layer] = vtk_to_numpy(array).reshape(shape)
    return images[layers] if isinstance(layers, str) else images
