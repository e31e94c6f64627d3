# SPDX-License-Identifier: BSD-2-Clause
"""A case in memory: its options, and the groups of its mesh with names of their own."""
import re

import numpy as np

from squeal.deck.journal import Fault

NODES, FACES, CELLS = 0, 2, 3  # dimension of a group


class Case:
    """`options`: prefix -> name -> key -> (text, source). `groups`: dimension -> name -> members:
    node numbers; rows (element number, face from 0); element numbers. All members are sorted.
    `ties`: rows (name, side of the slave, tied nodes, free nodes). `contacts`: rows (name, nodes of
    the slave within reach of the master, others)."""

    def __init__(self):
        self.options = {}
        self.groups = {NODES: {}, FACES: {}, CELLS: {}}
        self.bodies = {}  # name -> numbers of their cells
        self.ties, self.contacts = [], []
        self._names = {}
        self._taken = set()  # names of groups and reserved ones
        self._numbers = {}  # the number after the last name that was numbered

    def set(self, path, value, source=None):
        """Sets an option: `path` is a prefix, a name and a key, or a prefix and a key. Raises Fault
        if it has another value already."""
        prefix, *name, key = path
        options = self.options.setdefault(prefix, {})
        for part in name:
            options = options.setdefault(part, {})
        text = text_of(value)
        if key in options and options[key][0] != text:
            raise Fault(f"-{'_'.join(path)} would have the values {options[key][0]} and {text}")
        options[key] = (text, source)

    def group(self, dimension, members, wanted):
        """Returns the name of the group with these members; a new one is named like `wanted`."""
        members = np.unique(np.asarray(members, np.int64), axis=0)
        identity = dimension, members.tobytes()
        if identity not in self._names:
            name = self.free_name(wanted, dimension)
            self._names[identity] = name
            self._taken.add(name)
            self.groups[dimension][name] = members
        return self._names[identity]

    def frame(self, frame):
        """Sets the options of axes of the model, and returns their name."""
        path = ("frame", clean(frame.name))
        if frame.cylindrical:
            self.set((*path, "origin"), frame.a, frame.source)
            self.set((*path, "axis"), frame.b - frame.a, frame.source)
        else:
            self.set((*path, "x"), frame.a, frame.source)
            self.set((*path, "xy"), frame.b, frame.source)
        if frame.turn:
            self.set((*path, "turn"), frame.turn[1], frame.source)
            self.set((*path, "turn_about"), "xyz"[frame.turn[0]], frame.source)
        return path[1]

    def reserve(self, wanted, dimension):
        """Returns a name that no group has or will get."""
        name = self.free_name(wanted, dimension)
        self._taken.add(name)
        return name

    def free_name(self, wanted, dimension):
        """Returns a name that no group has; of a blank it makes an underscore."""
        taken = self._taken
        name = clean(wanted)
        if name.startswith("reference_"):  # names of reference nodes
            name = f"set_{name}"
        suffix = {NODES: "_nodes", FACES: "_faces", CELLS: "_body"}[dimension]
        if name in taken and name + suffix not in taken:
            name += suffix
        number, free = self._numbers.get(name, 2), name
        while free in taken:
            free = f"{name}_{number}"
            number += 1
        self._numbers[name] = max(number - 1, 2)
        return free


def clean(name):
    """Returns a name without the characters that options do not accept."""
    return re.sub(r"[^\w.+-]", "_", name) or "group"


def text_of(value):
    """Returns the text of a value in an options file; a list is separated by commas."""
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return "on" if value else "off"
    if np.ndim(value):
        return ",".join(text_of(one) for one in value)
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    text = repr(float(value) + 0.0)
    return text if "." in text else text.replace("e", ".0e")
