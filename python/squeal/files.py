# SPDX-License-Identifier: BSD-2-Clause
"""Opens only regular files in a folder of results.

A link of the same name would lead to another file, and a named pipe would block.
"""
import errno
import os
import stat
from pathlib import Path

KINDS = (
    (stat.S_ISLNK, "a link"),
    (stat.S_ISDIR, "a folder"),
    (stat.S_ISFIFO, "a named pipe"),
    (stat.S_ISSOCK, "a socket"),
)


class ResultsError(Exception):
    """A folder holds no complete results, or not the results that were requested."""


def why_not_regular(path):
    """Returns a sentence such as "PATH is a link, not a regular file"; None for a regular file,
    or if there is no file."""
    try:
        mode = os.lstat(path).st_mode
    except OSError:
        return None
    if stat.S_ISREG(mode):
        return None
    return (
        f"{path} is {next((kind for is_one, kind in KINDS if is_one(mode)), 'a device')}, not a"
        " regular file"
    )


def is_there(path):
    """Returns whether there is a regular file. Raises ResultsError if something else has its
    name."""
    why = why_not_regular(path)
    if why:
        raise ResultsError(why)
    return os.path.lexists(path)


def open_regular(path, flags=os.O_RDONLY):
    """Opens a regular file as os.open does, but never blocks. Raises ResultsError if something
    else has its name, and OSError."""
    why = why_not_regular(path)
    if why:
        raise ResultsError(why)
    try:
        file = os.open(
            path, (flags & ~os.O_TRUNC) | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC, 0o666
        )
    except OSError as error:
        if error.errno in (errno.ELOOP, errno.ENXIO):  # somebody has put it there meanwhile
            raise ResultsError(f"{path} is not a regular file") from None
        raise
    try:
        if not stat.S_ISREG(os.fstat(file).st_mode):
            raise ResultsError(f"{path} is not a regular file")
        if flags & os.O_TRUNC:
            os.ftruncate(file, 0)
    except BaseException:
        os.close(file)
        raise
    return file


def read_text(path):
    """Returns the text of a file. Raises FileNotFoundError if there is no file, and ResultsError
    if it cannot be read or is not text."""
    try:
        with os.fdopen(open_regular(path), "rb") as file:
            return file.read().decode("utf-8")
    except FileNotFoundError:
        raise
    except OSError as error:
        raise ResultsError(f"{path}: {error.strerror}") from None
    except UnicodeDecodeError as error:
        raise ResultsError(f"{path} is not text: byte {error.start} is not UTF-8") from None


def make_new(path):
    """Creates an empty file under a name that is still free, so that nothing is written
    elsewhere."""
    os.close(
        os.open(
            Path(path), os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC, 0o666
        )
    )


__all__ = ["ResultsError", "is_there", "make_new", "open_regular", "read_text", "why_not_regular"]
