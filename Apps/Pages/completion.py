# SPDX-License-Identifier: BSD-3-Clause
"""Completions of bash, from rows. They need nothing but bash itself."""

HEAD = """# Completion of {program} in bash. Made by Apps/Pages/make_pages.py from the rows of the program.
"""

COMMON = r"""
# One of the words.
_dgtk_words()
{
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$word")
}

# Some of the words, separated by commas, none of them twice.
_dgtk_many()
{
  local before=
  [[ $word == *,* ]] && before=${word%,*},
  local choice
  COMPREPLY=()
  for choice in $1; do
    [[ ,$before == *,$choice,* || $choice != "${word##*,}"* ]] || COMPREPLY+=("$before$choice")
  done
  compopt -o nospace 2> /dev/null || :
}

_dgtk_files()
{
  compopt -o filenames 2> /dev/null || :
  mapfile -t COMPREPLY < <(compgen -f -- "$word")
}

_dgtk_folders()
{
  compopt -o filenames 2> /dev/null || :
  mapfile -t COMPREPLY < <(compgen -d -- "$word")
}

# `word`: what is being typed; `option`: the word before it, also where '=' joins them.
_dgtk_split()
{
  word=${COMP_WORDS[COMP_CWORD]}
  option=${COMP_WORDS[COMP_CWORD - 1]}
  if [[ $word == "=" ]]; then
    word=
  elif [[ $option == "=" && $COMP_CWORD -gt 2 ]]; then
    option=${COMP_WORDS[COMP_CWORD - 2]}
  fi
}
"""


def value(option):
    """What completes the value of an option; None for a switch."""
    if not option["value"]:
        return None
    words = " ".join(option.get("choices", []))
    if words:
        return f'{"_dgtk_many" if option["many"] else "_dgtk_words"} "{words}"'
    names = option["value"].split("|")
    if any(name.startswith("FILE") for name in names):
        return "_dgtk_files"
    return "_dgtk_folders" if "DIR" in names else ":"


def names(option):
    return [name for name in (option.get("short"), option["name"]) if name]


def cases(prefix, options):
    lines = ""
    for option in options:
        does = value(option)
        if does:
            pattern = " | ".join(prefix + name for name in names(option))
            lines += f"    {pattern}) {does}; return ;;\n"
    return lines


def all_names(options):
    return " ".join(name for option in options for name in names(option))


def argument(text):
    """What completes the arguments of a command: "[a|b]" are words, "DIR" a folder, all else files."""
    if text.startswith("["):
        return f'_dgtk_words "{text.strip("[]").replace("|", " ")}"'
    return "_dgtk_folders" if text == "DIR" else "_dgtk_files"


def of_commands(commands):
    words = " ".join(command["command"] for command in commands)
    values = "".join(cases(command["command"] + ":", command["options"]) for command in commands)
    options = "".join(f'    {command["command"]}:-*) _dgtk_words "{all_names(command["options"])}" ;;\n' for command in commands)
    arguments = "".join(f'    {command["command"]}:*) {argument(command["arguments"])} ;;\n' for command in commands)
    return HEAD.format(program="dgtk") + COMMON + f"""
_dgtk()
{{
  local word option
  _dgtk_split
  COMPREPLY=()
  if [[ $COMP_CWORD -eq 1 ]]; then
    _dgtk_words "{words} --help --version"
    return
  fi
  case ${{COMP_WORDS[1]}}:$option in
{values}  esac
  case ${{COMP_WORDS[1]}}:$word in
{options}{arguments}  esac
}}
complete -F _dgtk dgtk
"""


def of_editor(rows):
    return HEAD.format(program="dgtk-editor") + COMMON.replace("_dgtk_", "_dgtk_editor_") + f"""
_dgtk_editor()
{{
  local word option
  _dgtk_editor_split
  COMPREPLY=()
  case $option in
{cases("", rows["options"]).replace("_dgtk_", "_dgtk_editor_")}  esac
  case $word in
    -*) _dgtk_editor_words "{all_names(rows["options"])}" ;;
    *) _dgtk_editor_files ;;
  esac
}}
complete -F _dgtk_editor dgtk-editor
"""
