# SPDX-License-Identifier: BSD-2-Clause
"""The model that a deck describes, the same for all input languages.

Node and element numbers are those of the deck. Components are 0, 1, 2 for displacements and
3, 4, 5 for rotations.
"""
from dataclasses import dataclass, field

import numpy as np

from squeal.deck.axes import Frame
from squeal.deck.journal import Source
from squeal.deck.mesh import EMPTY, Block, Nodes, Sets


@dataclass
class Material:
    """`law`: isotropic, engineering, orthotropic or anisotropic, with its constants in the order of
    Abaqus. `refusals`: laws that the program does not have, as (source, reason); they matter only
    if a section uses the material."""

    name: str
    source: Source
    law: str = ""
    constants: tuple = ()
    elastic: Source = None
    density: float = None
    density_source: Source = None
    damping: tuple = ()  # Rayleigh's factors of mass and stiffness
    damping_source: Source = None
    refusals: list = field(default_factory=list)
    loss: tuple = None  # loss factor of structural damping, and its frequency in Hz


@dataclass
class Section:
    elements: np.ndarray
    label: str
    material: str
    orientation: str
    source: Source


@dataclass
class Equation:
    """Terms (node, component, coefficient) in the axes of each node, or in global axes; their sum
    is zero. `name`: None for that of the line."""

    terms: list
    source: Source
    in_global_axes: bool = False
    name: str = None


@dataclass
class Rigid:
    """Nodes that move with a reference node as a rigid body, along some components of the axes of
    `frame` (None: global). The components of the node `rotation` are its rotation, if there is such
    a node; components 4 to 6 of the reference node always are. `surface`: the nodes are those of a
    surface of this key, otherwise of the set `label`. `name`: of a coupling, None for a body.
    `weighting`: the reference node follows the mean motion of the nodes, weighted by this method.
    `pinned`: rotations of reference nodes among them stay free; `mixed`: some of their components
    do. `radius`: that of a sphere about the reference node outside of which nodes are not coupled.
    """

    label: str
    nodes: np.ndarray
    reference: int
    source: Source
    rotation: int = None
    name: str = None
    surface: str = None
    components: tuple = (0, 1, 2)
    frame: Frame = None
    weighting: str = None
    pinned: bool = False
    mixed: bool = False
    radius: float = None


@dataclass
class Mean:
    """A node whose displacement is the weighted mean of that of others, without moments."""

    reference: int
    nodes: np.ndarray
    weights: np.ndarray
    source: Source


@dataclass
class Tie:
    """`tolerance` None: that of the program of the deck."""

    name: str
    slave: str
    master: str
    tolerance: float
    adjust: bool
    source: Source


@dataclass
class Friction:
    """A coefficient of friction over the slip rate: constant, the value `coefficients[0]`; a table
    with the slip rates `speeds`; or, if `decay` is given, (μs, μk) with μk + (μs − μk) e^(−decay w)
    at the slip rate w. Without coefficients no slip is possible."""

    source: Source
    coefficients: tuple = ()
    speeds: tuple = ()
    decay: float = None


@dataclass
class Interaction:
    """How two surfaces in contact act on each other: `stiffness` is that of a penalty, per area,
    None for hard contact; `frictions`: the first law, and those to which later steps change it."""

    source: Source
    behavior: Source = None
    stiffness: float = None
    separation: bool = True
    frictions: list = field(default_factory=list)


@dataclass
class Motion:
    """Matter that moves through the mesh at these nodes: with the velocity `amount` (vector), or,
    if `axis` is given, with the speed `amount` about the axis through `origin`."""

    nodes: np.ndarray
    amount: object
    source: Source
    axis: np.ndarray = None
    origin: np.ndarray = None
    known: bool = True  # otherwise only the direction is


@dataclass
class Squeal:
    """A request for complex modes with friction: `friction` are the laws by interaction in that
    step, `top` the upper frequency limit, Hz, or None, `count` the number of modes, or None."""

    source: Source
    friction: dict
    friction_damping: bool
    count: int = None
    top: float = None


@dataclass
class Contact:
    """Two surfaces, by their keys, that may touch."""

    slave: str
    master: str
    interaction: str
    source: Source
    adjust: float = None  # slave nodes within this distance start on the master


@dataclass
class Joint:
    """Springs or dashpots of a set of elements. `kind`: line (along the line of two nodes), ground
    (one node, along the first of `components`) or pair (between the components of two nodes)."""

    kind: str
    label: str
    components: tuple
    stiffness: float
    damping: float
    source: Source


@dataclass
class PointMass:
    """`inertia`: a matrix in global axes, about the node, None without one."""

    label: str
    mass: float
    source: Source
    inertia: np.ndarray = None


@dataclass
class Bolt:
    """A surface inside a body that cuts the shank of a bolt. The first component of `node` is its
    elongation, and `force` there its tension. `locked`: from some step on it keeps its length."""

    surface: str
    node: int
    normal: np.ndarray
    source: Source
    force: object = None  # a Value
    locked: bool = False


@dataclass(frozen=True)
class Value:
    """A prescribed value or force: `label` is the key of the set that the deck named, or None."""

    value: float
    label: str
    source: Source


@dataclass
class BodyLoad:
    """Gravity (GRAV: `amount` is the acceleration along `direction`) or the centrifugal force of a
    rotation (CENTRIF: `amount` is the speed about the axis through `origin`; CENT: the square of
    the speed times the density), or a force per volume (FORCE)."""

    kind: str
    elements: np.ndarray
    direction: np.ndarray
    amount: float
    source: Source
    origin: np.ndarray = None


@dataclass
class State:
    """Supports and loads of the last static state: by node and component, by element and face.
    `global_forces`: forces are in global axes, not in those of their nodes. `gravity`: acceleration
    of all bodies and masses, as (vector, source)."""

    supports: dict = field(default_factory=dict)
    forces: dict = field(default_factory=dict)
    pressures: dict = field(default_factory=dict)
    body_loads: list = field(default_factory=list)
    global_forces: bool = False
    gravity: tuple = None


@dataclass
class Model:
    """`program`: the one that the deck is written for."""

    title: str
    program: str = ""
    instances: list = field(default_factory=list)
    nodes: Nodes = field(default_factory=Nodes)
    blocks: list = field(default_factory=list)
    node_sets: Sets = field(default_factory=lambda: Sets("node"))
    element_sets: Sets = field(default_factory=lambda: Sets("element"))
    surfaces: dict = field(default_factory=dict)
    materials: dict = field(default_factory=dict)
    orientations: dict = field(default_factory=dict)
    frames: dict = field(default_factory=dict)  # by node number
    amplitudes: dict = field(default_factory=dict)
    sections: list = field(default_factory=list)
    temperatures: list = field(default_factory=list)  # at the start: (nodes, value, source)
    equations: list = field(default_factory=list)
    rigid: list = field(default_factory=list)
    means: list = field(default_factory=list)
    ties: list = field(default_factory=list)
    interactions: dict = field(default_factory=dict)
    contacts: list = field(default_factory=list)
    joints: list = field(default_factory=list)
    masses: list = field(default_factory=list)
    bushings: list = field(default_factory=list)
    distributed: list = field(default_factory=list)
    inertias: list = field(default_factory=list)
    bolts: list = field(default_factory=list)
    state: State = field(default_factory=State)
    static: Source = None  # the last static step
    frequencies: int = None  # number of free modes, None: none requested
    frequency: Source = None
    top: float = None  # upper limit of the free modes, Hz, None: none given
    words: dict = field(default_factory=dict)  # names of cards in messages
    prestress: bool = False
    large_displacements: bool = False  # the static steps have them, and the user ignores that
    motions: list = field(default_factory=list)
    squeal: list = field(default_factory=list)  # requests for complex modes
    speed: float = None  # of a motion whose speed the deck does not have, given by the user
    _lookup: tuple = None

    def word(self, card):
        """Returns the name of a card of Abaqus in the language of the deck."""
        return self.words.get(card, f"*{card}")

    def node_label(self, number):
        """Returns the number of a node in its part, and the name of the instance."""
        return self._label(number, [one.node_offset for one in self.instances])

    def node_name(self, number):
        """Returns the number of a node in its part, behind the name of the instance, if any."""
        return self._name(number, [one.node_offset for one in self.instances])

    def element_name(self, number):
        return self._name(number, [one.element_offset for one in self.instances])

    def _name(self, number, offsets):
        for one, offset in zip(reversed(self.instances), reversed(offsets)):
            if number > offset:
                return f"{one.name}.{number - offset}" if one.name else str(number - offset)
        return str(number)

    def element_label(self, number):
        return self._label(number, [one.element_offset for one in self.instances])

    def _label(self, number, offsets):
        for one, offset in zip(reversed(self.instances), reversed(offsets)):
            if number > offset:
                return f"{number - offset} of {one.name or 'the assembly'}"
        return str(number)

    def absent(self, members, sets):
        """Returns how many members of a set of nodes or of elements the deck does not have."""
        if not len(members):
            return 0
        nodal = sets is self.node_sets
        there = self.nodes.has(members) if nodal else self.find_elements(members)[0] >= 0
        return int(np.sum(~there))

    def merge_blocks(self):
        """Joins the elements of each type; their source is that of the first. To be called once,
        when all are read: decks may have a card for each element."""
        parts = {}
        for block in self.blocks:
            parts.setdefault(block.kind, []).append(block)
        self.blocks = [
            Block(
                kind,
                blocks[0].shape,
                np.concatenate([block.numbers for block in blocks]),
                np.concatenate([block.nodes for block in blocks]),
                blocks[0].source,
            )
            for kind, blocks in parts.items()
        ]
        self._lookup = None

    def find_elements(self, numbers):
        """Returns block and row of elements, −1 for numbers without one. To be called when the
        blocks are merged."""
        if self._lookup is None:
            known = np.concatenate([EMPTY, *(block.numbers for block in self.blocks)])
            counts = [len(block.numbers) for block in self.blocks]
            order = np.argsort(known, kind="stable")
            blocks = np.repeat(np.arange(len(counts)), counts)[order]
            rows = np.concatenate([EMPTY, *(np.arange(count) for count in counts)])[order]
            self._lookup = known[order], blocks, rows
        known, blocks, rows = self._lookup
        if not len(known):
            return np.full(len(numbers), -1), np.full(len(numbers), -1)
        at = np.minimum(np.searchsorted(known, numbers), len(known) - 1)
        found = known[at] == numbers
        return np.where(found, blocks[at], -1), np.where(found, rows[at], -1)

    def nodes_of_elements(self, elements, kind=None):
        """Returns the nodes of elements, of one kind only if it is given, in ascending order."""
        found = [EMPTY]
        blocks, rows = self.find_elements(elements)
        for number, block in enumerate(self.blocks):
            if kind is None or block.kind == kind:
                found.append(block.nodes[rows[blocks == number]].ravel())
        return np.unique(np.concatenate(found))
