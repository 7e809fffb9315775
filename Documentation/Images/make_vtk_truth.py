#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes vtk_truth.png: a scene of VTK, what its window draws, and its ground truth. Needs a display (xvfb-run).

usage: make_vtk_truth.py PACKAGES      the folder that holds the package dgtk
"""
import os
import sys

import numpy

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [sys.argv[1], HERE, os.path.join(HERE, "..", "..", "Testing", "VTK")]
import dgtk
import vtk
from vtkmodules.util.numpy_support import vtk_to_numpy

import png_files
import scenes

SIZE = (240, 200)


def window(renderer):
    shown = vtk.vtkRenderWindow()
    shown.SetOffScreenRendering(1)
    shown.SetMultiSamples(0)
    shown.SetSize(*SIZE)
    shown.AddRenderer(renderer)
    renderer.ResetCameraClippingRange()
    shown.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(shown)
    grab.ReadFrontBufferOff()
    grab.Update()
    return vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars()).reshape(SIZE[1], SIZE[0], -1)[::-1, :, :3]


def hues(numbers):
    """A colour a number; black for none."""
    angle = numpy.asarray(numbers)[..., None] * 2.4 + numpy.array([0, 2.1, 4.2])
    return numpy.where(numpy.asarray(numbers)[..., None] > 0, 140 + 110 * numpy.sin(angle), 0).astype(numpy.uint8)


def main():
    renderer = scenes.robot_arm()
    renderer.SetBackground(0.15, 0.15, 0.2)
    truth = dgtk.truth(renderer, ["color", "objects", "cells", "depth"], size=SIZE)
    before = dgtk.snapshot(renderer, size=SIZE)
    drawn = window(renderer)
    seen = numpy.isfinite(truth["depth"])
    low, high = truth["depth"][seen].min(), truth["depth"][seen].max()
    depth = numpy.where(seen, 250 - 200 * (truth["depth"] - low) / (high - low), 0).astype(numpy.uint8)
    renderer.GetActiveCamera().Azimuth(25)
    _, classes = dgtk.correspond(before, dgtk.snapshot(renderer, size=SIZE))
    palette = numpy.array([[0, 0, 0], [70, 170, 90], [200, 70, 60], [230, 160, 60], [110, 110, 220], [90, 90, 90]], numpy.uint8)
    tiles = [drawn, truth["color"], hues(truth["objects"]), hues(truth["cells"] + 1), numpy.repeat(depth[..., None], 3, -1), palette[classes]]
    png_files.write(os.path.join(HERE, "vtk_truth.png"), numpy.concatenate(tiles, 1))


main()
