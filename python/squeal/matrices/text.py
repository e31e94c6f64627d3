# SPDX-License-Identifier: BSD-2-Clause
"""Numbers of large text files, by numpy: lines of a fixed number of them, or fields of a fixed
width. Every byte is checked; nothing is skipped except comments, which the caller gets."""
import re
import warnings

import numpy as np

from squeal.deck.journal import Fault

CHUNK = 8 << 20
ALLOWED = b"0123456789+-.eEdD \t\r\n,"
PLAIN = bytes.maketrans(b",dD", b" EE")
EXPONENTS = bytes.maketrans(b"dDe", b"EEE")
SPACES = b" \t\r\n,"
IS_SPACE = bytes(one in SPACES for one in range(256))
NUMBER = re.compile(rb"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][+-]?\d+|[+-]\d+)?")
BARE_EXPONENT = re.compile(rb"(?<=[0-9.])(?=[+-])")  # 1.5-3 is 1.5E-3 in Fortran
CLASSES = bytes(1 if one in b"0123456789." else 2 if one in b"+-" else 0 for one in range(256))
LARGEST = 2**53


def read_bytes(path):
    """Returns the content of a file. Raises Fault."""
    try:
        with open(path, "rb") as file:
            return file.read()
    except OSError as error:
        raise Fault(error.strerror) from None


def tables(path, widths, marks, on_mark):
    """Yields tables of the numbers of a file, one row a line, and the numbers of the lines.
    `widths`: possible numbers of columns, the same for all lines. Lines that begin with a byte of
    `marks` go to on_mark(line, text). Raises Fault."""
    width, line = None, 1
    for chunk in _chunks(path):
        chunk = _without_marks(chunk, marks, on_mark, line)
        starts, counts = _tokens(chunk)
        filled = counts > 0
        if width is None and np.any(filled):
            width = int(counts[np.argmax(filled)])
            if width not in widths:
                place = line + int(np.argmax(filled))
                raise Fault(f"{width} numbers, not {_either(widths)}", line=place)
        _require_numbers(chunk, line)
        wrong = filled & (counts != width)
        if np.any(wrong):
            at = int(np.argmax(wrong))
            raise Fault(f"{counts[at]} numbers, not {width}", line=line + at)
        _require_commas(chunk, starts, width or widths[0], line)
        if np.any(filled):
            yield _numbers(chunk, len(starts), line).reshape(-1, width), line + np.flatnonzero(
                filled
            )
        line += len(counts)


def _either(widths):
    return " or ".join(str(one) for one in widths)


def _chunks(path):
    """Yields the file in chunks of whole lines. Raises Fault if its last line has no end."""
    rest, lines = b"", 0
    try:
        with open(path, "rb") as file:
            while piece := file.read(CHUNK):
                piece = rest + piece
                cut = piece.rfind(b"\n") + 1
                if cut:
                    lines += piece.count(b"\n")
                    yield piece[:cut]
                rest = piece[cut:]
                if len(rest) > CHUNK:
                    raise Fault("the line is not one of a text file", line=lines + 1)
    except OSError as error:
        raise Fault(error.strerror) from None
    if rest.strip():
        raise Fault("the file ends within a line: cut short", line=lines + 1)


def _without_marks(chunk, marks, on_mark, line):
    """Hands over the lines that begin with a mark, and blanks them out."""
    if not any(mark in chunk for mark in (bytes([one]) for one in marks)):
        return chunk
    chunk = bytearray(chunk)
    pattern = rb"^[ \t]*[" + re.escape(marks) + rb"][^\n]*"
    at = 0
    for match in list(re.finditer(pattern, bytes(chunk), re.M)):
        line += chunk.count(b"\n", at, match.start())
        at = match.start()
        on_mark(line, match.group().decode("latin-1").strip())
        chunk[match.start() : match.end()] = b" " * len(match.group())
    return bytes(chunk)


def _tokens(chunk):
    """Returns where numbers begin, and their count on each line."""
    space = np.frombuffer(chunk.translate(IS_SPACE), np.uint8)
    begins = np.flatnonzero(space[:-1] > space[1:]) + 1
    if not space[0]:
        begins = np.concatenate([[0], begins])
    ends = np.flatnonzero(np.frombuffer(chunk, np.uint8) == 10)
    return begins, np.diff(np.searchsorted(begins, ends), prepend=0)


def _require_numbers(chunk, line):
    if chunk.translate(None, ALLOWED):
        raise _fault_of(chunk, line)


def _fault_of(chunk, line):
    """Returns the fault of the first word that is not a number."""
    for number, text in enumerate(chunk.split(b"\n"), line):
        for word in re.split(rb"[ \t\r,]+", text):
            if word and not NUMBER.fullmatch(word):
                shown = word[:40].decode("latin-1")
                return Fault(f"{shown!r} is not a finite number", line=number)
            if word and not np.isfinite(float(_repaired(word.translate(PLAIN)))):
                return Fault(f"{word.decode()} is too large", line=number)
    return Fault("not a text of numbers", line=line)


def _require_commas(chunk, starts, width, line):
    """Requires a comma between all neighbours on each line, or none in the whole chunk."""
    if b"," not in chunk:
        return
    codes = np.frombuffer(chunk, np.uint8)
    commas = np.flatnonzero(codes == 44)
    starts = starts.reshape(-1, width)
    if len(commas) == len(starts) * (width - 1):
        commas = commas.reshape(-1, width - 1)
        if np.all((starts[:, :-1] < commas) & (commas < starts[:, 1:])):
            return
    for number, text in enumerate(chunk.split(b"\n"), line):
        fields = text.split(b",")
        if text.strip() and (len(fields) != width or not all(one.strip() for one in fields)):
            raise Fault("a field is empty, or a comma is missing", line=number)
    raise Fault("commas are missing", line=line)


def _repaired(text):
    bare = b"\1\2" in text.translate(CLASSES)  # faster than a search
    return BARE_EXPONENT.sub(b"E", text) if bare else text


def _numbers(chunk, count, line):
    text = _repaired(chunk.translate(PLAIN))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            found = np.fromstring(text, sep=" ")
        except (DeprecationWarning, ValueError):  # a word that is not a number
            raise _fault_of(chunk, line) from None
    if len(found) != count or not np.all(np.isfinite(found)):
        raise _fault_of(chunk, line)
    return found


def require_integers(table, columns, lines):
    """Returns columns of a table as integers. Raises Fault."""
    part = table[:, columns]
    wrong = (part != np.floor(part)) | (np.abs(part) >= LARGEST)
    if np.any(wrong):
        at = int(np.argmax(np.any(wrong, axis=1)))
        value = part[at][wrong[at]][0]
        raise Fault(f"{value:g} is not an integer number", line=int(lines[at]))
    return part.astype(np.int64)


class Lines:
    """The lines of a text in memory, for fields of fixed width."""

    def __init__(self, data):
        if not data.endswith(b"\n"):
            count = data.count(b"\n") + 1
            raise Fault("the file ends within a line: cut short", line=count)
        if b"\0" in data:
            count = data.count(b"\n", 0, data.index(b"\0")) + 1
            raise Fault("the line is not one of a text file", line=count)
        self.data = data
        self.codes = np.frombuffer(data, np.uint8)
        self.ends = np.flatnonzero(self.codes == 10)
        self.starts = np.concatenate([[0], self.ends[:-1] + 1])
        if b"\r" in data:
            self.ends = self.ends - (self.codes[np.maximum(self.ends - 1, 0)] == 13)
            self.ends = np.maximum(self.ends, self.starts)

    def __len__(self):
        return len(self.starts)

    def text(self, line):
        """Returns a line, numbered from 0."""
        return self.data[self.starts[line] : self.ends[line]].decode("latin-1")

    def fields(self, lines, offsets, width):
        """Returns the bytes of a field of each of some lines, filled up with blanks. `offsets`: one
        for all lines, or one for each."""
        begins = self.starts[lines] + offsets
        room = self.ends[lines] - begins
        if len(self.codes) < width or len(lines) == 0:
            return self._short_fields(begins, room, width)
        # The last bytes of the file cannot begin a field of this width.
        windows = np.lib.stride_tricks.sliding_window_view(self.codes, width)
        found = np.ascontiguousarray(windows[np.minimum(begins, len(windows) - 1)])
        found = found.view(f"S{width}").ravel()
        short = np.flatnonzero((room < width) | (begins >= len(windows)))
        found[short] = self._short_fields(begins[short], room[short], width)
        return found

    def _short_fields(self, begins, room, width):
        """Returns fields of which some are cut by the end of their line."""
        found = np.empty(len(begins), f"S{width}")
        for at in range(0, len(begins), 200000):
            part = slice(at, at + 200000)
            places = begins[part, None] + np.arange(width)
            taken = self.codes[np.minimum(places, len(self.codes) - 1)]
            taken[np.arange(width) >= room[part, None]] = 32
            found[part] = np.ascontiguousarray(taken).view(f"S{width}").ravel()
        return found

    def require_lengths(self, lines, lengths):
        """Raises Fault unless lines are as long as their numbers, which Fortran writes flush right,
        and blank after them."""
        lengths = np.broadcast_to(lengths, len(lines))
        have = self.ends[lines] - self.starts[lines]
        if np.any(have < lengths):
            line = int(lines[np.argmax(have < lengths)])
            raise Fault("the line is shorter than its numbers: cut short", line=line + 1)
        for at in np.flatnonzero(have > lengths):
            line = int(lines[at])
            rest = self.text(line)[int(lengths[at]) :]
            if rest.strip():
                raise Fault(f"'{rest.strip()[:40]}' follows the numbers", line=line + 1)

    def block(self, first, count, per_line, width):
        """Returns `count` fields of lines from `first` on, `per_line` of them on each, and the line
        after them. Raises Fault."""
        needed = -(-count // per_line)
        if first + needed > len(self):
            raise Fault("the file ends too early: cut short", line=len(self))
        lines = np.arange(first, first + needed)
        numbers = np.full(needed, per_line)
        if needed:
            numbers[-1] = count - per_line * (needed - 1)
        self.require_lengths(lines, numbers * width)
        found = np.empty((needed, per_line), f"S{width}")
        for at in range(per_line):
            found[:, at] = self.fields(lines, at * width, width)
        return found.ravel()[:count], first + needed


def reals_of(fields, line_of, scaled=False):
    """Returns the numbers of fields that Fortran wrote with a point. Blanks within a number and
    numbers without a point would have another meaning in Fortran, and with a scale factor (1P)
    those without an exponent. Raises Fault."""
    width = fields.dtype.itemsize
    fields = np.frombuffer(fields.tobytes().translate(EXPONENTS), fields.dtype)
    if len(fields) == 0:
        return np.zeros(0)
    codes = fields.view(np.uint8).reshape(-1, width)
    bare = np.any(((codes[:, 1:] == 43) | (codes[:, 1:] == 45)) & _digit(codes[:, :-1]), axis=1)
    if np.any(bare):
        fields = fields.astype(f"S{width + 1}")
        for at in np.flatnonzero(bare):
            fields[at] = _repaired(fields[at])
    wrong = ~np.any(codes == 46, axis=1)
    if not np.any(wrong) and not fields.tobytes().translate(None, b"0123456789+-.E \0"):
        try:
            found = fields.astype(float)
        except ValueError:
            found = np.full(len(fields), np.nan)
        if np.all(np.isfinite(found)):
            if scaled:
                _require_exponents(fields, found, line_of)
            return found
    for at, one in enumerate(fields):
        if not re.fullmatch(rb" *[+-]?(\d+\.\d*|\.\d+)(E[+-]?\d+)? *", one) or wrong[at]:
            shown = one.strip().decode("latin-1")
            raise Fault(f"'{shown}' is not a finite number with a point", line=line_of(at))
        if not np.isfinite(float(one)):
            raise Fault(f"{one.strip().decode()} is too large", line=line_of(at))
    raise Fault("a number cannot be read")


def _require_exponents(fields, found, line_of):
    codes = fields.view(np.uint8).reshape(len(fields), -1)
    wrong = ~np.any(codes == 69, axis=1) & (found != 0)
    if np.any(wrong):
        at = int(np.argmax(wrong))
        shown = fields[at].strip().decode()
        raise Fault(f"'{shown}' has no exponent, but the format a scale factor", line=line_of(at))


def _digit(codes):
    return ((codes >= 48) & (codes <= 57)) | (codes == 46)


def integers_of(fields, line_of, blank=None):
    """Returns the integers of fields; `blank`: the number of an empty field. Raises Fault."""
    if blank is not None:
        fields = fields.copy()
        fields[np.char.strip(fields) == b""] = str(blank).encode()
    if not fields.tobytes().translate(None, b"0123456789+- \0"):
        try:
            return fields.astype(np.int64)
        except (ValueError, OverflowError):
            pass
    for at, one in enumerate(fields):
        if not re.fullmatch(rb" *[+-]?\d{1,18} *", one):
            shown = one.strip().decode("latin-1")
            raise Fault(f"'{shown}' is not an integer number", line=line_of(at))
    raise Fault("an integer number is too large")
