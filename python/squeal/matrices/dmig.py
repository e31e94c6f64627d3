# SPDX-License-Identifier: BSD-2-Clause
"""Matrices of Nastran's DMIG cards, from punch files or decks, in small, large and free field.

DMIG, NAME, 0, IFO, TIN, TOUT, POLAR, , NCOL heads a matrix: IFO is 1 (square), 6 (symmetric, each
entry given once) or 9 (rectangular, columns in the order of their nodes and components; 2 is the
same with numbers of columns; only these have an NCOL); TIN is 1 or 2 for real entries, 3 or 4 for
complex ones. The columns follow: DMIG, NAME, GJ, CJ, , G1, C1, A1, B1 and continued G2, C2, A2, B2
and so on. Source: MSC Nastran Quick Reference Guide and Altair OptiStruct Reference Guide, DMIG.

Punch files are in large field: after the first line of a card, each line that begins with a star is
one entry. numpy reads these lines; the others are read one by one.
"""
import re

import numpy as np

from squeal.deck.journal import Fault
from squeal.matrices.coordinate import TRIANGLE, WHOLE, Matrix
from squeal.matrices.labels import LARGEST_NODE, keys_of
from squeal.matrices.text import Lines, integers_of, read_bytes, reals_of

NAME = "Nastran DMIG"
FORMS = {1: WHOLE, 6: TRIANGLE, 9: WHOLE}
CARD = re.compile(rb"^[ \t]*DMIG[*, \t]", re.M | re.I)


def is_deck(data):
    """Returns whether there is a DMIG card."""
    return CARD.search(data) is not None


def read(path, wanted):
    """Returns the matrix of a name. Raises Fault."""
    data = read_bytes(path)
    if b"\t" in data:
        data = data.expandtabs(8)
    cards = _Cards(Lines(data))
    name = cards.name_of(wanted)
    header = cards.headers[name]
    if header.complex:
        raise Fault(f"{name}: complex matrices are not supported", line=header.line)
    if header.form not in FORMS or (header.form == 9 and header.width):
        reason = f"IFO {header.form} is unknown"
        if header.form in (2, 9):
            reason = "a rectangular matrix (IFO 2, or NCOL) has numbers of columns, not their nodes"
        raise Fault(f"{name}: {reason}", line=header.line)
    rows, columns, values = cards.entries(name)
    found = Matrix(NAME, rows, columns, values, None, FORMS[header.form], name)
    others = [one for one in cards.headers if one != name]
    if others:
        found.remarks.append(f"other matrices of the file are not used: {', '.join(others)}")
    for card, count in cards.unused.items():
        found.remarks.append(f"{count} cards {card} are not used")
    return found


class _Header:
    def __init__(self, fields, line):
        """`fields`: those after the name, as text."""
        numbers = [_integer(fields, place, line, 0) for place in (1, 2, 3, 4, 6)]
        self.form, kind, _, polar, self.width = numbers
        if kind not in (1, 2, 3, 4):
            raise Fault(f"TIN {kind} is not a type of numbers", line=line)
        self.complex = kind > 2 or polar != 0
        self.line = line


def _integer(fields, place, line, blank=None):
    word = fields[place].strip() if place < len(fields) else ""
    if not word and blank is not None:
        return blank
    if not re.fullmatch(r"[+-]?\d{1,15}", word):
        raise Fault(f"'{word}' is not an integer number", line=line)
    return int(word)


class _Cards:
    """The cards of a file: headers by name, and the columns with their entries."""

    def __init__(self, text):
        self.text = text
        self.headers, self.unused = {}, {}
        self.columns = []  # name, key, line of each card of a column
        self.odd = []  # card, entry as words, line: entries not in large field
        first = text.codes[np.minimum(text.starts, len(text.codes) - 1)]
        self.starred = (first == 42) & (text.ends > text.starts)  # continued in large field
        if text.data.count(b","):
            commas = np.flatnonzero(text.codes == 44)
            self.starred &= np.diff(np.searchsorted(commas, text.starts), append=len(commas)) == 0
        self.owner = np.full(len(text), -1)  # of starred lines: a card
        self._read()

    def _read(self):
        plain = np.flatnonzero(~self.starred)
        after = np.append(plain[1:], len(self.text))
        if len(plain) == 0 or plain[0] > 0:
            raise Fault("a continuation without its card", line=1)
        state = None  # the card that continues: ("column", number), ("header", …), or None
        for line, end in zip(plain.tolist(), after.tolist()):
            words = self.text.text(line)
            if words.strip() and not words.startswith("$"):
                state = self._line(words, line, end, state)
            if end - line > 1 and (not words.strip() or words.startswith("$")):
                self._continued(state, line + 1, end)

    def _line(self, words, line, end, state):
        """Reads a line that is not starred, and returns what a continuation continues."""
        if words[0] in " +*," and state is not None:
            if state[0] == "column":
                self._odd_entries(state[1], _fields(words, line + 1)[1:], line)
                self._continued(state, line + 1, end)
            elif state[0] == "header":
                raise Fault("a header of more than two lines", line=line + 1)
            return state
        fields = _fields(words, line + 1)
        name = fields[0].strip().upper().rstrip("*")
        if name != "DMIG":
            if words[0] in "+*,":
                raise Fault("a continuation without its card", line=line + 1)
            self.unused[name] = self.unused.get(name, 0) + 1
            return ("unused", None)
        title = fields[1].strip().upper() if len(fields) > 1 else ""
        if not re.fullmatch(r"[A-Z]\w{0,7}", title):
            raise Fault(f"'{title}' is not a name of a matrix", line=line + 1)
        large = fields[0].strip().endswith("*")
        if _integer(fields, 2, line + 1) == 0:
            return self._header(title, fields, line, end, large)
        return self._column(title, fields, line, end, large)

    def _header(self, title, fields, line, end, large):
        if title in self.headers:
            raise Fault(f"a second header of {title}", line=line + 1)
        if large:
            if end - line > 2:
                raise Fault("a header of more than two lines", line=line + 3)
            fields = fields[:5] + (
                _fields(self.text.text(line + 1), line + 2)[1:] if end - line == 2 else []
            )
        elif end - line > 1:
            raise Fault("a continuation without its card", line=line + 2)
        self.headers[title] = _Header(fields[2:], line + 1)
        return ("header", None)

    def _column(self, title, fields, line, end, large):
        node, component = _integer(fields, 2, line + 1), _integer(fields, 3, line + 1, 0)
        if not (0 < node < LARGEST_NODE and 0 <= component <= 6):
            raise Fault(f"{node}, {component} is not a node and component", line=line + 1)
        self.columns.append((title, int(keys_of(node, component)), line + 1))
        if len(fields) > 4 and fields[4].strip():
            raise Fault(f"'{fields[4].strip()}' in field 5, which is empty", line=line + 1)
        state = ("column", len(self.columns) - 1)
        if not large:
            self._odd_entries(state[1], fields[5:], line)
        elif any(one.strip() for one in fields[5:]):
            raise Fault("more than four fields", line=line + 1)
        self._continued(state, line + 1, end)
        return state

    def _continued(self, state, begin, end):
        """Gives starred lines to the card that they continue."""
        if end > begin and (state is None or state[0] == "header"):
            raise Fault("a continuation without its card", line=begin + 1)
        if end > begin and state[0] == "column":
            self.owner[begin:end] = state[1]

    def _odd_entries(self, card, fields, line):
        for at in range(0, len(fields), 4):
            entry = [one.strip() for one in fields[at : at + 4]]
            if any(entry):
                self.odd.append((card, (entry + [""] * 3)[:4], line + 1))

    def name_of(self, wanted):
        names = list(self.headers)
        headless = next((one for one in self.columns if one[0] not in self.headers), None)
        if headless:
            raise Fault(f"{headless[0]} has no header", line=headless[2])
        if wanted and wanted.upper() not in names:
            raise Fault(f"the file has no matrix {wanted}; it has {', '.join(names) or 'none'}")
        if not wanted and len(names) != 1:
            words = f"the file has {len(names)} matrices"
            raise Fault(words + (f"; give one as FILE:NAME: {', '.join(names)}" if names else ""))
        return wanted.upper() or names[0]

    def entries(self, name):
        """Returns keys of rows and of columns, and the values of a matrix. Raises Fault."""
        mine = np.array([one[0] == name for one in self.columns], bool)
        keys = np.array([one[1] for one in self.columns], np.int64)
        lines = np.flatnonzero(self.owner >= 0)
        lines = lines[mine[self.owner[lines]]] if len(lines) else lines
        parts = [self._large(lines, keys)] if len(lines) else []
        odd = [one for one in self.odd if mine[one[0]]]
        if odd:
            parts.append(_small(odd, keys))
        filled = np.zeros(len(mine), bool)
        filled[self.owner[lines]] = True
        filled[[one[0] for one in odd]] = True
        if np.any(mine & ~filled):
            at = int(np.argmax(mine & ~filled))
            raise Fault("a column without entries", line=self.columns[at][2])
        if not parts:
            raise Fault(f"{name} has no entry")
        return tuple(np.concatenate(part) for part in zip(*parts))

    def _large(self, lines, keys):
        def line_of(at):
            return int(lines[at]) + 1

        nodes = integers_of(self.text.fields(lines, 8, 16), line_of)
        components = integers_of(self.text.fields(lines, 24, 16), line_of, blank=0)
        _require_point(nodes, components, line_of)
        values = reals_of(self.text.fields(lines, 40, 16), line_of)
        if np.any(self.text.ends[lines] - self.text.starts[lines] > 80):
            for line in lines[self.text.ends[lines] - self.text.starts[lines] > 80]:
                _fields(self.text.text(line), int(line) + 1)
        imaginary = np.char.strip(self.text.fields(lines, 56, 16)) != b""
        if np.any(imaginary):
            raise Fault("an imaginary part in a real matrix", line=line_of(np.argmax(imaginary)))
        return keys_of(nodes, components), keys[self.owner[lines]], values


def _small(odd, keys):
    lines = [one[2] for one in odd]

    def line_of(at):
        return lines[at]

    words = [np.array([one[1][at].encode("latin-1") or b" " for one in odd]) for at in range(4)]
    nodes, components = integers_of(words[0], line_of), integers_of(words[1], line_of, blank=0)
    _require_point(nodes, components, line_of)
    for at, word in enumerate(words[3]):
        if word.strip():
            raise Fault("an imaginary part in a real matrix", line=line_of(at))
    cards = np.array([one[0] for one in odd])
    return keys_of(nodes, components), keys[cards], reals_of(words[2], line_of)


def _require_point(nodes, components, line_of):
    wrong = (nodes < 1) | (nodes >= LARGEST_NODE) | (components < 0) | (components > 6)
    if np.any(wrong):
        at = int(np.argmax(wrong))
        raise Fault(f"{nodes[at]}, {components[at]} is not a node and component", line=line_of(at))


def _fields(words, line):
    """Returns the fields of a line, numbered from 1; the first is that of the name, the last one
    not a marker. Raises Fault for data after the last field."""
    if "," in words:
        fields = words.split(",")
        most = 5 if fields[0].strip().endswith("*") else 9
        marker, *rest = [one.strip() for one in fields[most:]] or [""]
        if any(rest) or re.match(r"[-.\d]|\+[.\d]", marker):
            raise Fault(f"more than {most} fields and a marker", line=line)
        return fields[:most]
    if words[80:].strip():
        raise Fault(f"'{words[80:].strip()[:40]}' after column 80", line=line)
    width = 16 if "*" in words[:8] else 8
    count = 64 // width
    return [words[:8]] + [words[8 + width * at : 8 + width * (at + 1)] for at in range(count)]
