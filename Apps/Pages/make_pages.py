#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Man pages and bash completions, from the rows that the programs are made of: make_pages.py FOLDER DGTK [EDITOR].

DGTK is asked for `list commands --json`, `list layers --json` and its help, EDITOR for its help. FOLDER gets man/man1 and
bash-completion/completions. There is no clock in what is written.
"""
import json
import os
import subprocess
import sys

import completion
import manual


def said(program, *words):
    return subprocess.run([program, *words], check=True, capture_output=True, text=True).stdout


def write(path, text):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def editor_rows(page):
    """The help of the editor as a command has it: usage, paragraphs, rows "  --name VALUE   text" and what follows."""
    usage, *paragraphs = page.strip().split("\n\n")
    rows = {"usage": usage.replace("usage: dgtk-editor ", ""), "paragraphs": [], "options": []}
    for paragraph in paragraphs:
        if not paragraph.startswith("  --"):
            rows["paragraphs"].append(paragraph.replace("\n", " "))
            continue
        for line in paragraph.split("\n"):
            words, help_ = line.strip().split("  ", 1)
            name, _, value = words.partition(" ")
            rows["options"].append({"name": name, "value": value, "default": "", "help": help_.strip()})
    return rows


def main():
    folder, dgtk, *editor = sys.argv[1:]
    pages = os.path.join(folder, "man", "man1")
    completions = os.path.join(folder, "bash-completion", "completions")
    version = said(dgtk, "--version").strip().replace("dgtk ", "DGTk ")
    commands = json.loads(said(dgtk, "list", "commands", "--json"))["commands"]
    layers = json.loads(said(dgtk, "list", "layers", "--json"))["layers"]
    write(os.path.join(pages, "dgtk.1"), manual.overview(said(dgtk, "--help"), commands, version))
    for command in commands:
        write(os.path.join(pages, f"dgtk-{command['command']}.1"), manual.command(command, commands, layers, version))
    write(os.path.join(completions, "dgtk"), completion.of_commands(commands))
    for program in editor:
        rows = editor_rows(said(program, "--help"))
        write(os.path.join(pages, "dgtk-editor.1"), manual.editor(rows, version))
        write(os.path.join(completions, "dgtk-editor"), completion.of_editor(rows))


main()
