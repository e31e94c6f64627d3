# SPDX-License-Identifier: BSD-2-Clause
"""Reads binary OP4 files: records of Fortran, of either byte order, with words of 4 or 8 bytes."""
import struct

import numpy as np

from squeal.deck.journal import Fault
from squeal.matrices.op4 import Header, Strings, chosen
from squeal.matrices.text import read_bytes

HEADERS = {24: 4, 48: 8}  # bytes of the first record → bytes of a word


def byte_order(data):
    """Returns the byte order of a file that begins with a header, or None."""
    for order in "<>":
        if len(data) >= 4 and struct.unpack_from(order + "i", data)[0] in HEADERS:
            return order
    return None


def read(path, wanted):
    """Returns the matrix of a name. Raises Fault."""
    data = read_bytes(path)
    headers, at = [], 0
    while at < len(data):
        one = _Reader(data, at, byte_order(data))
        headers.append(one)
        at = one.skip()
    at = chosen([one.header for one in headers], wanted)
    headers[at].header.require_supported()
    others = [one.header.name for one in headers if one is not headers[at]]
    return headers[at].matrix(others)


class _Reader:
    """One matrix of a file; `at`: the byte of its header."""

    def __init__(self, data, at, order):
        self.data, self.order = data, order
        begin, end = self._record(at)
        if end - begin not in HEADERS:
            raise Fault(f"byte {at}: a record of {end - begin} bytes is not a header of a matrix")
        self.word = HEADERS[end - begin]
        self.kind = "i" if self.word == 4 else "q"
        numbers = struct.unpack_from(f"{order}4{self.kind}", data, begin)
        name = data[begin + 4 * self.word : end].translate(None, b" \0").decode("latin-1")
        self.header = Header(*numbers, name.upper())
        self.header.require_plausible()
        self.next = end + 4
        self.strings = Strings(self.header)

    def _record(self, at):
        """Returns the bytes from which and up to which the content of a record reaches."""
        if at + 4 > len(self.data):
            raise Fault(f"the file ends at byte {len(self.data)} within a matrix: cut short")
        (length,) = struct.unpack_from(self.order + "i", self.data, at)
        end = at + 4 + length
        if length < 0 or length % 4 or end + 4 > len(self.data):
            raise Fault(
                f"byte {at}: the record has {length} bytes, but the file only {len(self.data)}:"
                " cut short or damaged"
            )
        if self.data[at : at + 4] != self.data[end : end + 4]:
            raise Fault(f"byte {end}: the end of the record does not repeat its length")
        return at + 4, end

    def skip(self):
        """Finds the strings of the matrix, and returns the byte after it."""
        at, heading = self.next, struct.Struct(f"{self.order}3{self.kind}")
        while True:
            begin, end = self._record(at)
            if end - begin < heading.size:
                raise Fault(f"byte {at}: the record is too short for a column")
            column, row, words = heading.unpack_from(self.data, begin)
            if column > self.header.columns:
                break
            self._require(self.strings.begin_column, at, column)
            begin += heading.size
            if words < 1 or end - begin != words * self.word:
                raise Fault(f"byte {at}: {words} words in a record of {end - begin} bytes")
            if row > 0:
                self._add(begin, words, row)
            else:
                self._sparse(begin, words)
            at = end + 4
        if column != self.header.columns + 1:
            raise Fault(f"byte {at}: column {column} of {self.header.columns}")
        return end + 4

    def _sparse(self, at, words):
        heading = struct.Struct(f"{self.order}{2 if self.header.wide else 1}{self.kind}")
        while words > 0:
            if self.header.wide:
                if words < 2:
                    raise Fault(f"byte {at}: a string of entries does not fit into its column")
                length, row = heading.unpack_from(self.data, at)
                length -= 1
                words -= length + 2
            else:
                (packed,) = heading.unpack_from(self.data, at)
                length, row = packed // 65536 - 1, packed % 65536
                words -= length + 1
            if length < 1 or words < 0:
                raise Fault(f"byte {at}: a string of entries does not fit into its column")
            at += heading.size
            self._add(at, length, row)
            at += length * self.word

    def _add(self, at, words, row):
        per_value = (2 if self.header.type % 2 == 0 and self.word == 4 else 1) * (
            2 if self.header.type > 2 else 1
        )
        if words % per_value:
            raise Fault(f"byte {at}: {words} words are not a whole number of entries")
        self._require(self.strings.add, at, at, words // per_value, row)

    def _require(self, call, at, *words):
        try:
            call(*words)
        except Fault as fault:
            raise Fault(f"byte {at}: {fault.reason}") from None

    def matrix(self, others):
        string, within = self.strings.within()
        single = self.header.type == 1 and self.word == 4
        places = np.array(self.strings.places, np.int64) // 4  # records are of whole words
        words = np.frombuffer(self.data, np.uint32, len(self.data) // 4)
        if single:
            values = words[places[string] + within].view(f"{self.order}f4").astype(float)
        else:
            pairs = np.empty((len(string), 2), np.uint32)
            pairs[:, 0] = words[places[string] + 2 * within]
            pairs[:, 1] = words[places[string] + 2 * within + 1]
            values = pairs.view(f"{self.order}f8").ravel().astype(float)
        if not np.all(np.isfinite(values)):
            at = int(np.argmax(~np.isfinite(values)))
            byte = int(places[string[at]] + within[at] * (1 if single else 2)) * 4
            raise Fault(f"byte {byte}: an entry is not a finite number")
        return self.strings.matrix(string, within, values, others)
