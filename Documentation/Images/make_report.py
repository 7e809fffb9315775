#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes report.png beside it: the page of `dgtk report`, as Chromium shows it.

    build/release/bin/dgtk render Data/Scenes/demo.json -o build/demo --layers all --size 640x480
    build/release/bin/dgtk report build/demo -o build/report.html
    Documentation/Images/make_report.py build/report.html
"""
import pathlib
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "Testing" / "CLI"))
from browser import Browser  # noqa: E402


def main(arguments):
    if len(arguments) != 1:
        sys.exit(__doc__)
    with Browser(1280, 820) as browser:
        browser.open(arguments[0])
        browser.until("document.querySelectorAll('.shot img').length > 0")
        browser.evaluate("[...document.querySelectorAll('#layers button')][1].click()")
        browser.evaluate("document.documentElement.style.scrollBehavior = 'auto'; document.getElementById('pictures').scrollIntoView()")
        x, y = browser.evaluate("(() => { const box = document.querySelector('.hold').getBoundingClientRect(); return [box.left + 0.7 * box.width, box.top + 0.4 * box.height]; })()")
        browser.mouse(x, y)
        browser.until("document.getElementById('readout').textContent.includes('depth: ')")
        time.sleep(0.5)
        browser.picture(str(HERE / "report.png"))


main(sys.argv[1:])
