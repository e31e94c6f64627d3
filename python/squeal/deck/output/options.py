# SPDX-License-Identifier: BSD-2-Clause
"""Writes the options of a case; each line names the card that it comes from."""
import re

MARK = "# Made by squeal-import from"


def write_options(path, case, model, ignored):
    """`ignored`: names of what the user has left out, which the results of the case repeat. Raises
    OSError."""
    lines = [f"{MARK} {model.title} ({model.program}). The units are those of the deck."]
    if ignored:
        names = ", ".join(" ".join(name.split()) for name in ignored)
        case.set(("report", "note"), f"left out of {model.title} by --ignore: {names}")
    for prefix, options in case.options.items():
        lines += ["", f"{_plain(prefix)}:"]
        lines += _lines(options, 1)
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


def _lines(options, depth):
    lines = []
    for key, value in options.items():
        start = f"{'  ' * depth}{_plain(key)}:"
        if isinstance(value, dict):
            lines += [start, *_lines(value, depth + 1)]
            continue
        text, source = value
        line = f"{start} {_quoted(text)}"
        lines.append(f"{line}  # {source} {source.word}" if source else line)
    return lines


def _plain(key):
    return key if re.fullmatch(r"[A-Za-z_][\w.+-]*", key) else '"' + key + '"'


def _quoted(text):
    """Quotes a value that is not a plain word or number: lists, equations."""
    return text if re.fullmatch(r"[\w.+-]+", text) else '"' + text.replace('"', '\\"') + '"'
