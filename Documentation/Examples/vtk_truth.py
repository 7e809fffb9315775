# SPDX-License-Identifier: BSD-3-Clause
"""Exact ground truth of a renderer that somebody has: no window, no display, nothing drawn before."""
import dgtk
import numpy as np
import vtk

sphere = vtk.vtkSphereSource()
sphere.SetThetaResolution(40)
sphere.SetPhiResolution(40)
mapper = vtk.vtkPolyDataMapper()
mapper.SetInputConnection(sphere.GetOutputPort())
ball = vtk.vtkActor()
ball.SetMapper(mapper)
renderer = vtk.vtkRenderer()
renderer.AddActor(ball)

truth = dgtk.truth(renderer, ["depth", "objects", "cells", "normal", "color"], size=(320, 240))
seen = truth["objects"] == 1
print("the ball covers", seen.sum(), "pixels; its nearest point is", truth["depth"][seen].min(), "away")
print("K =", truth.K.tolist(), " t =", truth.t.tolist())
assert truth.props[0] is ball

pixels = dgtk.visible_cells(renderer, size=(320, 240))[0]
print((pixels > 0).sum(), "of", len(pixels), "cells are seen")
assert pixels.sum() == seen.sum()

# the pixels of a sphere's points, by the camera's matrices
x = (np.array([0, 0, 0.5]) @ truth.R.T + truth.t) @ truth.K.T
print("the pole of the sphere is at pixel", x[:2] / x[2])
