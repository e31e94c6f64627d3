# SPDX-License-Identifier: BSD-2-Clause
"""Fields of a line of bulk data: small fields of 8 columns, large ones of 16, or between commas.

A line has the name of its card, or the marker by which it continues one, then fields of data, and
in field 10 the marker of the line that continues it.
"""
from squeal.deck.journal import Fault

WIDTH, LARGE, DATA = 8, 16, 8  # columns of a field, of a large one; fields of data of a small line
LAST = WIDTH * (DATA + 1)  # columns before field 10
COLUMNS = range(WIDTH, LAST, WIDTH)


def head_of(text):
    """Returns the first field of a line: a name, a marker, or nothing."""
    return (text[: text.index(",")] if "," in text else text[:WIDTH]).strip()


def marker_of(text):
    """Returns the marker at the end of a line, without its first character."""
    if "," in text:
        fields = text.split(",")
        at = 5 if "*" in fields[0] else DATA + 1
        return fields[at].strip()[1:] if len(fields) > at else ""
    return text[LAST : LAST + WIDTH][1:].strip() if len(text) > LAST else ""


def data_of(text, line):
    """Returns the fields of data of a line, 8 or 4 of them if they are large. Raises Fault for
    fields that have no place."""
    if "," in text:
        fields = [field.strip() for field in text.split(",")]
        count = DATA // 2 if "*" in fields[0] else DATA
        if any(fields[count + 2 :]):
            raise Fault(f"a free-field line has at most {count + 2} fields", line=line)
        end = fields[count + 1] if len(fields) > count + 1 else ""
        if end and end[0] not in "+*":
            reason = f"'{end}' in field 10 does not begin with + or *, as a marker does"
            raise Fault(reason, line=line)
        data = fields[1 : count + 1]
        return data + [""] * (count - len(data))
    if "*" in text[:WIDTH]:
        return [text[at : at + LARGE].strip() for at in range(WIDTH, LAST, LARGE)]
    return [text[at : at + WIDTH].strip() for at in range(WIDTH, LAST, WIDTH)]


def joined(texts, numbers):
    """Returns the fields of data of all lines of a card, 8 for each small line and for each two
    large ones. Raises Fault."""
    if len(texts) == 1 and "*" not in texts[0][:WIDTH]:
        text = texts[0]
        if "," in text:
            return data_of(text, numbers[0])
        return [text[at : at + WIDTH].strip() for at in COLUMNS]
    found = []
    for text, number in zip(texts, numbers):
        if "," in text or "*" in text[:WIDTH]:
            data = data_of(text, number)
        else:
            data = [text[at : at + WIDTH].strip() for at in COLUMNS]
        if len(data) == DATA and len(found) % DATA:
            found += [""] * (DATA - len(found) % DATA)
        found += data
    return found + [""] * (-len(found) % DATA)
