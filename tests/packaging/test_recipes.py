#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The recipes for Spack and Apptainer, as far as that can be checked without these programs:
test_recipes.py BUILD_FOLDER.

Spack's directives are played by a minimal stand-in that records them; the packages of the
definition file are looked up in apt.
"""
import re
import shlex
import subprocess
import sys
import types
import unittest
from pathlib import Path

repository = Path(__file__).resolve().parents[2]
BUILD = Path(sys.argv.pop(1)) if len(sys.argv) > 1 else repository / "build"
RECIPE = repository / "packaging/spack/package.py"
DEFINITION = repository / "packaging/apptainer/squeal.def"
# Of Spack's dependencies the ones that each requirement of CMakeLists.txt means.
MEANING = {
    "MPI": "mpi",
    "PkgConfig": "pkgconfig",
    "PETSC": "petsc",
    "HDF5": "hdf5",
    "FFTW": "fftw",
    "Boost": "boost",
    "LAPACK": "lapack",
    "nlohmann_json": "nlohmann-json",
    "ZLIB": "zlib-api",
    "VTK": "vtk",
    "METIS": "metis",
    "GMSH": "gmsh",
    "YAML": "libyaml",
    "MUMPS": "mumps",
    "GTest": "googletest",
    "MATIO": "matio",
}


class Recorded:
    """Runs the recipe with directives that record how they are called, each only with the arguments
    that Spack's has."""

    SIGNATURES = {
        "version": {"sha256", "url", "branch", "tag", "commit", "preferred", "deprecated"},
        "variant": {"default", "description", "values", "multi", "when", "sticky"},
        "depends_on": {"when", "type", "patches"},
        "conflicts": {"when", "msg"},
        "license": {"checked_by", "when"},
        "generator": {"default"},
    }

    def __init__(self):
        self.calls = []
        self.conditions = []
        module = types.ModuleType("spack.package")
        for name, known in self.SIGNATURES.items():
            setattr(module, name, self.directive(name, known))
        module.CMakePackage = type(
            "CMakePackage",
            (),
            {
                "run_tests": False,
                "define": staticmethod(lambda name, value: (name, value)),
                "define_from_variant": lambda self, name, variant: (name, variant),
            },
        )
        module.when = self.when
        module.run_after = (
            lambda phase: lambda function: setattr(function, "after", phase) or function
        )
        module.join_path = lambda *parts: "/".join(map(str, parts))
        module.filter_file = lambda pattern, text, *files: self.filtered.append((pattern, files))
        module.__all__ = [name for name in vars(module) if not name.startswith("_")]
        self.filtered = []
        sys.modules.update({"spack": types.ModuleType("spack"), "spack.package": module})
        scope = {"__name__": "package"}
        exec(compile(RECIPE.read_text(), RECIPE, "exec"), scope)
        self.classes = [
            thing
            for thing in scope.values()
            if isinstance(thing, type) and issubclass(thing, module.CMakePackage)
        ]
        self.recipe = next(thing for thing in self.classes if thing is not module.CMakePackage)

    def directive(self, name, known):
        def record(*words, **named):
            assert words and all(
                isinstance(word, str) for word in words
            ), f"{name}: a text is expected first"
            assert set(named) <= known, f"{name}({words[0]}): Spack knows no {set(named) - known}"
            self.calls.append((name, words, named, list(self.conditions)))

        return record

    def when(self, condition):
        recorded = self

        class Context:
            def __enter__(self):
                recorded.conditions.append(condition)

            def __exit__(self, *_):
                recorded.conditions.pop()

        return Context()

    def of(self, name):
        return [
            (words, named, conditions)
            for kind, words, named, conditions in self.calls
            if kind == name
        ]


class Spack(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.recorded = Recorded()
        cls.cmake = (repository / "CMakeLists.txt").read_text()

    def names(self, tests):
        """Of the packages that are needed, whatever the variants: those of the tests, or all
        others."""
        return {
            re.match(r"[\w-]+", words[0])[0]
            for words, named, conditions in self.recorded.of("depends_on")
            if (named.get("type") == "test") == tests and not conditions and "when" not in named
        }

    def test_class(self):
        self.assertEqual(self.recorded.recipe.__name__, "Squeal")
        self.assertGreater(len(self.recorded.recipe.__doc__), 20)
        version = re.search(r"project\(squeal VERSION (\S+)", self.cmake)[1]
        self.assertEqual([words for words, _, _ in self.recorded.of("version")], [(version,)])
        least = re.search(r"cmake_minimum_required\(VERSION (\S+)\)", self.cmake)[1]
        self.assertIn(
            (f"cmake@{least}:",), [words for words, _, _ in self.recorded.of("depends_on")]
        )

    def required(self, text):
        names = set(
            re.findall(
                r"^(?:find_package|import_library|pkg_check_modules|pkg_search_module)\((\w+)",
                text,
                re.M,
            )
        )
        return {MEANING[name] for name in names} | ({"slepc"} if "PETSC" in names else set())

    def test_dependencies_are_those_of_cmake(self):
        self.assertEqual(
            self.names(tests=False) - {"c", "cxx", "cmake", "ninja"}, self.required(self.cmake)
        )
        self.assertEqual(
            self.names(tests=True), self.required((repository / "tests/CMakeLists.txt").read_text())
        )

    def test_variants(self):
        variants = {words[0] for words, _, _ in self.recorded.of("variant")}
        conditions = [
            condition
            for _, named, outer in self.recorded.of("depends_on")
            for condition in [named.get("when"), *outer]
            if condition
        ]
        self.assertEqual({condition.lstrip("+~") for condition in conditions}, variants)
        options = re.findall(r"^(\w+):BOOL=", (BUILD / "CMakeCache.txt").read_text(), re.M)
        for name, value in self.recorded.recipe().cmake_args():
            self.assertTrue(name in options, f"CMake has no option {name}")
            self.assertTrue(isinstance(value, bool) or value in variants, value)

    def test_python_of_the_commands(self):
        """The recipe puts Spack's Python into every script that has Debian's in its first line."""

        class Spec(dict):
            def __contains__(self, text):
                return text == "+report" or dict.__contains__(self, text)

        recipe = self.recorded.recipe()
        recipe.spec = Spec(
            python=types.SimpleNamespace(command=types.SimpleNamespace(path="/python"))
        )
        recipe.prefix = types.SimpleNamespace(share="share")
        recipe.use_python_of_spack()
        pattern = {pattern for pattern, _ in self.recorded.filtered}.pop()
        installed = re.search(
            r"set\(commands (.*?)\)", (repository / "packaging/CMakeLists.txt").read_text()
        )[1].split()
        installed += re.findall(
            r"\.\./scripts/([\w./-]+)", (repository / "packaging/CMakeLists.txt").read_text()
        )
        installed = [name for name in installed if (repository / "scripts" / name).is_file()]
        wanted = {
            name
            for name in installed
            if re.search(pattern, (repository / "scripts" / name).read_text())
        }
        self.assertEqual(
            {Path(file).name for _, files in self.recorded.filtered for file in files}, wanted
        )


def stages():
    """Of the definition file: header, and the text of the sections by name."""
    found = []
    section = None
    for line in DEFINITION.read_text().splitlines():
        if line.startswith("Bootstrap:"):
            found.append({"header": {}, "sections": {}})
            section = None
        if line.startswith("%"):
            section = line.strip()
            found[-1]["sections"][section] = []
        elif section:
            found[-1]["sections"][section].append(line.strip())
        elif ":" in line and not line.startswith("#"):
            name, value = line.split(":", 1)
            found[-1]["header"][name] = value.strip()
    return found


class Apptainer(unittest.TestCase):
    def test_stages(self):
        build, final = stages()
        self.assertEqual(
            [stage["header"] for stage in (build, final)],
            [
                {"Bootstrap": "docker", "From": "debian:bookworm", "Stage": name}
                for name in ("build", "final")
            ],
        )
        self.assertEqual(set(build["sections"]), {"%files", "%post"})
        self.assertIn(f"%files from {build['header']['Stage']}", final["sections"])
        made = re.search(r"cpack .*-B (\S+)", "\n".join(build["sections"]["%post"]))[1]
        self.assertTrue(final["sections"]["%files from build"][0].startswith(made + "/squeal_"))

    def test_scripts_are_shell(self):
        for stage in stages():
            for name, lines in stage["sections"].items():
                if name in ("%post", "%runscript", "%test"):
                    run = subprocess.run(
                        ["sh", "-n"],
                        input="\n".join(lines),
                        text=True,
                        capture_output=True,
                        check=False,
                    )
                    self.assertEqual(run.stderr, "", name)

    def test_what_it_names_is_there(self):
        names = []
        for stage in stages():
            for line in stage["sections"]["%post"]:
                if line.startswith("apt-get install"):
                    # What the package recommends is looked up below
                    words = re.sub(r"\$\(.*\)", "", line).split()[2:]
                    names += [word for word in words if re.fullmatch(r"[a-z0-9][a-z0-9.+-]+", word)]
                for script in re.findall(r"/source/(scripts/\S+)", line):
                    self.assertTrue((repository / script).exists(), script)
        setup = re.search(
            r"packages=\((.*?)\n\)", (repository / "scripts/setup").read_text(), re.S
        )[1]
        names += shlex.split(setup, comments=True)  # the first stage calls it
        package = (repository / "packaging/CMakeLists.txt").read_text()
        for field in ("DEPENDS", "RECOMMENDS", "SUGGESTS"):
            found = re.search(rf'CPACK_DEBIAN_PACKAGE_{field}\s+"(.*?)"', package, re.S)[1]
            names += found.replace("\\\n", "").split(", ")
        self.assertGreater(len(names), 20)
        policy = subprocess.run(
            ["apt-cache", "policy", *names], check=True, capture_output=True, text=True
        ).stdout
        found = dict(re.findall(r"^(\S+):\n  Installed: .*\n  Candidate: (.*)", policy, re.M))
        if not list(Path("/var/lib/apt/lists").glob("*_Packages*")):
            self.skipTest("apt has no lists of packages here; apt-get update fetches them")
        self.assertEqual(
            [name for name in names if found.get(name, "(none)") == "(none)"],
            [],
            "apt knows no such package",
        )


if __name__ == "__main__":
    unittest.main(verbosity=2)
