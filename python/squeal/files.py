# SPDX-License-Identifier: BSD-2-Clause
"""Opens files in a folder of results only if they are regular files: a link of the same name leads
to a foreign file, and a pipe blocks."""
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
    """A folder holds no complete results, or not what was asked for."""


def why_not_regular(path):
    """A sentence such as "PATH is a link, not a regular file"; none where nothing, or a regular
    file, has this name."""
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
    """Whether a regular file has this name. Raises ResultsError where something else has it."""
    why = why_not_regular(path)
    if why:
        raise ResultsError(why)
    return os.path.lexists(path)


def open_regular(path, flags=os.O_RDONLY):
    """Opens a regular file as os.open does, and never waits. Raises ResultsError where something
    else has its name, and OSError."""
    why = why_not_regular(path)
    if why:
        raise ResultsError(why)
    try:
        file = os.open(
            path, (flags & ~os.O_TRUNC) | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC, 0o666
        )
    except OSError as error:
        if error.errno in (errno.ELOOP, errno.ENXIO):  # put there meanwhile
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
    """The text of a file. Raises ResultsError where it cannot be read, or is not text;
    FileNotFoundError where there is none."""
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
    """Makes an empty file, of which nothing has the name yet: what is written to it goes nowhere
    else."""
    os.close(
        os.open(
            Path(path), os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC, 0o666
        )
    )


__all__ = ["ResultsError", "is_there", "make_new", "open_regular", "read_text", "why_not_regular"]
