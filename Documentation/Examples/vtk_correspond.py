# SPDX-License-Identifier: BSD-3-Clause
"""Dense correspondences of two moments of somebody's scene: the camera turns, and a part of an assembly moves."""
import dgtk
import numpy as np
import vtk

parts = []
for x, color in ((-0.4, (0.9, 0.3, 0.2)), (0.7, (0.2, 0.5, 0.9))):
    source = vtk.vtkCubeSource()
    source.SetCenter(x, 0, 0)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    part = vtk.vtkActor()
    part.SetMapper(mapper)
    part.GetProperty().SetColor(*color)
    parts.append(part)
arm = vtk.vtkAssembly()
for part in parts:
    arm.AddPart(part)
renderer = vtk.vtkRenderer()
renderer.AddActor(arm)
camera = renderer.GetActiveCamera()
camera.SetPosition(1.5, 1.2, 4)

before = dgtk.snapshot(renderer, size=(160, 120))
camera.Azimuth(10)
parts[1].SetPosition(0, 0.3, 0)
after = dgtk.snapshot(renderer, size=(160, 120))

xy, visibility = dgtk.correspond(before, after)
names = ["no surface", "visible", "hidden by another", "hidden by itself", "outside", "behind"]
for code, count in zip(*np.unique(visibility, return_counts=True)):
    print(f"{names[code]}: {count} pixels")
row, column = np.argwhere(visibility == 1)[0]
print(f"pixel ({column + 0.5}, {row + 0.5}) goes to ({xy[row, column, 0]:.3f}, {xy[row, column, 1]:.3f})")
assert (visibility == 1).sum() > 1000
