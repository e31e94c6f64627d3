#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""What `cmake --install` puts in place works elsewhere, read-only, for another user:
test_install.py CMAKE BUILD_FOLDER."""
import os
import re
import shutil
import stat
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[2]
CMAKE, BUILD = (
    (sys.argv.pop(1), Path(sys.argv.pop(1)))
    if len(sys.argv) > 2
    else ("cmake", repository / "build")
)
CASES = sorted(path.stem for path in (repository / "options").glob("*.yaml"))
SCRIPTS = tuple(f"squeal-{name}" for name in ("report", "plot", "merge", "compare", "import"))
COMMANDS = {"squeal", "squeal-run", *SCRIPTS}
SMALL = [
    "-mesh_set",
    "nx=12,ny=4",
    "-modes_count",
    "40",
    "-flutter_friction",
    "0,0.4",
    "-flutter_shapes",
    "2",
]


def below(folder, pattern="*"):
    """Names of the files of a folder, as seen from it."""
    return {
        str(path.relative_to(folder))
        for path in Path(folder).rglob(pattern)
        if not path.is_dir() and "__pycache__" not in path.parts
    }


class Installation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = Path(tempfile.mkdtemp(prefix="squeal_install_"))
        cls.addClassCleanup(cls.remove)
        cls.place.chmod(0o755)
        first, cls.prefix = cls.place / "first", cls.place / "moved to here" / "prefix"
        os.umask(0o022)
        subprocess.run(
            [CMAKE, "--install", BUILD, "--prefix", first], check=True, stdout=subprocess.DEVNULL
        )
        # Whoever may write there leaves no bytecode. The folder holds no results, which the
        # commands find when they have loaded all.
        for command in SCRIPTS:
            subprocess.run(
                [first / "bin" / command, first],
                check=False,
                capture_output=True,
                env={"PATH": "/usr/bin:/bin"},
            )
        cls.prefix.parent.mkdir()
        first.rename(cls.prefix)
        cls.first = first
        cls.data = cls.prefix / "share/squeal"
        for path in [cls.prefix, *cls.prefix.rglob("*")]:
            if not path.is_symlink():
                path.chmod(stat.S_IMODE(path.stat().st_mode) & ~0o222)
        cls.before = cls.state()
        cls.home = cls.place / "home"
        cls.work = cls.home / "work"
        cls.work.mkdir(parents=True)
        cls.other_user = []
        if os.geteuid() == 0:  # whom no permission of a file stops
            cls.other_user = [
                shutil.which("setpriv"),
                "--reuid",
                "nobody",
                "--regid",
                "nogroup",
                "--clear-groups",
            ]
            for path in (cls.home, cls.work):
                shutil.chown(path, "nobody", "nogroup")
        print(
            (
                "test_install: the commands run as"
                f" {'nobody' if cls.other_user else 'the caller, who is not root'}"
            ),
            flush=True,
        )

    @classmethod
    def remove(cls):
        for path in [cls.place, *cls.place.rglob("*")]:
            if path.is_dir() and not path.is_symlink():
                path.chmod(0o755)
        shutil.rmtree(cls.place)

    @classmethod
    def state(cls):
        return {
            path: (path.lstat().st_mtime_ns, path.lstat().st_size) for path in cls.prefix.rglob("*")
        }

    def call(self, *words, cwd=None, status=0, **variables):
        """Runs a command as a user would who has the commands on the PATH; returns what it
        printed."""
        kept = {
            name: value
            for name, value in os.environ.items()
            if name.startswith(("OMPI_", "OMP_", "OPENBLAS_"))
        }
        environment = {
            **kept,
            "PATH": f"{self.prefix}/bin:/usr/bin:/bin",
            "HOME": str(self.home),
            "LANG": "C.UTF-8",
            **variables,
        }
        run = subprocess.run(
            [*self.other_user, *words],
            cwd=cwd or self.work,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=120,
            check=False,
        )
        self.assertEqual(run.returncode, status, f"{words}:\n{run.stdout}")
        return run.stdout

    def test_files(self):
        self.assertEqual(below(self.prefix / "bin"), COMMANDS)
        for folder in ("options", "meshes", "web"):
            kept = {name for name in below(repository / folder) if not name.startswith("results/")}
            self.assertEqual(below(self.data / folder), kept, folder)
        self.assertEqual(
            below(self.data / "python") - {"example.ipynb"}, below(repository / "python", "*.py")
        )
        self.assertEqual(below(self.prefix / "share/man"), {f"man1/{name}.1" for name in COMMANDS})
        self.assertEqual(
            below(self.prefix / "share/bash-completion"),
            {f"completions/{name}" for name in ("squeal", "squeal-run")},
        )
        self.assertLessEqual(
            {"README.md", "LICENSE", "docs/method.md"}, below(self.prefix / "share/doc/squeal")
        )
        self.assertEqual(below(self.prefix / "libexec"), {"squeal/squeal_gmsh"})
        self.assertEqual({path.name for path in self.prefix.iterdir()}, {"bin", "libexec", "share"})
        self.assertEqual(list(self.prefix.rglob("__pycache__")), [])
        for case in (self.data / "options").glob("*.yaml"):
            schema = re.match(r"# yaml-language-server: \$schema=(\S+)\n", case.read_text())
            self.assertTrue(schema and (case.parent / schema[1]).is_file(), case.name)

    def test_nothing_of_the_build_is_named(self):
        names = [os.fsencode(path) for path in (BUILD.resolve(), repository, self.first)]
        for path in self.prefix.rglob("*"):
            if path.is_symlink():
                self.assertFalse(os.readlink(path).startswith("/"), path)
                self.assertTrue(
                    path.resolve(strict=True).is_relative_to(self.prefix.resolve()), path
                )
            elif path.is_file():
                content = path.read_bytes()
                self.assertEqual([name for name in names if name in content], [], path)

    def test_links_of_the_documents(self):
        documents = self.prefix / "share/doc/squeal"
        for name in (
            "README.md",
            "docs/method.md",
            "docs/performance.md",
            "options/README.md",
            "meshes/README.md",
            "packaging/README.md",
        ):
            for target in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", (documents / name).read_text()):
                # As a browser follows it, through links to folders
                path = os.path.normpath(documents / Path(name).parent / target)
                self.assertTrue(
                    os.path.exists(path),
                    (
                        f"{name} of the installation links to {target}: packaging/CMakeLists.txt"
                        " installs no such file"
                    ),
                )

    def test_a_case_runs_and_is_read(self):
        results = self.work / "results/layer"
        printed = self.call("squeal-run", "layer", *SMALL, NP="2")
        self.assertIn("friction 0.4", printed)
        self.assertIn(f"report: {os.path.relpath(results, self.work)}/report.html", printed)
        self.assertEqual([path.name for path in self.work.iterdir()], ["results"])
        # Head, 2 frictions
        self.assertEqual(
            len(
                {
                    line.split(",")[0]
                    for line in (results / "eigenvalues.csv").read_text().splitlines()
                }
            ),
            3,
        )
        for name in ("report.html", "stability.png"):
            self.assertGreater((results / name).stat().st_size, 10000, name)
            (results / name).unlink()
        self.call("squeal-plot", "results/layer")
        self.call("squeal-plot", "mode", "results/layer", "0.4")
        self.call("squeal-report", "results/layer")
        for name in ("stability.png", "mode.png"):
            self.assertEqual((results / name).read_bytes()[:8], b"\x89PNG\r\n\x1a\n", name)
        self.assertIn("Unstable", (results / "report.html").read_text())
        module = (
            "import squeal; print(len(squeal.open('results/layer').eigenvalues), squeal.__file__)"
        )
        count, file = self.call(
            "/usr/bin/python3", "-c", module, PYTHONPATH=str(self.data / "python")
        ).split(maxsplit=1)
        self.assertGreater(int(count), 10)
        self.assertTrue(file.startswith(str(self.prefix)), file)
        # A case of the user's has its results beside it.
        own = self.home / "own"
        self.call("mkdir", str(own))
        self.call("cp", str(self.data / "options/external.yaml"), str(own / "belt.yaml"))
        self.call("cp", "-r", str(self.data / "options/external"), str(own))
        self.call("chmod", "-R", "u+w", str(own))  # that a user may remove what was read-only
        self.call("squeal-run", "../own/belt.yaml", NP="1")
        self.assertTrue((own / "results/belt/report.html").exists())
        self.assertEqual([path.name for path in self.work.iterdir()], ["results"])

    def test_a_deck_runs(self):
        page = (repository / "docs/decks.md").read_text()
        (self.home / "decks").mkdir(mode=0o777)
        (self.home / "decks").chmod(0o777)
        deck = self.home / "decks/bracket.inp"
        deck.write_text(page.split("```")[1].lstrip())
        self.call("squeal-run", "../decks/bracket.inp", "-report_fields", "off", NP="1")
        folder = self.home / "decks/bracket"
        self.assertLessEqual({"mesh.msh", "case.yaml", "import.md"}, below(folder))
        modes = (folder / "results/case/modes.csv").read_text().splitlines()
        # docs/decks.md names these frequencies.
        self.assertEqual([round(float(row.split(",")[2])) for row in modes[1:]], [1362, 2623, 9049])
        deck.write_text("*SHELL SECTION\n")
        printed = self.call("squeal-run", "../decks/bracket.inp", status=1)
        self.assertIn("bracket.inp:1: *SHELL SECTION: shells are not supported", printed)

    def test_refusals(self):
        printed = self.call("squeal-run", "nosuch", status=1)
        self.assertIn("squeal-run: there is no case 'nosuch'", printed)
        self.assertEqual(printed.split()[-len(CASES) :], CASES)  # which ones there are
        closed = self.prefix / "share"  # not writable
        self.assertIn(
            "-report_dir: cannot write ./results",
            self.call("squeal-run", "external", cwd=closed, status=1, NP="1"),
        )
        without = self.home / "without_mpirun"
        without.mkdir()
        for name in ("bash", "env", "readlink", "dirname", "basename"):
            (without / name).symlink_to(shutil.which(name, path="/usr/bin:/bin"))
        printed = self.call(
            str(self.prefix / "bin/squeal-run"), "external", status=1, PATH=str(without)
        )
        self.assertEqual(
            printed,
            (
                "squeal-run: there is no mpirun on the PATH; it belongs to Open MPI (package"
                " openmpi-bin)\n"
            ),
        )
        hidden = self.home / "hidden/pandas"
        hidden.mkdir(parents=True)
        (hidden / "__init__.py").write_text("raise ModuleNotFoundError('', name='pandas')")
        printed = self.call("squeal-report", ".", status=1, PYTHONPATH=str(hidden.parent))
        self.assertEqual(
            printed,
            (
                "squeal-report: Python's package pandas is not installed; Debian has it in"
                " python3-pandas\n"
            ),
        )

    def test_completion(self):
        script = (
            '. "$0/squeal-run"; COMP_WORDS=(squeal-run %s); COMP_CWORD=%d; _squeal_run; echo'
            " ${COMPREPLY[*]}"
        )
        folder = str(self.prefix / "share/bash-completion/completions")
        for words, completed in (("lay", "layer"), ("layer -flutter_met", "-flutter_method")):
            self.assertEqual(
                self.call("bash", "-c", script % (words, len(words.split())), folder),
                completed + "\n",
            )

    def test_man_pages(self):
        if not shutil.which("man"):
            self.skipTest("there is no man (package man-db)")
        for name in COMMANDS:
            page = self.prefix / f"share/man/man1/{name}.1"
            self.assertEqual(
                self.call("man", "--warnings", "-E", "UTF-8", "-l", str(page)).count(
                    "<standard input>"
                ),
                0,
                name,
            )

    def test_zz_nothing_was_written_into_it(self):
        self.assertEqual(self.state(), self.before)


if __name__ == "__main__":
    unittest.main(verbosity=2)
