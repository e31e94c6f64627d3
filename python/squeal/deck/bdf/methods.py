# SPDX-License-Identifier: BSD-2-Clause
"""Numbers and bands of modes, EIGRL and EIGR, and the parameters of PARAM."""
from squeal.deck.bdf.handlers import handles
from squeal.deck.journal import TRANSLATED, UNUSED, USED, Fault
from squeal.deck.numbers import real

MANY = 200  # free modes of a band without a number of roots, as the program's default
HARMLESS = """
ACOUT ALTRED ALTSHAPE ASING AUTOGOUT AUTOMSET AUTOQSET AUTOSPC AUTOSPCR AUTOSPRT BAILOUT BAILOUTX
BUSHNM CHECKOUT CHKMASS CHKSTIF COMPARE CURV CURVPLOT DBALL DBDICT DBDRPRJ DBEXT DDRMM DYNSPCF ECHO
EFOPT ENFMOTN ERROR EST EXTDR EXTDROUT EXTOUT EXTUNIT FACTOR FIXEDB FKSYMFAC GEOMU GPECT GRDEQ
GRDPNT HEATSTAT IFP INRFILE IRES K6ROT LMFACT LMODES MAXRATIO MESH MODACC MPCX NASPRT NEWSEQ NINTPTS
NLAYERS NOCOMPS NOELOF NOELOP NOGPF NOMSGSTR NONCUP NUMOUT OCMP OEE OEF OELMSET OES OESE OG OGEOM
OGPS OIBULK OLDSEQ OMACHPR OMAXR OMODES OMSGLVL OPG OPGEOM OPHIPA OQG OSETELE OSETGRD OSWELM OSWPPT
OUG OUGCORD OUMU PATVER PDRMSG PENFN POST POSTEXT PRGPAR PRGPST PRINT PROUT PRPHIVZ PRTCSTM PRTEQXIN
PRTGPDT PRTGPL PRTGPTT PRTMAXIM PRTRESLT RESVEC RESVINER SEMAP SHIFT1 SIGMA SINGLE SIZE SNORM
SNORMPRT SOLID SPARSEDR SPARSEPH SPCGEN SRCOMPS STRESS STRUCT SUBCASID SYMMDBG TABID TESTNEG TESTSE
TINY TSTATIC UNITSYS UNSYMF USETPRT USETSEL USETSTR1 VUGJUMP WRBEAMB XYUNIT
""".split()


@handles("EIGRL")
def eigrl(card, reader):
    _modes(card, reader, low=2, high=3, count=4)
    for number in (5, 6, 7, 8):
        card.pass_over(number)
    if any(card.word(number) for number in range(9, len(card.fields) + 1)):
        reader.journal.remark(card.source, "options of the solver are not used")


@handles("EIGR")
def eigr(card, reader):
    _modes(card, reader, low=3, high=4, count=6)
    for number in (2, 5, 9, 10, 11):
        card.pass_over(number)


def _modes(card, reader, low, high, count):
    number = card.identifier(1)
    card.read.update(range(1, len(card.fields) + 1))
    wanted = reader.selection.method
    if reader.selection.everything and not reader.methods:
        wanted = number
    reader.methods.add(number)
    if number != wanted:
        reader.journal.mark(card.source, UNUSED, f"set {number} is not selected")
        return
    model, journal = reader.model, reader.journal
    first, last, roots = card.real(low, 0.0), card.real(high, None), card.integer(count, 0)
    if last is not None and last <= 0:
        raise Fault("the upper frequency is not positive", line=card.line)
    if roots < 0:
        raise Fault("the number of roots is negative", line=card.line)
    model.frequency = card.source
    model.frequencies = roots or MANY
    if first > 0:
        journal.choose(f"{card.source}: modes below {first:g} Hz are computed as well")
    if last is not None:
        model.top = last
    if not roots and last is None:
        model.frequencies = 1
    elif not roots:
        journal.choose(
            f"{card.source}: {MANY} free modes, since the deck gives a band and no number of roots;"
            " raise -modes_count if they do not reach its end"
        )
    journal.mark(card.source, TRANSLATED)


@handles("MDLPRM")
def model_parameters(card, reader):
    for number in range(1, len(card.fields), 2):
        name, value = card.word(number), card.word(number + 1)
        if name and name not in ("HDF5", "OFFDEF"):
            reader.journal.refuse(card.source, f"{name} = {value} is not supported", name)
    reader.journal.mark(card.source, UNUSED, "without effect on the model")


def read_parameters(reader):
    """Reads PARAM of bulk data and of case control into the parameters of the reader."""
    for name, words, source in reader.control.parameters:
        _parameter(reader, name, words, source)
    for card in reader.deck.each("PARAM"):
        words = [card.word(number) for number in range(2, len(card.fields) + 1)]
        _parameter(reader, card.word(1), words, card.source)


def _parameter(reader, name, words, source):
    journal = reader.journal
    value = words[0] if words else ""
    try:
        if name in ("WTMASS", "G", "W3", "W4"):
            number = real(value)
            if name == "WTMASS" and number <= 0:
                raise Fault("the factor of masses must be positive")
            reader.parameters[name] = number
            journal.mark(source, USED)
        elif name == "COUPMASS":
            reader.parameters[name] = real(value)
            journal.mark(source, USED, "masses of elements are consistent")
        elif name in ("LGDISP", "INREL", "LMODESFL", "NLTOL"):
            if value not in ("", "0", "-1", "NO"):
                raise Fault(f"{name} = {value} is not supported", name)
            journal.mark(source, UNUSED, "without effect at this value")
        elif name in HARMLESS:
            journal.mark(source, UNUSED, f"{name}: without effect on the model")
        else:
            raise Fault("this parameter is not supported", name or None)
    except Fault as fault:
        journal.refuse(source, fault.reason, fault.name)


def damp(reader):
    """PARAM,G is a loss factor of all elements: that of materials is added to it."""
    factor = reader.parameters.get("G", 0.0)
    if not factor:
        return
    journal, model = reader.journal, reader.model
    if not reader.selection.complex:
        journal.choose("PARAM,G is not used: modes without damping are computed")
    elif reader.parameters.get("W3"):
        frequency = reader.parameters["W3"] / 6.283185307179586
        for one in model.materials.values():
            own, at = one.loss or (0.0, frequency)
            if own and abs(at - frequency) > 1e-9 * frequency:
                journal.refuse_model("PARAM,W3 and PARAM,W4 differ: one frequency is supported")
            one.loss = own + factor, frequency
        if model.bushings:
            journal.choose("PARAM,G acts on solid elements, not on springs and bushings")
    else:
        journal.refuse_model(
            "PARAM,G needs the frequency at which the damping is exact: give PARAM,W3 in rad/s"
        )
