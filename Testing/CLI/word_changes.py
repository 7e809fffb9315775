# SPDX-License-Identifier: BSD-3-Clause
"""Documents with one word changed, left out or doubled, for the sweeps that look whether a referee sees it."""
import json
import re

from harness import WHOLE


def leaves(value, path=()):
    """(path, value) of all in a JSON document."""
    yield path, value
    for key, one in value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ():
        yield from leaves(one, path + (key,))


def kind_of(path):
    """Where alike things stand: places in lists of numbers and in lists of those count, others do not, nor do numbers as keys unless WHOLE."""
    return "/".join((key if WHOLE else re.sub(r"^\d+$", "#", key)) if isinstance(key, str) else str(key) if all(isinstance(one, int) for one in path[i:]) and len(path) - i <= 1 else "*"
                    for i, key in enumerate(path))


def other(value):
    if isinstance(value, bool):
        return not value
    if isinstance(value, (int, float)):
        return value + (1 if isinstance(value, int) else 1e-3 * max(1, abs(value)))
    return value + "x" if isinstance(value, str) else 7


def json_changes(document):
    """(what, changed document) of one of each kind: another value, a key less, a list's last entry twice or not at all."""
    text = json.dumps(document)
    seen = set()
    for path, value in leaves(document):
        changes = []
        if path and isinstance(path[-1], str):
            changes.append(("-", lambda parent, key: parent.pop(key)))
        if isinstance(value, list) and value and path:
            changes.append(("shorter ", lambda parent, key: parent[key].pop()))
            changes.append(("longer ", lambda parent, key: parent[key].append(parent[key][-1])))
            if isinstance(value[0], list):
                changes.append(("an empty list more ", lambda parent, key: parent[key].append([])))
        elif not isinstance(value, (list, dict)):
            changes.append(("", lambda parent, key: parent.__setitem__(key, other(parent[key]))))
        for how, change in changes:
            if how + kind_of(path) not in seen:
                seen.add(how + kind_of(path))
                copy = json.loads(text)
                parent = copy
                for key in path[:-1]:
                    parent = parent[key]
                change(parent, path[-1])
                yield how + kind_of(path), copy


def text_changes(name, text, most=40):
    """Words and lines; of many those at the beginning and some others."""
    words = list(re.finditer(r"[^\s,<>=\[\]\";:()]+", text))
    body = text.find("\n---\n") if name == "README.md" else len(text)
    for word in words[:most // 2] + words[most // 2::max(1, (2 * len(words) - most) // most)]:
        line = text[text.rfind("\n", 0, word.start()) + 1:]
        try:
            changed = repr(float(word[0]) + 1e-3 * max(1, abs(float(word[0])))) if "." in word[0] else str(int(word[0]) + 1)
        except ValueError:
            changed = word[0] + "x"
        what = "text" if word.start() > body >= 0 else "comment" if line.startswith("#") else word[0]
        yield what, text[:word.start()] + changed + text[word.end():]
    for number in [word for word in words if word.start() < body and re.fullmatch("-?[0-9.]+", word[0])][:3]:
        line = text[text.rfind("\n", 0, number.start()) + 1:]
        yield "comment" if line.startswith("#") else "a letter behind a number", text[:number.end()] + "x" + text[number.end():]
    lines = text.splitlines(True)
    for at in sorted({0, 1, 2, 3, len(lines) // 2, len(lines) - 1}.intersection(range(len(lines)))):
        what = "text" if len("".join(lines[:at])) > body >= 0 else "comment" if lines[at].startswith("#") else None
        yield what or f"-line {at + 1}", "".join(lines[:at] + lines[at + 1:])
        yield what or f"twice line {at + 1}", "".join(lines[:at + 1] + lines[at:])


def changes_of(name, data):
    if name.endswith((".json", ".gltf")):
        yield from ((what, json.dumps(one, ensure_ascii=False).encode()) for what, one in json_changes(json.loads(data)))
    elif name.endswith(".jsonl"):
        rows = data.decode().splitlines()
        yield from ((what, "\n".join([json.dumps(one), *rows[1:], ""]).encode()) for what, one in json_changes(json.loads(rows[0])))
        yield "-line", "\n".join([*rows[:-1], ""]).encode()
    elif name.endswith(".ply"):
        end = data.index(b"end_header")
        yield from ((what, text.encode() + data[end:]) for what, text in text_changes(name, data[:end].decode()))
    else:
        yield from ((what, text.encode()) for what, text in text_changes(name, data.decode()))
