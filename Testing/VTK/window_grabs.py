# SPDX-License-Identifier: BSD-3-Clause
"""Windows of VTK without a place on the display, and what they draw."""
import vtk
from vtkmodules.util.numpy_support import vtk_to_numpy

SIZE = (200, 150)


def window(*renderers, size=SIZE):
    made = vtk.vtkRenderWindow()
    made.SetOffScreenRendering(1)
    made.SetMultiSamples(0)
    made.SetSize(*size)
    for renderer in renderers:
        made.AddRenderer(renderer)
    return made


def grabbed(shown):
    shown.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(shown)
    grab.ReadFrontBufferOff()
    return grab


def drawn(shown):
    grab = grabbed(shown)
    grab.Update()
    image = grab.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[::-1, :, :3]
