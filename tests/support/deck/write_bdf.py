# SPDX-License-Identifier: BSD-2-Clause
"""Writes cards of Nastran in small, large and free fields."""
import re


def real(value, width):
    """Returns a real number in at most `width` columns, with a point and as many digits as fit."""
    best = None
    for digits in range(17, 0, -1):
        text = f"{value:.{digits}g}"
        mantissa, _, exponent = text.partition("e")
        if "." not in mantissa:
            mantissa += "."
        short = re.sub(r"^(-?)0\.(?=\d)", r"\1.", mantissa)
        if exponent:
            short += f"{int(exponent):+d}"
        if len(short) <= width:
            best = short
            break
    assert best is not None, value
    return best


def _text(value, width):
    if isinstance(value, float):
        return real(value, width)
    return "" if value is None else str(value)


def small(name, *values):
    words = [_text(value, 8) for value in values]
    lines = []
    for at in range(0, max(len(words), 1), 8):
        head = name if at == 0 else "+"
        end = "+" if at + 8 < len(words) else ""
        row = "".join(f"{word:<8}" for word in words[at : at + 8])
        lines.append(f"{head:<8}{row:<64}{end}".rstrip())
    return "\n".join(lines) + "\n"


def large(name, *values):
    words = [_text(value, 16) for value in values]
    lines = []
    for at in range(0, max(len(words), 1), 4):
        head = f"{name}*" if at == 0 else "*"
        row = "".join(f"{word:>16}" for word in words[at : at + 4])
        lines.append(f"{head:<8}{row}".rstrip())
    return "\n".join(lines) + "\n"


def free(name, *values):
    words = [_text(value, 25) for value in values]
    lines = []
    for at in range(0, max(len(words), 1), 8):
        head = name if at == 0 else ""
        more = "," if at + 8 < len(words) else ""
        lines.append(",".join([head, *words[at : at + 8]]) + more)
    return "\n".join(lines) + "\n"


FORMS = {"small": small, "large": large, "free": free}
