#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes the pictures of the editor in the user guide, from the real window on a display without a screen.

usage: make_editor.py BUILD_FOLDER      writes editor*.png beside this script
"""
import os
import subprocess
import sys

if len(sys.argv) != 2:
    sys.exit(__doc__.strip())
build = os.path.abspath(sys.argv[1])
environment = dict(os.environ, DGTK_EDITOR_PICTURES=os.path.dirname(os.path.abspath(__file__)),
                   DGTK=os.path.join(build, "bin", "dgtk"), LIBGL_ALWAYS_SOFTWARE="1")
status = 0
for test in ("TestEditorWhole", "TestEditorExport", "TestEditorFiles", "TestEditorHandles", "TestEditorLook", "TestEditorSamples", "TestEditorTimeLine",
             "TestEditorTruth", "TestEditorViewer"):
    status |= subprocess.call(["xvfb-run", "-a", "-s", "-screen 0 1400x1000x24",
                               os.path.join(build, "bin", "TestEditor"), test, "pictures"], env=environment)
sys.exit(status)
