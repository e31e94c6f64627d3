"""What the scripts that read the results of a run share: the files that they add to them, and what they need. To be imported first: a package
of Python that is not installed is then told in one line."""
import contextlib
import errno
import fcntl
import os
import re
import sys
from pathlib import Path

PACKAGES = {name: f"python3-{name}" for name in ("h5py", "matplotlib", "numpy", "pandas")} | {"vtkmodules": "python3-vtk9"}
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python"))
MANIFEST, LOCK = "manifest.txt", ".squeal.lock"


def program():
    return Path(sys.argv[0]).stem


def tell(kind, error, trace):
    """What Python calls for an exception that nobody has caught."""
    name = (getattr(error, "name", None) or "").partition(".")[0]
    if issubclass(kind, ModuleNotFoundError) and name in PACKAGES:
        print(f"{program()}: Python's package {name} is not installed; Debian has it in {PACKAGES[name]}", file=sys.stderr)
    else:
        sys.__excepthook__(kind, error, trace)


sys.excepthook = tell

from squeal.files import ResultsError, is_there, make_new, open_regular, read_text  # noqa: E402


class Results:
    """The files of a run; squeal.open() tells whether they are results. What save() adds to them is listed in their manifest, so that a later run removes it with them."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.manifest = self._manifest()

    def save(self, name, figure, **how):
        """Writes a figure, which appears under its name when it is whole. Nothing that is not listed is overwritten."""
        self.write(name, lambda path: figure.savefig(path, format=name.rpartition(".")[2], **how))

    def save_text(self, name, text):
        """Writes a text in the same way."""
        self.write(name, lambda path: path.write_text(text, encoding="utf-8"))

    def write(self, name, write):
        """Calls write(path) and puts what it writes there in its place in the same way."""
        try:
            with self._waiting(name) as waiting:
                write(waiting)
                with waiting.open("rb") as file:
                    os.fsync(file.fileno())
                with self._lock():
                    self._add(name)
                    is_there(self.folder / name)
                    os.replace(waiting, self.folder / name)
        except ResultsError as error:
            sys.exit(f"{program()}: {error}")
        except OSError as error:
            sys.exit(f"{program()}: cannot write {self.folder / name}: {error.strerror}")

    @contextlib.contextmanager
    def _waiting(self, name):
        """A new file beside the one that it becomes; it goes if it does not."""
        path = self.folder / f".{name}.{os.getpid()}"
        make_new(path)  # another's link of this name would lead elsewhere
        try:
            yield path
        finally:
            path.unlink(missing_ok=True)

    def _manifest(self):
        """Its lines; none in results of version 0.1.0, which kept none."""
        try:
            lines = read_text(self.folder / MANIFEST).splitlines()
        except (FileNotFoundError, NotADirectoryError):
            return None
        except ResultsError as error:
            sys.exit(f"{program()}: {error}")
        return lines if lines and lines[0].startswith("# squeal ") else None

    def _add(self, name):
        if self._manifest() != self.manifest:
            sys.exit(f"{program()}: the results in {self.folder} have been replaced meanwhile")
        if self.manifest is None or name in self.manifest:
            return
        if os.path.lexists(self.folder / name):
            sys.exit(f"{program()}: {self.folder / name} is in the way: no run lists it in {MANIFEST}; move it")
        head, *paths = self.manifest
        paths = sorted([*paths, name])
        count = sum(not path.endswith("/") for path in paths)
        lines = [re.sub(r"the \d+ files", f"the {count} files", head), *paths]
        with self._waiting(MANIFEST) as waiting:
            with waiting.open("w") as file:
                file.write("\n".join(lines) + "\n")
                file.flush()
                os.fsync(file.fileno())
            os.replace(waiting, self.folder / MANIFEST)
        self.manifest = lines

    @contextlib.contextmanager
    def _lock(self):
        """As the program locks (src/output/lock.cpp): one that writes at a time."""
        path = self.folder / LOCK
        file = open_regular(path, os.O_RDWR | os.O_CREAT)
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            if error.errno == errno.EWOULDBLOCK:
                os.close(file)
                sys.exit(f"{program()}: a run is writing to {self.folder}")
        try:
            yield
        finally:
            if os.path.lexists(path) and os.path.samestat(os.lstat(path), os.fstat(file)):
                path.unlink()
            os.close(file)
