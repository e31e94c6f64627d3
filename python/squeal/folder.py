# SPDX-License-Identifier: BSD-2-Clause
"""Writes to folders of results, by the rules of the program (src/base/output).

manifest.txt lists the files of a run, so that a later run removes no others. Whoever writes to the
folder holds a lock on .squeal.lock. A file appears under its name when it is complete.
"""
import contextlib
import errno
import fcntl
import os
import re
import shutil
import tempfile
from pathlib import Path

from squeal.files import ResultsError, is_there, make_new, open_regular, read_text

MANIFEST, LOCK = "manifest.txt", ".squeal.lock"


def read_manifest(folder):
    """The lines of the manifest, its head first. None if a folder has no manifest: then nothing
    lists its files."""
    try:
        lines = read_text(Path(folder) / MANIFEST).splitlines()
    except (FileNotFoundError, NotADirectoryError):
        return None
    return lines if lines and lines[0].startswith("# squeal ") else None


def write_manifest(folder, version):
    """Lists all files of a new folder."""
    names = sorted([*(path.name for path in folder.iterdir()), MANIFEST])
    head = f"# squeal {version}: the {len(names)} files of a run"
    (folder / MANIFEST).write_text("\n".join([head, *names]) + "\n")


class Folder:
    """The folder of a run, to which save() adds files and lists them in the manifest, so that a
    later run removes them with its own. squeal.open() checks whether it holds results."""

    def __init__(self, folder):
        self.path = Path(folder)
        self.manifest = read_manifest(self.path)

    def save(self, name, figure, **how):
        """Writes a figure of matplotlib. Overwrites only files that the manifest lists."""
        ending = name.rpartition(".")[2]
        return self.write(name, lambda path: figure.savefig(path, format=ending, **how))

    def save_text(self, name, text):
        """Writes a text in the same way."""
        return self.write(name, lambda path: path.write_text(text, encoding="utf-8"))

    def write(self, name, write):
        """Calls write(path), then moves the file to its name; returns its path."""
        path = self.path / name
        try:
            with self._waiting(name) as waiting:
                write(waiting)
                _flush(waiting)
                with self._lock():
                    self._add(name)
                    is_there(path)
                    os.replace(waiting, path)
        except OSError as error:
            raise ResultsError(f"cannot write {path}: {error.strerror}") from None
        return path

    @contextlib.contextmanager
    def _waiting(self, name):
        """A new file in the folder, which is removed unless it has been moved to its name."""
        path = self.path / f".{name}.{os.getpid()}"
        make_new(path)  # a link of this name that somebody else has made would lead elsewhere
        try:
            yield path
        finally:
            path.unlink(missing_ok=True)

    def _add(self, name):
        if read_manifest(self.path) != self.manifest:
            raise ResultsError(f"the results in {self.path} have been replaced meanwhile")
        if self.manifest is None or name in self.manifest:
            return
        if os.path.lexists(self.path / name):
            raise ResultsError(
                f"{self.path / name} is in the way: {MANIFEST} does not list it; move it"
            )
        head, *paths = self.manifest
        paths = sorted([*paths, name])
        count = sum(not path.endswith("/") for path in paths)
        lines = [re.sub(r"the \d+ files", f"the {count} files", head), *paths]
        with self._waiting(MANIFEST) as waiting:
            waiting.write_text("\n".join(lines) + "\n")
            _flush(waiting)
            os.replace(waiting, self.path / MANIFEST)
        self.manifest = lines

    @contextlib.contextmanager
    def _lock(self):
        """Locks the folder as the program does (src/base/output/lock.cpp)."""
        path = self.path / LOCK
        file = open_regular(path, os.O_RDWR | os.O_CREAT)
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            if error.errno == errno.EWOULDBLOCK:  # otherwise the file system has no locks
                os.close(file)
                raise ResultsError(f"a run is writing to {self.path}") from None
        try:
            yield
        finally:
            if os.path.lexists(path) and os.path.samestat(os.lstat(path), os.fstat(file)):
                path.unlink()
            os.close(file)


@contextlib.contextmanager
def new_folder(out):
    """A new folder that takes the place of `out` when it is complete."""
    out = Path(out)
    try:
        out.parent.mkdir(parents=True, exist_ok=True)
        new = Path(tempfile.mkdtemp(prefix=f".{out.name}.", dir=out.parent))
    except OSError as error:
        raise ResultsError(f"cannot write {out}: {error.strerror}") from None
    try:
        yield new
        new.chmod(0o777 & ~_mask())
        for path in new.iterdir():
            _flush(path)
        earlier = new.with_name(new.name + ".earlier")
        if out.exists():
            out.rename(earlier)
        new.rename(out)
        shutil.rmtree(earlier, ignore_errors=True)
    except OSError as error:
        raise ResultsError(f"cannot write {out}: {error.strerror}") from None
    finally:
        shutil.rmtree(new, ignore_errors=True)


def _flush(path):
    """Waits until the content of a file is on the disk."""
    with path.open("rb") as file:
        os.fsync(file.fileno())


def _mask():
    mask = os.umask(0)
    os.umask(mask)
    return mask


__all__ = ["LOCK", "MANIFEST", "Folder", "new_folder", "read_manifest", "write_manifest"]
