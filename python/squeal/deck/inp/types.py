# SPDX-License-Identifier: BSD-2-Clause
"""Types of elements: those that are translated, and reasons why others are not."""
from squeal.deck.cells import HEX8, HEX20, TET4, TET10, WEDGE6, WEDGE15

SOLIDS = {
    **{"C3D4": TET4, "C3D10": TET10, "C3D6": WEDGE6, "C3D15": WEDGE15},
    **{"C3D8": HEX8, "C3D8I": HEX8, "C3D20": HEX20, "C3D20R": HEX20},
}
MEAN = "full integration with incompatible modes, in place of one point with hourglass control"
HYBRID = "displacements only; the pressure of the hybrid element matters near Poisson's ratio 0.5"
MECHANICAL = "only its mechanical part"
# Types of Abaqus that become another type, and the difference.
BECOMES = {
    **{"C3D8R": ("C3D8I", MEAN), "C3D8RH": ("C3D8I", MEAN)},
    **{"C3D8H": ("C3D8", HYBRID), "C3D8IH": ("C3D8I", HYBRID), "C3D4H": ("C3D4", HYBRID)},
    **{"C3D6H": ("C3D6", HYBRID), "C3D15H": ("C3D15", HYBRID), "C3D20H": ("C3D20", HYBRID)},
    **{"C3D20RH": ("C3D20R", HYBRID), "C3D10H": ("C3D10", HYBRID), "C3D10MH": ("C3D10", HYBRID)},
    **{"C3D10HS": ("C3D10", HYBRID), "C3D10M": ("C3D10", "the standard quadratic tetrahedron")},
    "C3D10I": ("C3D10", "the standard quadratic tetrahedron"),
    **{
        f"C3D{stem}{letter}": (kind, MECHANICAL)
        for letter in "TPE"
        for stem, kind in (
            *(("4", "C3D4"), ("6", "C3D6"), ("8", "C3D8"), ("10", "C3D10"), ("15", "C3D15")),
            *(("20", "C3D20"), ("20R", "C3D20R"), ("8R", "C3D8I"), ("10M", "C3D10")),
        )
    },
}
DISCRETE = {
    **{"SPRINGA": 2, "DASHPOTA": 2, "SPRING1": 1, "SPRING2": 2, "DASHPOT1": 1, "DASHPOT2": 2},
    **{"MASS": 1, "ROTARYI": 1, "DCOUP3D": 1},
}
ONLY_ABAQUS_TYPES = (set(BECOMES) - {"C3D8R"}) | {"ROTARYI", "CONN3D2", "DASHPOT1", "DASHPOT2"}
ADVICE = {
    "C3D8R": "hourglass control differs in every program; mesh with C3D8 or C3D20",
    "GAPUNI": "gap elements are not supported; use a contact pair",
    "CONN3D2": "connectors are not supported; use springs, dashpots or a coupling",
    **{
        kind: "shells with the shape of solids are not supported; mesh with C3D8I"
        for kind in ("SC8R", "SC6R", "CSS8")
    },
    **{
        kind: "layers with a law of their own are not supported; use a tie or a soft contact"
        for kind in ("COH3D8", "COH3D6", "GK3D8", "GK3D6")
    },
    **{kind: "rigid surfaces are not supported" for kind in ("R3D3", "R3D4", "RAX2")},
}
