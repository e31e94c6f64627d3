# SPDX-License-Identifier: BSD-2-Clause
"""Fills the templates of web/: pages of one file that open offline in a browser."""
import json
import math
import re
from pathlib import Path

import numpy as np

WEB = Path(__file__).resolve().parents[2] / "web"


def fill(template, parts):
    """Returns the text of a template of web/ with its parts in place of {{name}}."""
    text = (WEB / template).read_text()
    return re.sub(r"\{\{(\w+)\}\}", lambda match: parts[match[1]], text)


def script_element(text):
    """A script element with JavaScript that cannot end it."""
    safe = text.replace("</", "<\\/").replace("<!--", "<\\!--")
    return f"<script>\n{safe}</script>"


def data_text(data):
    """Returns data as JSON that cannot end the element that holds it."""
    return json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")


def plain(value):
    """Returns a value without the numbers that JSON lacks."""
    return None if isinstance(value, float) and not math.isfinite(value) else value


def columns(table, without=()):
    """Returns a table as lists by column, without complex numbers; None for none."""
    if table is None:
        return None
    return {
        name: [plain(value) for value in column.tolist()]
        for name, column in table.items()
        if name not in without and not np.iscomplexobj(column)
    }


__all__ = ["WEB", "columns", "data_text", "fill", "plain", "script_element"]
