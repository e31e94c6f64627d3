#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The Debian package: made of a build, installed and used in a clean Debian 12, removed again:
test_debian.py BUILD_FOLDER, as root.

The chroot is made from the package sources of this machine. The test first
installs only the dependencies, then the recommended packages too.
"""
import csv
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(repository / "python"))

from squeal.matching import match

BUILD = Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else repository / "build"
RELEASE = "bookworm"
# The commands run in a space of their own for mounts and processes, so that nothing stays when the
# test is stopped.
ENTER = """
mount -t proc proc "$0/proc" && mount --rbind /sys "$0/sys" && mount -t tmpfs tmpfs "$0/dev/shm" &&
exec chroot "$0" /bin/bash -euc "$1"
"""


def commands_of_image(section):
    """The lines of a section of the last stage of the Apptainer image: what installs the package
    there, installs it here."""
    stage = (repository / "packaging/apptainer/squeal.def").read_text().split("Stage: final\n")[1]
    return [
        line.strip()
        for line in re.search(rf"(?ms)^%{section}$(.*?)(?=^%|\Z)", stage)[1].splitlines()
        if line.strip()
    ]


def apt_sources():
    """The files of this machine that name archives of the release."""
    places = [Path("/etc/apt/sources.list"), *sorted(Path("/etc/apt/sources.list.d").glob("*"))]
    return [
        path
        for path in places
        if path.suffix in (".list", ".sources") and path.is_file() and RELEASE in path.read_text()
    ]


def apt_options():
    """How this machine reaches archives: proxies, certificates, dates."""
    dump = subprocess.run(["apt-config", "dump"], check=True, capture_output=True, text=True).stdout
    return [
        f"--aptopt={line.rstrip(';')}"
        for line in dump.splitlines()
        if re.match(r"Acquire::(?!Languages|Changelogs|IndexTargets)[\w:/.-]+ \".+\"", line)
    ]


def eigenvalues(text):
    """Of each friction, as complex numbers."""
    found = {}
    for row in csv.DictReader(text.splitlines()):
        found.setdefault(row["friction"], []).append(
            complex(float(row["growth_rate_1_per_s"]), float(row["angular_frequency_rad_per_s"]))
        )
    return found


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if os.geteuid() != 0:
            sys.exit("test_debian: only root can make a chroot")
        cls.place = Path(tempfile.mkdtemp(prefix="squeal_debian_"))
        cls.addClassCleanup(shutil.rmtree, cls.place)
        os.umask(0o022)
        cls.run_here("cpack", "--config", BUILD / "CPackConfig.cmake", "-G", "DEB", "-B", cls.place)
        cls.package = next(cls.place.glob("*.deb"))
        cls.root = cls.place / "root"
        cls.run_here(
            "mmdebstrap",
            "--mode=root",
            "--variant=apt",
            "--include=debian-archive-keyring",
            *apt_options(),
            RELEASE,
            cls.root,
            *apt_sources(),
        )
        shutil.copy(cls.package, cls.root / "opt")
        cls.install, cls.install_recommended = (
            line for line in commands_of_image("post") if line.startswith("apt-get install")
        )
        cls.inside("useradd --create-home engineer")
        cls.before = cls.files()

    @classmethod
    def run_here(cls, *words):
        run = subprocess.run(
            words,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            check=False,
            timeout=1200,
        )
        if run.returncode:
            # Unlike sys.exit, it lets the cleanup run
            raise RuntimeError(f"{' '.join(map(str, words))} failed:\n{run.stdout}")
        return run.stdout

    @classmethod
    def inside(cls, commands, status=0):
        """Runs commands of bash in the chroot; returns what they printed."""
        kept = {
            name: value
            for name, value in os.environ.items()
            if name.startswith(("OMPI_", "OMP_", "OPENBLAS_")) or name.endswith("_proxy")
        }
        run = subprocess.run(
            [
                "unshare",
                "--mount",
                "--pid",
                "--fork",
                "--kill-child",
                "sh",
                "-c",
                ENTER,
                cls.root,
                commands,
            ],
            text=True,
            env={
                **kept,
                "PATH": "/usr/sbin:/usr/bin:/sbin:/bin",
                "HOME": "/root",
                "LANG": "C.UTF-8",
                "DEBIAN_FRONTEND": "noninteractive",
            },
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            timeout=1800,
            check=False,
        )
        if run.returncode != status:
            raise AssertionError(
                f"{commands}: exit code {run.returncode}, not {status}:\n{run.stdout[-4000:]}"
            )
        return run.stdout

    @classmethod
    def by_user(cls, command, status=0):
        return cls.inside(f"su - engineer -c {shlex.quote('set -e; ' + command)}", status)

    @classmethod
    def files(cls):
        """All names in the chroot that hold the name of the program, except those that the user and
        apt keep."""
        found = subprocess.run(
            ["find", cls.root, "-xdev", "-iname", "*squeal*", "-printf", "/%P\n"],
            check=True,
            capture_output=True,
            text=True,
        )
        return sorted(
            path for path in found.stdout.split("\n") if path and path.split("/")[1] != "home"
        )

    def field(self, name):
        return self.run_here("dpkg-deb", "-f", self.package, name).strip()

    def test_1_description(self):
        self.assertEqual(self.field("Package"), "squeal")
        self.assertEqual(self.field("Section"), "math")
        needs = [word.split()[0] for word in self.field("Depends").split(", ")]
        for name in ("libgmsh4.8", "libpetsc-real3.18", "libvtk9.1", "openmpi-bin", "python3-h5py"):
            self.assertIn(name, needs)
        for name in ("libjs-three", "libjs-chart.js", "libopenblas0-pthread", "xvfb"):
            self.assertIn(name, self.field("Recommends").split(", "))
        content = self.run_here("dpkg-deb", "-c", self.package)
        for line in content.splitlines():
            mode, owner = line.split()[:2]
            self.assertEqual(owner, "root/root", line)
            self.assertIn(mode, ("drwxr-xr-x", "-rw-r--r--", "-rwxr-xr-x", "lrwxrwxrwx"), line)
        for name in (
            "share/man/man1/squeal.1.gz",
            "share/doc/squeal/copyright",
            "share/bash-completion/completions/squeal",
            "bin/squeal-run",
            "libexec/squeal/squeal_gmsh",
        ):
            self.assertRegex(content, rf"(?m) \./usr/{re.escape(name)}( -> .*)?$")

    def test_2_dependencies_alone(self):
        self.inside(f"apt-get update; {self.install}")
        printed = self.by_user(
            "mkdir work && cd work && squeal-run layer && squeal-plot results/layer &&"
            " squeal-report results/layer"
        )
        self.assertIn("friction 0.6", printed)
        self.compare("layer")
        self.assertIn("libraries three.js and Chart.js were not installed", self.report())
        self.assertIn("xvfb", self.by_user("cd work; squeal-plot mode results/layer", 1))
        self.by_user("python3 -c \"import squeal; squeal.open('work/results/layer')\"")
        self.assertIn("GPL-2+", (self.root / "usr/share/doc/squeal/copyright").read_text())
        size = self.inside("apt-get -q clean; du -shx / | cut -f1").strip()
        print(f"Debian with the package and its dependencies: {size}", flush=True)

    def test_3_recommended_too(self):
        self.inside(self.install_recommended)
        self.inside("; ".join(commands_of_image("test")))
        self.by_user("cd work; squeal-run layer; squeal-plot mode results/layer 0.4")
        self.compare("layer")
        self.assertNotIn("were not installed", self.report())
        self.assertGreater(
            (self.root / "home/engineer/work/results/layer/mode.png").stat().st_size, 10000
        )
        # Root as well leaves nothing in the installation: bytecode was made when it was installed.
        self.inside(
            "cd ~engineer/work; python3 -c 'import squeal.report'; squeal-report"
            " results/layer; dpkg --verify squeal"
        )

    def test_4_removal(self):
        self.inside(
            "apt-get -q remove --yes squeal; ! dpkg-query -W -f '${Status}' squeal 2>/dev/null |"
            " grep ' installed'"
        )
        self.assertEqual(self.files(), self.before)

    def report(self):
        return (self.root / "home/engineer/work/results/layer/report.html").read_text()

    def compare(self, case):
        """The eigenvalues with those of the build's own run, to the tolerance they are certified
        to."""
        own = self.place / "own"
        if not own.exists():
            self.run_here(
                BUILD / "squeal",
                "-options_file",
                repository / f"options/{case}.yaml",
                "-report_dir",
                own,
                "-quiet",
            )
        wanted, found = (
            eigenvalues((folder / "eigenvalues.csv").read_text())
            for folder in (own, self.root / f"home/engineer/work/results/{case}")
        )
        self.assertEqual(list(wanted), list(found))
        for friction, values in wanted.items():
            self.assertGreater(len(values), 100)
            self.assertEqual(len(values), len(found[friction]))
            self.assertGreaterEqual(
                min(match(values, found[friction], farthest=1e-8)), 0, f"friction {friction}"
            )


if __name__ == "__main__":
    unittest.main(verbosity=2, failfast=True)
