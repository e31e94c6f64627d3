# SPDX-License-Identifier: BSD-2-Clause
"""Contact pairs and glue: BCTSET, BCTADD, BGSET, BGADD (Simcenter Nastran), and BCTABLE, BCTABL1,
BCONECT, BCONPRG, BCONPRP (MSC Nastran)."""
from squeal.deck.bdf.handlers import handles
from squeal.deck.bdf.regions import surfaces_of
from squeal.deck.bdf.supports import selected
from squeal.deck.journal import TRANSLATED, UNUSED, USED, Fault
from squeal.deck.model import Contact, Friction, Interaction, Tie
from squeal.deck.numbers import real

# Parameters of the other solver.
SOLVER = {
    *("PENN", "PENT", "PENTYP", "PENGLUE", "GLUETYPE", "MAXF", "MAXS", "CTOL", "NCHG", "MPER"),
    *("AVGSTS", "REFINE", "RESET", "CSTRAT", "SHLTHK", "PREVIEW", "INTORD", "ESOPT", "SPLINE"),
    *("PENALT", "AUGDIST", "TPENALT", "STKSLP", "ISEARCH", "BIAS", "SLIDE", "HARDS", "FNTOL"),
    *("COPTS", "COPTM", "COPTS1", "COPTM1", "NBODIES", "MAXENT", "MAXNOD", "METHOD", "IPRINT"),
    *("RVCNST", "NLCYCL", "NLSPLIT", "MAXSEP", "ICSEP", "IBSEP", "ICHECK", "ISPLIT", "ERROR"),
}
THERMAL = {
    "HCT",
    "HCV",
    "HNC",
    "BNC",
    "EMISS",
    "HBL",
    "HNL",
    "BNL",
    "HGLUE",
    "DQNEAR",
    "CMB",
    "CMS",
}
FRICTION_TYPES = "1234567"


def parameters_of(card, first):
    """Returns values by name of the pairs from a field on."""
    words = [card.word(at) for at in range(first, len(card.fields) + 1)]
    words = [word for word in words if word]
    if len(words) % 2:
        raise Fault(f"the parameter {words[-1]} has no value", line=card.line)
    return dict(zip(words[::2], words[1::2]))


def _settle(card, reader, given, used):
    """Returns the parameters that are used; refuses unknown ones with an effect."""
    for name, value in given.items():
        if name in SOLVER or name in THERMAL:
            reader.journal.remark(card.source, f"{name} is not used")
        elif name not in used:
            reason = f"the parameter {name} = {value} is not supported"
            reader.journal.refuse(card.source, reason, name, card.line)
    return {name: value for name, value in given.items() if name in used}


@handles("BCTPARM", "BCTPARA", "BGPARM")
def parameters_of_sets(card, reader):
    card.word(1)
    used = _settle(card, reader, parameters_of(card, 2), ("INIPENE", "OFFSET"))
    if used.get("INIPENE", "0") not in ("0", "1"):
        reader.journal.choose(f"{card.source}: gaps are those of the mesh, also negative ones")
    if real(used.get("OFFSET", "0")):
        reader.journal.refuse(card.source, "offsets of contact are not supported", "OFFSET")
    reader.journal.mark(card.source, UNUSED)


@handles("BCRPARA")
def parameters_of_region(card, reader):
    card.pass_over(2)
    card.pass_over(5)
    card.word(1)
    if card.real(3, 0.0):
        reader.journal.refuse(card.source, "offsets of contact are not supported", "OFFSET")
    if card.word(4, "FLEX") != "FLEX":
        reader.journal.refuse(card.source, "rigid regions are not supported", "TYPE")
    reader.journal.mark(card.source, UNUSED, "without effect at these values")


@handles("BCPARA")
def parameters_of_contact(card, reader):
    card.word(1)
    used = _settle(card, reader, parameters_of(card, 2), ("FTYPE",))
    reader.friction_type = used.get("FTYPE", reader.friction_type)
    reader.journal.mark(card.source, USED)


@handles("BCONPRG")
def geometric_parameters(card, reader):
    number = card.identifier(1)
    used = _settle(card, reader, parameters_of(card, 2), ("IGLUE", "JGLUE", "ICOORD"))
    if used.get("JGLUE", "0") != "0":
        reader.journal.refuse(card.source, "glue that may open is not supported", "JGLUE")
    if used.get("ICOORD", "0") != "0":
        reader.journal.choose(
            f"{card.source}: ICOORD: contacts start closed where all slave nodes are near, within"
            " half the size of their faces"
        )
    reader.contact_parameters["BCONPRG", number] = used
    reader.journal.mark(card.source, USED)


@handles("BCONPRP")
def physical_parameters(card, reader):
    number = card.identifier(1)
    used = _settle(card, reader, parameters_of(card, 2), ("FRIC",))
    if "FRIC" in used and "." not in used["FRIC"] and used["FRIC"] != "0":
        reader.journal.refuse(card.source, "tables of friction are not supported", "FRIC")
    reader.contact_parameters["BCONPRP", number] = used
    reader.journal.mark(card.source, USED)


@handles("BCTSET", phase=4)
def bctset(card, reader):
    """Pairs: source, target, friction, and the least and the largest distance."""
    if selected(card, reader, reader.contact_sets, card.integer(1, 0)) is None:
        return
    for first in range(2, len(card.fields), 8):
        if not card.word(first):
            continue
        pair = card.identifier(first), card.identifier(first + 1)
        friction = card.real(first + 2, 0.0)
        distances = card.real(first + 3, 0.0), card.real(first + 4, 0.0)
        if any(distances):
            reader.journal.choose(
                f"{card.source}: the distances MIND and MAXD are not used; faces within half their"
                " size are paired"
            )
        _contact(card, reader, pair, friction, None)


@handles("BGSET", phase=4)
def bgset(card, reader):
    """Glued pairs: source, target, and the search distance."""
    number = selected(card, reader, reader.glue_sets, card.integer(1, 0))
    if number is None:
        return
    for first in range(2, len(card.fields), 8):
        if card.word(first):
            pair = card.identifier(first), card.identifier(first + 1)
            distance = card.real(first + 2, None) or None  # 0 is the default
            card.pass_over(first + 4)  # extension of the search beside the faces
            _glue(card, reader, pair, distance)


def _contact(card, reader, pair, friction, adjust):
    model, journal = reader.model, reader.journal
    if friction < 0:
        raise Fault("the coefficient of friction is negative", line=card.line)
    slave, master = surfaces_of(reader, *pair, card)
    if adjust:
        adjust = reader.outside().size_of(model.surfaces[slave].elements) / 2
    key = f"{card.name.lower()}_{len(model.contacts) + 1}"
    one = Interaction(card.source)
    squeal = reader.squeals.get(frozenset(pair))
    if squeal is not None:
        friction = squeal.friction if squeal.friction else friction
        one.stiffness, one.behavior = squeal.stiffness, squeal.source
        squeal.interactions.append(key)
    elif (
        friction
        and card.name in ("BCTABLE", "BCONECT")
        and not _has_friction(reader)
        and reader.all_squeal is None
    ):
        journal.choose(f"{card.source}: FRIC is not used, since FTYPE of BCPARA is 0")
        friction = 0.0
    if friction:
        one.frictions.append(Friction(card.source, (friction,)))
    model.interactions[key] = one
    model.contacts.append(Contact(slave, master, key, card.source, adjust))
    journal.mark(card.source, TRANSLATED)


def _has_friction(reader):
    return reader.friction_type in FRICTION_TYPES


def _glue(card, reader, pair, distance):
    slave, master = surfaces_of(reader, *pair, card)
    name = f"{card.name.lower()}_{len(reader.model.ties) + 1}"
    reader.model.ties.append(Tie(name, slave, master, distance, True, card.source))
    reader.journal.mark(card.source, TRANSLATED)


@handles("BCTABL1", phase=3)
def bctabl1(card, reader):
    """The pairs (BCONECT) of a table."""
    if selected(card, reader, reader.contact_sets, card.integer(1, 0)) is None:
        return
    chosen = set() if reader.connections is None else reader.connections
    for first, last in card.numbers(2):
        chosen.update(range(first, last + 1))
    reader.connections = chosen


@handles("BCONECT", phase=4)
def bconect(card, reader):
    number = card.integer(1, 0)
    wanted = reader.connections
    if wanted is None:
        wanted = reader.contact_sets
    if wanted is not None and number not in wanted:
        reader.journal.mark(card.source, UNUSED, f"connection {number} is not selected")
        card.read.update(range(1, len(card.fields) + 1))
        return
    used = {}
    for kind, field in (("BCONPRG", 2), ("BCONPRP", 3)):
        if card.word(field):
            key = kind, card.identifier(field)
            if key not in reader.contact_parameters:
                raise Fault(f"there is no {kind} {key[1]}", line=card.line)
            used.update(reader.contact_parameters[key])
    sides = _sides(card)
    for one in sides[0]:
        for other in sides[1]:
            if used.get("IGLUE", "0") != "0":
                _glue(card, reader, (one, other), None)
            else:
                _contact(card, reader, (one, other), real(used.get("FRIC", "0.")), _adjust(used))


def _adjust(used):
    """Returns whether ICOORD moves slave nodes onto the other side, or None."""
    return None if used.get("ICOORD", "0") == "0" else True


def _sides(card):
    """Returns the bodies that touch and those that are touched."""
    sides = {"SECNDRY": [], "PRIMARY": []}
    for word, field in (("SECNDRY", 4), ("PRIMARY", 5)):
        if card.word(field):
            sides[word].append(card.identifier(field))
    current = None
    for at in range(9, len(card.fields) + 1):
        word = card.word(at)
        if word[:4] in ("SECN", "SLAV"):
            current = "SECNDRY"
        elif word[:4] in ("PRIM", "MAST"):
            current = "PRIMARY"
        elif word and current:
            sides[current].append(card.identifier(at))
        elif word:
            raise Fault(f"'{word}' is not supported", None, card.line)
    if not all(sides.values()):
        raise Fault("a pair needs two bodies", line=card.line)
    return sides["SECNDRY"], sides["PRIMARY"]


@handles("BCTABLE", phase=4)
def bctable(card, reader):
    """Groups of SECNDRY, with friction and glue, and the PRIMARY bodies that it touches."""
    if selected(card, reader, reader.contact_sets, card.integer(1, 0)) is None:
        return
    short = [card.integer(at, 0) for at in (2, 3)]
    for at in (4, 5, 6):
        card.pass_over(at)
    if any(short) and not all(short):
        raise Fault("IDSCND needs IDPRIM", line=card.line)
    groups = [(short[0], {}, [short[1]])] if all(short) else _groups(card, reader)
    for secondary, used, others in groups:
        for other in others:
            if used.get("IGLUE", 0):
                _glue(card, reader, (secondary, other), None)
            else:
                _contact(card, reader, (secondary, other), used.get("FRIC", 0.0), None)


def _groups(card, reader):
    groups, current = [], ""
    for line in range(8, len(card.fields), 8):
        word = card.word(line + 1) or card.word(line + 2)
        shift = line + (1 if card.word(line + 1) else 2)
        if word[:4] in ("SECN", "SLAV"):
            used = {"FRIC": card.real(shift + 4, 0.0), "IGLUE": card.integer(shift + 6, 0)}
            if card.real(shift + 5, 0.0):
                raise Fault("an interference (CINTERF) is not supported", "CINTERF", card.line)
            for at in (shift + 2, shift + 3):
                card.pass_over(at)
            groups.append((card.identifier(shift + 1), used, []))
            current = "secondary"
        elif word[:4] in ("PRIM", "MAST") and groups:
            current = "primary"
            groups[-1][2].extend(first for first, _ in card.numbers_of(shift + 1, line + 8))
        elif current == "primary" and word:
            groups[-1][2].extend(first for first, _ in card.numbers_of(line + 2, line + 8))
        elif word:
            raise Fault(f"'{word}' is not supported", word, card.line)
        elif any(card.word(at) for at in range(line + 1, line + 9)):
            raise Fault("only the first line of a group is supported", "BCTABLE", card.line)
    return groups
