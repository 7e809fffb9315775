#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws Documentation/DeveloperGuide/architecture.svg: the modules, each above what it uses.

usage: make_architecture.py
"""
import os

TARGET = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "DeveloperGuide", "architecture.svg")
COLUMN, ROW, GAP, LEFT, TOP = 80, 62, 8, 16, 44
ROWS = 13
BLUE, YELLOW, GREEN, PINK, GRAY, VIOLET = "#dbeafe", "#fde68a", "#bbf7d0", "#fbcfe8", "#e8e8e8", "#ddd6fe"
# name, what it holds, columns from and to, rows from and to (from the bottom), colour
BOXES = [
    ("Core", "errors, layers, files, hashes, threads", 0, 12, 0, 1, GRAY),
    ("Camera", "rays, projections", 0, 4, 1, 2, BLUE),
    ("Scene", ".scene, .json, key frames", 0, 4, 2, 3, BLUE),
    ("ModelIO", "models, readers", 4, 8, 1, 3, BLUE),
    ("Stage", "loaded scene, its state at a time", 0, 8, 3, 4, BLUE),
    ("Visibility", "hits per pixel, exact intersection, canonical tiles", 0, 6.5, 4, 5, YELLOW),
    ("RenderGL", "VTK / OpenGL: colour, ids", 0, 2.15, 5, 7, GREEN),
    ("RayTrace", "Embree: ids, queries", 2.15, 4.3, 5, 6, GREEN),
    ("Sampling", "random scenes", 2.15, 4.3, 6, 7, GREEN),
    ("GroundTruth", "values from hits", 4.3, 6.5, 5, 6, GREEN),
    ("SceneExport", "POV-Ray", 6.5, 8, 4, 6, GREEN),
    ("Sensor", "blur, noise", 8, 9.5, 1, 6, PINK),
    ("DatasetIO", "writers, readers, manifest", 9.5, 12, 1, 6, PINK),
    ("Layers", "what pictures are given out as: layers, options, plan", 4.3, 10, 6, 7, VIOLET),
    ("Pipeline", "bands, threads, files, resume, VTK classes, Python", 0, 10, 7, 8, VIOLET),
    ("Verification", "also on Stage", 10, 11.1, 6, 8, VIOLET),
    ("Report", "one page", 11.1, 12, 6, 8, VIOLET),
    ("Document", "what the editor edits", 5, 8.5, 8, 9, VIOLET),
    ("Live", "ground truth while editing", 0, 5, 8, 9, VIOLET),
    ("Controls", "state, small widgets", 5, 8.5, 9, 10, VIOLET),
    ("Views", "3D views, handles", 0, 5, 9, 11, VIOLET),
    ("Panels", "properties, time line", 5, 6.75, 10, 12, VIOLET),
    ("Runs", "renders into files", 6.75, 8.5, 10, 12, VIOLET),
    ("Viewer", "datasets", 0, 2.5, 11, 12, VIOLET),
    ("Matches", "live truth, matches", 2.5, 5, 11, 12, VIOLET),
    ("Windows", "the editor's main window", 0, 8.5, 12, 13, VIOLET),
    ("FromVTK", "VTK renderers", 8.5, 10, 8, 13, VIOLET),
]


def main():
    width, height = 2 * LEFT + 12 * COLUMN, TOP + ROWS * ROW + LEFT
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="DejaVu Sans, Arial, sans-serif">',
             '<rect width="100%" height="100%" fill="white"/>',
             f'<text x="{LEFT}" y="28" font-size="15" fill="#333">Each box rests on what it uses. Python stands on Pipeline, '
             'the program dgtk also on Verification, dgtk-editor on Windows.</text>']
    for name, holds, left, right, bottom, top, colour in BOXES:
        x, y = LEFT + left * COLUMN + GAP / 2, TOP + (ROWS - top) * ROW + GAP / 2
        w, h = (right - left) * COLUMN - GAP, (top - bottom) * ROW - GAP
        middle = y + h / 2
        lines += [f'<rect x="{x:g}" y="{y:g}" width="{w:g}" height="{h:g}" rx="6" fill="{colour}" stroke="#555"/>',
                  f'<text x="{x + w / 2:g}" y="{middle:g}" text-anchor="middle" font-size="17" fill="#111">{name}</text>',
                  f'<text x="{x + w / 2:g}" y="{middle + 18:g}" text-anchor="middle" font-size="11" fill="#444">{holds}</text>']
    with open(TARGET, "w", encoding="utf-8") as file:
        file.write("\n".join(lines + ["</svg>", ""]))


main()
