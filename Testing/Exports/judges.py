# SPDX-License-Identifier: BSD-3-Clause
"""Other people's tools that Debian does not package, or that are too large for every machine: a test is skipped, with the reason, where they are not."""
import json
import os
import shutil
import subprocess


def by_node(case, modules, script, *arguments):
    """What a script of Node writes, as JSON. Modules are found below NODE_PATH, where `npm install` put them."""
    node = shutil.which("node")
    if not node:
        case.skipTest("Node.js is not installed")
    for module in modules:
        if subprocess.run([node, "-e", "require.resolve(process.argv[1])", module], capture_output=True).returncode != 0:
            case.skipTest(f"Node.js finds no module {module}: npm install {module}, and name its node_modules in NODE_PATH")
    done = subprocess.run([node, "-e", script, *map(str, arguments)], capture_output=True, text=True, timeout=250)
    case.assertEqual(done.returncode, 0, done.stderr[-2000:])
    return json.loads(done.stdout)


def by_blender(case, script, *arguments):
    """What a script of Blender prints behind the word RESULT, as JSON; DGTK_BLENDER names the program."""
    blender = os.environ.get("DGTK_BLENDER") or shutil.which("blender")
    if not blender:
        case.skipTest("Blender is not installed")
    path = case.write("script.py", script)
    done = subprocess.run([blender, "--background", "--factory-startup", "--python-exit-code", "1", "--python", path, "--", *map(str, arguments)],
                          capture_output=True, text=True, timeout=600)
    case.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])
    [line] = [line for line in done.stdout.splitlines() if line.startswith("RESULT ")]
    return json.loads(line.split(" ", 1)[1])
