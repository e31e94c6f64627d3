# SPDX-License-Identifier: BSD-2-Clause
"""The table of cards that are understood, and those that are known."""
from dataclasses import dataclass

TABLE = {}
# Cards that a deck has by thousands: those in sequence share an entry in the journal.
BLOCKS = {
    *("GRID", "CHEXA", "CPENTA", "CTETRA", "CPYRAM", "PLOAD4", "FORCE", "MOMENT", "SPC", "SPC1"),
    *(
        "CQUAD4",
        "CQUAD8",
        "CQUADR",
        "CTRIA3",
        "CTRIA6",
        "CTRIAR",
        "CBAR",
        "CBEAM",
        "CROD",
        "CONROD",
    ),
    *("PLOTEL", "PLOAD", "PLOAD2", "TEMP", "SPOINT", "CSHEAR", "CTUBE", "PLOTEL3", "PLOTEL4"),
}


@dataclass(frozen=True)
class Handler:
    function: object
    phase: int


def handles(*names, phase=2):
    """Registers a function of a card and the reader as the one that honours cards. Phase 0:
    properties and materials; 1: rigid elements; 2: most others; 3: those that need them; 4:
    contacts."""

    def register(function):
        for name in names:
            TABLE[name] = Handler(function, phase)
        return function

    return register


WITHOUT_EFFECT = {
    "EIGC": "complex modes are those of the band of the case",
    "SET1": "sets of output",
    "SET3": "sets of output",
    "PLOTEL": "lines of plots",
    "PLOTEL3": "faces of plots",
    "PLOTEL4": "faces of plots",
    "ECHOON": "output of the other program",
    "ECHOOFF": "output of the other program",
    "NLPARM": "increments are not used: the state is linear except for the contact",
    "NLSTEP": "increments are not used: the state is linear except for the contact",
    "TSTEP": "a response over time that nothing selects",
    "FREQ": "frequencies of a response that nothing selects",
    "FREQ1": "frequencies of a response that nothing selects",
    "TABLED1": "a table that nothing selects",
}
# Loads that are refused if their set is selected.
LOADS = ("PLOAD", "PLOAD1", "PLOAD2", "PLOADX1", "SLOAD", "FORCE2", "MOMENT2", "ACCEL", "ACCEL1")
PROPERTIES = ("PSHELL", "PCOMP", "PCOMPG", "PBAR", "PBARL", "PBEAM", "PBEAML", "PROD", "PTUBE")
PROPERTIES += ("PSHEAR", "PBUSHT", "PGAP", "PWELD", "PFAST", "PMASS")
REASONS = {
    **{name: "shells are not supported" for name in ("CQUAD4", "CQUAD8", "CQUADR", "CTRIA3")},
    **{name: "shells are not supported" for name in ("CTRIA6", "CTRIAR", "CSHEAR")},
    **{name: "beams are not supported" for name in ("CBAR", "CBEAM", "CROD", "CTUBE", "CONROD")},
    **{name: "scalar points are not supported" for name in ("SPOINT", "CELAS3", "CELAS4")},
    **{name: "scalar points are not supported" for name in ("CDAMP3", "CDAMP4", "EPOINT")},
    **{name: "matrices of the deck are not supported" for name in ("DMIG", "GENEL", "K2GG")},
    **{name: "scalar masses are not supported; use CONM2" for name in ("CMASS1", "CMASS2")},
    "CONM1": "a mass matrix is not supported; use CONM2",
    "RBE1": "use RBE2, RBAR or MPC",
    "RROD": "use MPC",
    "RBAR1": "use RBAR",
    "RTRPLT": "use RBE2",
    "RSPLINE": "interpolation elements of this kind are not supported; use RBE3",
    "RSSCON": "joints of shells and solids are not supported",
    "CGAP": "gap elements are not supported; use a contact pair",
    "CFAST": "fasteners are not supported",
    "CWELD": "welds are not supported",
    "MAT8": "the law of shells is not that of solid cells; use MAT9",
    "MAT2": "the law of shells is not that of solid cells; use MAT1 or MAT9",
    "MATS1": "plasticity is not supported",
    "MATHE": "hyperelasticity is not supported",
    "MATHP": "hyperelasticity is not supported",
    "MATT1": "constants that depend on the temperature are not supported",
    "PLOAD": "give the element and its face by PLOAD4",
    "PLOAD2": "pressures on shells are not supported",
    "DLOAD": "responses to excitations are not computed",
    "SUPORT": "free bodies are not supported in a static state; hold them by SPC",
    "SUPORT1": "free bodies are not supported; hold them by SPC",
    "SLOAD": "scalar points are not supported",
    "ACCEL": "accelerations that vary in space are not supported",
    "ACCEL1": "accelerations of some grids are not supported; use GRAV",
}
