# SPDX-License-Identifier: BSD-2-Clause
"""The text of a file of a deck, and the place of an included one."""
import os

from squeal.files import open_regular

DEPTH = 20  # of files that include each other


def read_texts(path, name, journal):
    """Returns the lines of a file; `name` is its name in messages. Raises OSError."""
    with os.fdopen(open_regular(path), "rb") as file:
        data = file.read()
    if data.startswith(b"\xef\xbb\xbf"):
        data = data[3:]
        journal.choose(f"{name}: a byte order mark at the start is skipped")
    try:
        if data.startswith((b"\xff\xfe", b"\xfe\xff")):
            text = data.decode("utf-16")
            journal.choose(f"{name}: read as UTF-16")
        else:
            text = data.decode("utf-8")
    except UnicodeDecodeError:
        text = data.decode("latin-1")
        journal.choose(f"{name}: read as ISO 8859-1, since it is not UTF-8")
    return text.replace("\r\n", "\n").replace("\r", "\n").split("\n")


def find_included(name, path, root, above, journal, source):
    """Returns the path of a file that `path` includes; it is relative to that file or to the deck
    `root`. Refuses a file that is missing or endless, and then returns None."""
    places = list(dict.fromkeys([path.parent / name, root.parent / name]))
    found = next((place for place in places if place.is_file()), None)
    if found is None:
        where = " and ".join(map(str, places))
        journal.refuse(source, f"there is no file {where}")
    elif len(above) >= DEPTH or any(os.path.samefile(found, one) for one in above):
        journal.refuse(source, f"{name} includes itself, or files are nested too deeply")
    else:
        journal.mark(source, "used", str(found))
        return found
    return None
