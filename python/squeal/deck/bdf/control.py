# SPDX-License-Identifier: BSD-2-Clause
"""Executive and case control: the solution, and the sets that a subcase selects."""
import re
from dataclasses import dataclass, field

from squeal.deck.journal import TRANSLATED, UNUSED, USED, Fault, Source
from squeal.deck.numbers import integer, is_integer

SOLUTIONS = {
    **{"101": "static", "SESTATIC": "static", "STATIC": "static", "STATICS": "static"},
    **{"103": "modes", "SEMODES": "modes", "MODES": "modes"},
    **{"107": "complex", "SEDCEIG": "complex", "110": "complex", "SEMCEIG": "complex"},
    **{"400": "nonlinear", "NONLIN": "nonlinear"},
}
EXECUTIVE = ("ID", "TIME", "DIAG", "APP", "ECHO", "ECHOON", "ECHOOFF", "GEOMCHECK", "MODEL_CHECK")
EXECUTIVE += ("NASTRAN", "ASSIGN", "INIT", "DOMAINSOLVER", "SPARSESOLVER", "PARALLEL")
SETS = ("SPC", "MPC", "LOAD", "METHOD", "CMETHOD", "BCONTACT", "BCSET", "BGSET", "BSQUEAL")
OUTPUT = """
ACCELERATION BCRESULTS BGRESULTS BOUTPUT CMSENRGY DISPLACEMENT ECHO EDE EKE ELFORCE ELSDCON ELSTRAIN
ELSTRESS ELSUM ENTHALPY EQUILIBRIUM ESE FORCE GKRESULTS GPFORCE GPKE GPSDCON GPSTRAIN GPSTRESS
GROUNDCHECK LABEL LINE MAXLINES MEFFMASS MODALKE MODALSE MODES MODESELECT MPCFORCES MPRES NLSTRESS
NOUTPUT OFREQUENCY OLOAD OMODES OTIME OUTRCV PAGE PARTN PLOTID POST PRESSURE RCROSS SACCELERATION
SDISPLACEMENT SEALL SET SHELLTHK SKIP SPCFORCES STRAIN STRESS STRFIELD SUBTITLE SURFACE SVECTOR
SVELOCITY TITLE VECTOR VELOCITY VOLUME WEIGHTCHECK
""".split()
IDLE = {
    "AUTOSPC": "components without stiffness: those of nodes of solid elements do not exist, others"
    " are named",
    "RIGID": "couplings are eliminated",
    "RESVEC": "the program has static corrections of its own",
    "NLPARM": "increments are not used: the state is linear except for the contact",
    "NLSTEP": "increments are not used: the state is linear except for the contact",
    "NLIC": "",
    "SUPER": "",
}
REFUSED = {
    **{"TEMPERATURE": "temperatures and their strains", "DEFORM": "enforced deformations"},
    **{"SUPORT1": "free bodies and inertia relief", "SDAMPING": "tables of modal damping"},
    **{
        "DLOAD": "excitations",
        "FREQUENCY": "responses to excitations",
        "NSM": "nonstructural mass",
    },
    **{"K2GG": "matrices of DMIG", "M2GG": "matrices of DMIG", "B2GG": "matrices of DMIG"},
    **{"K2PP": "matrices of DMIG", "M2PP": "matrices of DMIG", "B2PP": "matrices of DMIG"},
    **{"K42GG": "matrices of DMIG", "BOLTLD": "bolts"},
    **{"SUBCOM": "combined subcases", "SUBSEQ": "combined subcases", "SYM": "symmetry subcases"},
    **{"REPCASE": "repeated subcases", "SYMCOM": "symmetry subcases", "INITIAL": "initial states"},
    **{"RGYRO": "rotors", "BCMOVE": "moving contact bodies", "UNGLUE": "glue that ends"},
}
COMMAND = re.compile(r"([A-Z][A-Z0-9]*)\s*(\([^)]*\))?\s*=?\s*(.*)", re.IGNORECASE)


@dataclass
class Subcase:
    """`sets`: number and source of the sets that it selects, by the name of the command."""

    number: int
    source: Source
    sets: dict = field(default_factory=dict)
    steps: list = field(default_factory=list)
    analysis: str = ""
    preload: int = None  # the subcase of STATSUB
    preload_source: Source = None


@dataclass
class Control:
    """`solution`: static, modes, complex or nonlinear, '' for a deck of bulk data only."""

    solution: str = ""
    base: Subcase = None
    subcases: list = field(default_factory=list)
    parameters: list = field(default_factory=list)  # name, value and source of PARAM


class Reader:
    """Reads the lines before BEGIN BULK."""

    def __init__(self, lines, journal):
        self.lines, self.journal = lines, journal
        self.control = Control(base=Subcase(0, None))
        self.current = self.control.base
        self.plots = False
        ends = [at for at, text in enumerate(lines.texts) if text.strip().upper() == "CEND"]
        start = ends[0] + 1 if ends else 0
        for at in range(start - 1 if ends else 0):
            self._executive(at, lines.texts[at].strip())
        if ends:
            journal.mark(lines.source(ends[0], "CEND"), USED)
        at = start
        while at < len(lines.texts):
            text, first = lines.texts[at].strip(), at
            titles = text[:4].upper() in ("TITL", "SUBT", "LABE")
            while text.endswith(",") and not titles and at + 1 < len(lines.texts):
                at += 1
                text += lines.texts[at].strip()
            self._command(first, text)
            at += 1

    def _executive(self, at, text):
        word = re.split(r"[\s,=(]", text, maxsplit=1)[0].upper()
        source = self.lines.source(at, word)
        if word == "SOL":
            self._solution(source, text)
        elif word in EXECUTIVE:
            self.journal.mark(source, UNUSED, "without effect on the model")
        else:
            self.journal.refuse(source, "this executive statement is not supported")

    def _solution(self, source, text):
        name = re.split(r"[\s,=]+", text)[1:2]
        name = name[0].upper() if name else ""
        if name in SOLUTIONS:
            self.control.solution = SOLUTIONS[name]
            self.journal.mark(source, USED)
            return
        self.control.solution = "modes"
        self.journal.refuse(
            source, f"the solution {name} is not computed; 101, 103, 107, 110 and 400 are read"
        )

    def _command(self, at, text):
        match = COMMAND.match(text)
        word = match[1].upper() if match else text.split()[0].upper()
        source = self.lines.source(at, _full(word))
        try:
            if not match:
                raise Fault("this command is not supported")
            self._apply(source, match)
        except Fault as fault:
            self.journal.refuse(source, fault.reason, fault.name)

    def _apply(self, source, match):
        word, value, mark = source.card, match[3].strip(), self.journal.mark
        if word in ("SUBCASE", "STEP"):
            self._open(source, integer(value.split()[0] if value else ""))
        elif self.plots or word in ("OUTPUT", "XTITLE", "XYPLOT", "XYPRINT", "XYPUNCH", "XYPEAK"):
            self.plots = True
            mark(source, UNUSED, "output of the other program")
        elif word == "SOL":
            self._solution(source, match[0])
        elif word in SETS:
            if not is_integer(value):
                raise Fault(f"'{value}' is not the number of a set")
            self.current.sets[word] = int(value), source
            self.journal.open(source)
        elif word == "ANALYSIS":
            self.current.analysis = value.upper()
            mark(source, USED)
        elif word == "STATSUB":
            if match[2] and match[2].strip("()").upper() not in ("PRELOAD", "BUCKLE"):
                raise Fault(f"{match[2]} is not supported")
            self.current.preload, self.current.preload_source = integer(value), source
            mark(source, USED)
        elif word == "PARAM":
            words = [part.strip().upper() for part in value.strip(", ").split(",")]
            self.control.parameters.append((words[0], words[1:], source))
        elif word in OUTPUT:
            mark(source, UNUSED, "output of the other program")
        elif word in IDLE:
            mark(source, UNUSED, IDLE[word])
        elif word in REFUSED:
            raise Fault(f"{REFUSED[word]}: not supported")
        else:
            raise Fault("this command is not supported")

    def _open(self, source, number):
        self.plots = False
        one = Subcase(number, source)
        subcases = self.control.subcases
        if source.card == "SUBCASE":
            if any(other.number == number for other in subcases):
                raise Fault(f"subcase {number} is given twice")
            one.sets = dict(self.control.base.sets)
            base = self.control.base
            one.analysis = base.analysis
            one.preload, one.preload_source = base.preload, base.preload_source
            subcases.append(one)
        else:
            owner = subcases[-1] if subcases else self.control.base
            one.sets, one.analysis = dict(owner.sets), owner.analysis
            owner.steps.append(one)
        self.current = one
        self.journal.mark(source, USED)


def _full(word):
    """Returns the full name of a command, which may be given by its first four letters or more."""
    names = (*SETS, "SUBCASE", "STEP", "ANALYSIS", "STATSUB", "PARAM", *IDLE, *REFUSED, *OUTPUT)
    if word in names or len(word) < 4:
        return word
    longer = [name for name in names if name.startswith(word)]
    return longer[0] if longer else word


@dataclass
class Selection:
    """The sets of the case: `None` for those of which none is selected; `everything`: a deck of
    bulk data only, of which all sets count. `static`, `frequency`: the sources of what asks for
    them; `sources`: those of the other sets."""

    everything: bool = False
    complex: bool = False
    spc: int = None
    mpc: int = None
    load: int = None
    method: int = None
    contact: int = None
    glue: int = None
    squeal: int = None
    static: Source = None
    frequency: Source = None
    prestress: bool = False
    sources: dict = field(default_factory=dict)


def select(control, wanted, journal):
    """Returns the selection of a subcase: `wanted`, or the first one."""
    if not control.solution and not control.subcases and not control.base.sets:
        journal.choose("the deck has no case control: all its sets are taken")
        return Selection(everything=True)
    ones = control.subcases or [control.base]
    chosen = _chosen(control, ones, wanted, journal)
    steps = [chosen, *chosen.steps]
    preload = None
    if chosen.preload is not None:
        preload = next((one for one in ones if one.number == chosen.preload), None)
        if preload is None:
            journal.refuse(chosen.preload_source, f"subcase {chosen.preload} does not exist")
    found = Selection(complex=control.solution in ("complex", "nonlinear"))
    found.prestress = preload is not None
    modal = control.solution in ("modes", "complex")
    for one in ([preload] if preload else []) + steps:
        moving = one.analysis[:4] in ("MODE", "MCEI", "DCEI") or modal and one is not preload
        _take(found, one, moving, control.solution, journal)
    for one in (control.base, *(step for own in ones for step in (own, *own.steps))):
        for _, source in one.sets.values():
            if not journal.entries[source].status:
                journal.mark(source, UNUSED, "the case is not that of its subcase")
    return found


def _chosen(control, ones, wanted, journal):
    if wanted is not None:
        found = next((one for one in ones if one.number == wanted), None)
        if found is not None:
            return found
        journal.refuse_model(f"subcase {wanted} does not exist")
    modal = control.solution in ("modes", "complex")
    likely = [one for one in ones if "METHOD" in one.sets or "CMETHOD" in one.sets]
    chosen = (likely if modal and likely else ones)[0]
    if len(ones) > 1:
        others = [str(one.number) for one in ones if one is not chosen]
        used = [str(chosen.preload)] if chosen.preload is not None else []
        left = [number for number in others if number not in used]
        if left:
            journal.choose(
                f"{chosen.source}: the case is that of subcase {chosen.number}; choose another one"
                f" by --subcase: {', '.join(left[:10])}"
            )
    return chosen


def _take(found, one, moving, solution, journal):
    """Adds the sets of a subcase or of a step."""
    names = {"SPC": "spc", "MPC": "mpc", "BCONTACT": "contact", "BCSET": "contact"}
    names["BGSET"] = "glue"
    for name, key in {**names, "BSQUEAL": "squeal"}.items():
        if name not in one.sets:
            continue
        number, source = one.sets[name]
        before = getattr(found, key)
        if before not in (None, number) and key in ("spc", "mpc", "contact"):
            journal.refuse(source, f"{name} {before} of the preload differs from {number}")
        setattr(found, key, number)
        found.sources[key] = source
        journal.mark(source, TRANSLATED)
    if "LOAD" in one.sets:
        number, source = one.sets["LOAD"]
        if moving:
            journal.mark(source, UNUSED, "loads have no effect on free vibrations")
        else:
            found.load, found.static = number, source
            journal.mark(source, TRANSLATED)
    if "METHOD" in one.sets and (moving or solution == "nonlinear"):
        found.method, found.frequency = one.sets["METHOD"]
        journal.mark(found.frequency, TRANSLATED)
    if "CMETHOD" in one.sets:
        source = one.sets["CMETHOD"][1]
        journal.mark(source, UNUSED, "complex modes are those of the band of the case")
        found.frequency = found.frequency or source


def read_control(lines, journal):
    """Returns the executive and case control of the lines before BEGIN BULK."""
    return Reader(lines, journal).control
