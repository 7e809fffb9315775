# SPDX-License-Identifier: BSD-3-Clause
"""Depth out of a z-buffer that a window has drawn, with its half-width, beside the exact depth."""
import dgtk
import numpy as np
import vtk
from vtkmodules.util.numpy_support import vtk_to_numpy

source = vtk.vtkSphereSource()
source.SetThetaResolution(30)
source.SetPhiResolution(30)
mapper = vtk.vtkPolyDataMapper()
mapper.SetInputConnection(source.GetOutputPort())
actor = vtk.vtkActor()
actor.SetMapper(mapper)
renderer = vtk.vtkRenderer()
renderer.AddActor(actor)
window = vtk.vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetMultiSamples(0)
window.SetSize(120, 90)
window.AddRenderer(renderer)
window.Render()

grab = vtk.vtkWindowToImageFilter()
grab.SetInput(window)
grab.SetInputBufferTypeToZBuffer()
depth = dgtk.dgtkDepthFromZBuffer()
depth.SetInputConnection(grab.GetOutputPort())
depth.SetCamera(renderer.GetActiveCamera())
depth.Update()
arrays = depth.GetOutput().GetPointData()
z, half = (vtk_to_numpy(arrays.GetArray(name)).reshape(90, 120)[::-1] for name in ("depth", "half_width"))

exact = dgtk.truth(renderer, "depth")["depth"]
seen = np.isfinite(exact) & np.isfinite(z)
within = np.abs(z[seen] - exact[seen]) <= half[seen]
print(f"{within.mean():.2%} of {seen.sum()} depths are within their half-width, whose median is {np.median(half[seen]):.2g}")
assert within.mean() > 0.99
