# SPDX-License-Identifier: BSD-3-Clause
"""Pages of man(7), from rows."""

STATUS = (("0", "everything asked for was done"), ("1", "a check found a difference"), ("2", "wrong usage"),
          ("3", "input that cannot be used"), ("4", "the machine cannot do it"),
          ("75", "the run was interrupted, or another process is at work on it: the same command may be tried again"))


def text(words):
    """Words as they are to be read: nothing of them is a request, dashes are dashes, lists may break after commas."""
    shown = words.replace("\\", "\\e").replace("-", "\\-").replace("~", "\\(ti").replace("^", "\\(ha").replace(",", ",\\:")
    shown = shown.replace(",\\: ", ", ").replace("|", "|\\:")
    return "\\&" + shown if shown.startswith((".", "'")) else shown


def bold(words):
    return f"\\fB{text(words)}\\fR"


def italic(words):
    return f"\\fI{text(words)}\\fR"


def title(name, version):
    return f'.\\" Made by Apps/Pages/make_pages.py from the rows of the program.\n.TH {text(name.upper())} 1 "" "{text(version)}" "DGTk"\n.nh\n.ad l\n'


def section(name, body):
    return f".SH {name}\n{body}"


def item(tag, body):
    return f".TP\n{tag}\n{text(body)}\n"


def reference(names):
    return ",\n".join(f"{bold(name)}(1)" for name in names) + "\n"


def summary(help_):
    """A sentence as the line of a NAME section: its first clause, without a stop."""
    line = help_.rstrip(".").split("; ")[0]
    return line[0].lower() + line[1:]


def choices(option):
    """The words that an option takes, where neither its value nor its help has them."""
    words = option.get("choices", [])
    told = (option["value"] + " " + option["help"]).replace("|", " ").replace(",", " ").split()
    if not words or all(word in told for word in words):
        return ""
    return (" Some of, with commas between them: " if option["many"] else " One of: ") + ", ".join(words) + "."


def option(row):
    names = ", ".join(bold(name) for name in (row.get("short"), row["name"]) if name)
    tag = names + (" " + italic(row["value"]) if row["value"] else "")
    help_ = row["help"][0].upper() + row["help"][1:] + "."
    default = f" Default: {row['default']}." if row["default"] else ""
    return item(tag, help_ + choices(row) + default)


def overview(help_, commands, version):
    usage, about = help_.split("\n\n")[:2]
    names = ["dgtk-" + command["command"] for command in commands]
    return (title("dgtk", version)
            + section("NAME", f"dgtk \\- {text(summary(about))}\n")
            + section("SYNOPSIS", f"{bold('dgtk')} {text(usage.replace('usage: dgtk ', ''))}\n.br\n"
                                  f"{bold('dgtk')} {italic('COMMAND')} {bold('--help')}\n.br\n{bold('dgtk --version')}\n")
            + section("DESCRIPTION", text(about) + "\nEach command has a page of its own.\n")
            + section("COMMANDS", "".join(item(f"{bold(name)}(1)", command["help"]) for name, command in zip(names, commands)))
            + section("EXIT STATUS", "".join(item(bold(number), what.capitalize() + ".") for number, what in STATUS))
            + section("SEE ALSO", reference(names + ["dgtk-editor"])))


def command(row, commands, layers, version):
    name = "dgtk-" + row["command"]
    page = (title(name, version)
            + section("NAME", f"{text(name)} \\- {text(summary(row['help']))}\n")
            + section("SYNOPSIS", f"{bold('dgtk ' + row['command'])} {italic(row['arguments'])} [options]\n")
            + section("DESCRIPTION", text(row["help"]) + "\n")
            + section("OPTIONS", "".join(map(option, row["options"]))))
    if any(layers[0]["layer"] in known.get("choices", []) for known in row["options"]):
        page += section("LAYERS", "".join(
            item(bold(layer["layer"]), f"{layer['description'][0].upper()}{layer['description'][1:]}. Files: {layer['formats']}.")
            for layer in layers))
    others = ["dgtk"] + ["dgtk-" + other["command"] for other in commands if other is not row]
    return (page + section("EXIT STATUS", f"As of\n{bold('dgtk')}(1).\n")
            + section("SEE ALSO", reference(others)))


def editor(rows, version):
    about = rows["paragraphs"][0]
    return (title("dgtk-editor", version)
            + section("NAME", f"dgtk\\-editor \\- {text(summary(about.split('. ')[0]))}\n")
            + section("SYNOPSIS", f"{bold('dgtk-editor')} {text(rows['usage'])}\n")
            + section("DESCRIPTION", text(about) + "\n")
            + section("OPTIONS", "".join(map(option, rows["options"])))
            + section("ENVIRONMENT", "\n.PP\n".join(map(text, rows["paragraphs"][1:])) + "\n")
            + section("SEE ALSO", reference(["dgtk", "dgtk-render"])))
