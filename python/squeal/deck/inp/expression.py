# SPDX-License-Identifier: BSD-2-Clause
"""Arithmetic expressions of *PARAMETER: numbers, names, + - * / **, parentheses and functions."""
import math
import operator
import re

from squeal.deck.journal import Fault
from squeal.deck.numbers import LARGEST

TOKEN = re.compile(r"\s*(?:((?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|([A-Za-z_]\w*)|(\*\*|[-+*/(),]))")
FUNCTIONS = {
    **{name: getattr(math, name) for name in ("sin", "cos", "tan", "asin", "acos", "atan")},
    **{name: getattr(math, name) for name in ("sqrt", "exp", "log", "log10")},
    "abs": abs,
}
DEEPEST = 50  # nested parentheses, signs and powers
LONGEST = 2000  # characters


def evaluate(text, values):
    """Returns the number that an expression is; `values`: those of names. Raises Fault."""
    if len(text) > LONGEST:
        raise Fault(f"an expression has at most {LONGEST} characters")
    reader = _Reader(text, values)
    try:
        result = reader.sum(0)
    except (ArithmeticError, ValueError):
        raise Fault(f"'{text.strip()}' is not a finite number") from None
    if reader.word is not None:
        raise Fault(f"'{text.strip()}': '{reader.word}' is not expected")
    return result


def _checked(value):
    """An integer that is too large for a real number is one of its own accord."""
    if isinstance(value, complex) or not abs(value) < 1e300:
        raise ValueError
    return float(value) if abs(value) > LARGEST else value


def _divided(a, b):
    """Python 2 rounds the quotient of integers down, Python 3 does not."""
    if isinstance(a, int) and isinstance(b, int):
        if b and a % b:
            raise Fault(f"{a}/{b}: releases of Abaqus divide integers differently; write {a}./{b}.")
        return a // b
    return a / b


def _power(a, b):
    return a ** (b if isinstance(a, int) and isinstance(b, int) and 0 <= b < 400 else float(b))


class _Reader:
    """Reads one expression by recursive descent. `word`: the token that comes next, None at the
    end."""

    def __init__(self, text, values):
        self.text, self.values, self.at = text.rstrip(), values, 0
        self.word = self.number = None
        self._next()

    def _next(self):
        """Moves to the next token."""
        self.word = self.number = None
        if self.at >= len(self.text):
            return
        match = TOKEN.match(self.text, self.at)
        if not match:
            raise Fault(f"'{self.text.strip()}' is not arithmetic of numbers and parameters")
        self.at = match.end()
        self.word = match[1] or match[2] or match[3]
        if match[1]:
            self.number = int(match[1]) if match[1].isdigit() else float(match[1])

    def _take(self, *words):
        """Returns the next token if it is one of these, and moves on."""
        found = self.word if self.number is None and self.word in words else None
        if found is not None:
            self._next()
        return found

    def _require(self, word):
        if self._take(word) is None:
            raise Fault(f"'{self.text.strip()}': '{word}' is missing")

    def sum(self, depth):
        if depth > DEEPEST:
            raise Fault("the expression is nested too deeply")
        value = self._product(depth)
        while sign := self._take("+", "-"):
            other = self._product(depth)
            value = _checked((operator.add if sign == "+" else operator.sub)(value, other))
        return value

    def _product(self, depth):
        value = self._signed(depth)
        while sign := self._take("*", "/"):
            other = self._signed(depth)
            value = _checked((operator.mul if sign == "*" else _divided)(value, other))
        return value

    def _signed(self, depth):
        """A sign binds less than a power to its right, more than a product."""
        if depth > DEEPEST:
            raise Fault("the expression is nested too deeply")
        if sign := self._take("+", "-"):
            value = self._signed(depth + 1)
            return -value if sign == "-" else value
        value = self._atom(depth)
        if self._take("**"):
            value = _checked(_power(value, self._signed(depth + 1)))
        return value

    def _atom(self, depth):
        if self.number is not None:
            value = self.number
            self._next()
            return _checked(value)
        if self._take("("):
            value = self.sum(depth + 1)
            self._require(")")
            return value
        name = self.word
        if name is None:
            raise Fault(f"'{self.text.strip()}' is incomplete")
        self._next()
        if name in FUNCTIONS and self._take("("):
            value = self.sum(depth + 1)
            self._require(")")
            return _checked(FUNCTIONS[name](value))
        if name in self.values:
            return self.values[name]
        if name == "pi":
            return math.pi
        raise Fault(f"'{self.text.strip()}': '{name}' is not a function or a parameter before it")
