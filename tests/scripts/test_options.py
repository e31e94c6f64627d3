#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""What scripts/dev/generate_options makes of the options of the program: test_options.py
PROGRAM."""
import json
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import jsonschema
import yaml

repository = Path(__file__).resolve().parents[2]
PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")


class Words(yaml.SafeLoader):
    """Scalars as the core schema of YAML 1.2 reads them, which editors use."""


Words.yaml_implicit_resolvers = {}
for kind, pattern, first in (
    ("bool", r"true|True|TRUE|false|False|FALSE", "tTfF"),
    ("int", r"[-+]?[0-9]+", "-+0123456789"),
    ("float", r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?", "-+.0123456789"),
    ("null", r"null|Null|NULL|~|", ["n", "N", "~", ""]),
    ("merge", r"<<", "<"),
):
    Words.add_implicit_resolver(
        f"tag:yaml.org,2002:{kind}", re.compile(f"^({pattern})$"), list(first)
    )


class Generated(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.schema = json.loads((repository / "options/schema.json").read_text())
        jsonschema.Draft202012Validator.check_schema(cls.schema)
        cls.validator = jsonschema.Draft202012Validator(cls.schema)

    def faults(self, text):
        return [error.message for error in self.validator.iter_errors(yaml.load(text, Words))]

    def test_files_are_those_of_the_program(self):
        subprocess.run(
            [repository / "scripts/dev/generate_options", "--check", PROGRAM], check=True
        )

    def test_cases_of_the_repository_pass_and_name_the_schema(self):
        for case in sorted((repository / "options").glob("*.yaml")):
            self.assertEqual(self.faults(case.read_text()), [], case.name)
            self.assertEqual(
                case.read_text().split("\n")[0],
                "# yaml-language-server: $schema=schema.json",
                case.name,
            )

    def test_names_may_be_cut_anywhere(self):
        for text in (
            "flutter: {friction: 0.4}",
            "flutter_friction: 0.4",
            "flutter: {friction: [0.1, 0.2]}",
            "flutter: {friction: 0:0.6:0.1}",
            "material: {brake_disc: {young: 1e11, rayleigh: {mass: 0}}}",
            "material_brake_disc_young: 1.0e11",
            "quiet:",
            "modes: {eps: {max_it: 7}, st_pc_type: lu}",
            "flutter: {friction_damping: on}",
            "log_view:",
        ):
            self.assertEqual(self.faults(text), [], text)

    def test_mistakes_are_found(self):
        for text in (
            "fluter: {friction: 0.4}",
            "flutter: {fricton: 0.4}",
            "flutter: {friction: -0.4}",
            "modes: {count: 1.5}",
            "flutter: {method: exact}",
            "flutter: {track: maybe}",
            "contact: 7",
            "[1, 2]",
        ):
            self.assertNotEqual(self.faults(text), [], text)

    def test_completion_completes(self):
        script = (
            f"source {repository}/packaging/squeal.bash; COMP_WORDS=(squeal %s); COMP_CWORD=%d;"
            " _squeal; echo ${COMPREPLY[*]}"
        )

        def completed(*words):
            return subprocess.run(
                ["bash", "-c", script % (" ".join(words), len(words))],
                check=True,
                capture_output=True,
                text=True,
            ).stdout.split()

        self.assertEqual(completed("-flutter_met"), ["-flutter_method"])
        self.assertEqual(set(completed("-flutter_method", "''")), {"reduced", "direct"})
        self.assertEqual(completed("-help", "st"), ["steady"])

    def test_the_man_page_is_well_formed(self):
        if not shutil.which("man"):
            self.skipTest("there is no man")
        made = subprocess.run(
            ["man", "--warnings", "-E", "UTF-8", "-l", repository / "packaging/squeal.1"],
            capture_output=True,
            text=True,
        )
        self.assertEqual((made.returncode, made.stderr), (0, ""))
        self.assertIn("-flutter_friction", made.stdout)


if __name__ == "__main__":
    unittest.main(verbosity=2)
