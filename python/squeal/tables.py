# SPDX-License-Identifier: BSD-2-Clause
"""Reads the tables of a run, and checks them against their schema."""
import csv
import io
import re

import numpy as np
import pandas as pd

from squeal.files import ResultsError, read_text
from squeal.schema import schema_of

NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
OPEN = re.compile(r"[+-]?(nan|inf)")  # where there is no estimate
WHOLE = re.compile(r"-?\d+")
KINDS = {"number": "a number", "whole": "a whole number", "flag": "0 or 1"}
LONGEST = 40  # of a cell in a message


def read_table(path, shape=None):
    """Returns a table with its cells as texts, and as numbers.

    `shape` holds the columns and the number of rows, from the summary of the run. Raises
    ResultsError, with file, line, column and rule, for a table that breaks its schema.
    """
    texts = _texts_of(path)
    _require_shape(path, texts, shape)
    table = schema_of(path.stem)
    if table is None:
        return texts, texts
    _require_columns(path, texts, table, whole=shape is not None)
    values = pd.DataFrame(
        {name: _values(path, name, texts[name], table.column(name)) for name in texts},
        columns=list(texts),
    )
    _require_together(path, texts, table)
    _require_counted(path, texts, table)
    return texts, values


def _texts_of(path):
    """Returns the cells as texts. A lost field would look like an empty one."""
    try:
        text = read_text(path)
    except FileNotFoundError:
        raise ResultsError(f"{path} is missing") from None
    try:
        rows = list(csv.reader(io.StringIO(text, newline=""), strict=True))
    except csv.Error as error:
        raise ResultsError(f"{path}: {error}") from None
    if not rows or not rows[0]:
        raise ResultsError(f"{path}: the line with the names of the columns is missing")
    short = next(
        (number for number, row in enumerate(rows, 1) if len(row) != len(rows[0])),
        len(rows) if not text.endswith("\n") else None,
    )
    if short:
        raise ResultsError(
            f"{path}: line {short} is cut: it has {len(rows[short - 1])} of {len(rows[0])} fields,"
            " or no end"
        )
    twice = next((name for name in rows[0] if rows[0].count(name) > 1), None)
    if twice is not None:
        raise ResultsError(f"{path}: two columns have the name {_shown(twice)}")
    return pd.DataFrame(rows[1:], columns=rows[0], dtype=object)


def _require_shape(path, texts, shape):
    if shape is None:
        return
    missing = [name for name in shape["columns"] if name not in texts]
    if missing:
        raise ResultsError(
            f"{path}: there is no column {', '.join(missing)}, which the run has written"
        )
    if list(texts) != shape["columns"]:
        raise ResultsError(
            f"{path}: its columns are not those that the run has written,"
            f" {', '.join(shape['columns'])}"
        )
    if len(texts) != shape["rows"]:
        raise ResultsError(
            f"{path} is cut: it has {len(texts)} rows, summary.json lists {shape['rows']}"
        )


def _require_columns(path, texts, table, whole):
    needed = [
        column.name
        for column in table.columns
        if (whole or column.read) and "{}" not in column.name
    ]
    missing = [name for name in needed if name not in texts]
    if missing:
        raise ResultsError(f"{path}: there is no column {', '.join(missing)}")
    unknown = next((name for name in texts if table.column(name) is None), None)
    if unknown is not None:
        raise ResultsError(f"{path}: the column {_shown(unknown)} is in no table of this name")


def _values(path, name, texts, column):
    """Returns the values of a column and checks them. Most tables are short: plain lists take a
    tenth of the time of Series."""
    cells = texts.tolist()
    blank = np.array([text == "" for text in cells], bool)
    if column.kind == "word":
        wrong = np.zeros(len(cells), bool) if column.empty else blank
        if column.words:
            wrong = wrong | ~(np.array([text in column.words for text in cells], bool) | blank)
        _refuse(
            path,
            texts,
            wrong,
            column,
            f"is none of the words {', '.join(column.words)}" if column.words else "is empty",
        )
        return texts.where(~blank, np.nan) if blank.any() else texts
    kind = {"whole": WHOLE, "flag": re.compile("[01]")}.get(column.kind, NUMBER)
    unbounded = np.array([bool(column.open and OPEN.fullmatch(text)) for text in cells], bool)
    good = np.array([kind.fullmatch(text) is not None for text in cells], bool) | unbounded
    _refuse(path, texts, ~good & ~(blank & column.empty), column, f"is not {KINDS[column.kind]}")
    values = np.array([float(text or "nan") for text in cells], float)
    _refuse(path, texts, np.isinf(values) & ~unbounded, column, "is beyond the largest number")
    _refuse(path, texts, values < column.least, column, f"is below {column.least:g}")
    _refuse(path, texts, values > column.most, column, f"is above {column.most:g}")
    return pd.Series(
        values.astype(int) if column.kind != "number" and not blank.any() else values, texts.index
    )


def _refuse(path, texts, wrong, column, rule):
    if wrong.any():
        at = int(np.argmax(wrong))
        unit = f" in {column.unit}" if column.unit else ""
        raise ResultsError(
            f"{path}, line {at + 2}, column {texts.name}{unit}: {_shown(texts.iloc[at])} {rule}"
        )


def _require_together(path, texts, table):
    for names in table.together:
        names = [name for name in names if name in texts]
        for name in names[1:]:
            differ = (texts[name] == "") != (texts[names[0]] == "")
            if differ.any():
                raise ResultsError(
                    f"{path}, line {int(np.argmax(differ.to_numpy())) + 2}: {names[0]} and"
                    f" {name} are empty together, or neither is"
                )


def _require_counted(path, texts, table):
    names = [name for name in table.counted if name in texts]
    if not names or names[-1] != table.counted[-1]:
        return
    *keys, counter = names
    expected = (
        texts.groupby(keys, sort=False).cumcount() + 1
        if keys
        else pd.Series(np.arange(1, len(texts) + 1), texts.index)
    )
    differ = texts[counter].map(int).ne(expected) if len(texts) else pd.Series([], dtype=bool)
    if differ.any():
        at = int(np.argmax(differ.to_numpy()))
        raise ResultsError(
            f"{path}, line {at + 2}, column {counter}: {texts[counter].iloc[at]} follows where"
            f" {expected.iloc[at]} has to: rows are lost or doubled"
        )


def _shown(text):
    text = text if len(text) <= LONGEST else text[: LONGEST - 1] + "…"
    return repr(text)


__all__ = ["read_table"]
