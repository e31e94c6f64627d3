#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The checks of scripts/dev, on small repositories and sources made here."""
import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

DEV = Path(__file__).resolve().parents[2] / "scripts/dev"
SPDX = "SPDX-License-Identifier: BSD-2-Clause"
SOURCE = """#include "low/low.hpp"
namespace high {
namespace {
const RealOption width("high", "width");
template <class T>
T twice(T x, std::map<int, int> y = {}) {
  if (x) { return {}; }
  return 2 * x;
}
struct Box {
  Box(int a, int b) : a_{a}, b_(b) {
    fill();
  }
  bool operator==(const Box& o) const { return a_ == o.a_; }
  std::vector<int> list{1, 2};
};
const std::vector<int> values = {1, 2};
double readWidth(
    int a,
    int b) {
  const char c = '{';  // {
  return width.get() + a + b;
}
void many(int a, int b, int c, int d, int e, int f, std::pair<int, int> g) {
LINES}
}  // namespace
}  // namespace high
"""


class Checks(unittest.TestCase):
    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.root = Path(place.name)
        shutil.copytree(DEV, self.root / "scripts/dev")
        self.environment = dict(os.environ, GIT_CONFIG_GLOBAL="/dev/null")
        for name in ("GIT_AUTHOR_NAME", "GIT_COMMITTER_NAME"):
            self.environment[name] = "somebody"
        for name in ("GIT_AUTHOR_EMAIL", "GIT_COMMITTER_EMAIL"):
            self.environment[name] = "somebody@squeal.invalid"
        self.git("init", "-q")

    def git(self, *words):
        subprocess.run(["git", *words], cwd=self.root, env=self.environment, check=True)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        self.git("add", name)
        return path

    def call(self, name, *words):
        command = [self.root / "scripts/dev" / name, *words]
        run = subprocess.run(
            command, cwd=self.root, env=self.environment, capture_output=True, text=True
        )
        return run.returncode, run.stdout, run.stderr

    def test_banned_words(self):
        text = "// It stands\n// in the way.\n// There is no file, and it is no longer there.\n"
        self.write("a.cpp", text + "// It is no file.\n// Alone, but for one.\n")
        self.write("script", '#!/bin/sh\necho "said anew"\n')
        self.write("picture.png", "anew")
        code, printed, _ = self.call("banned_words")
        found = ["a.cpp:1: stands in", "a.cpp:4: is no ", "a.cpp:5: but for", "script:2: anew"]
        self.assertEqual(printed.splitlines(), [*found, "banned_words: 4 banned words"])
        self.assertEqual(code, 1)
        self.assertEqual(self.call("banned_words", "--count", "a.cpp")[1], "3\n")
        self.assertEqual(self.call("banned_words", "picture.png")[0], 0)

    def test_spdx(self):
        sources = {
            "a.cpp": ("int x;\n", f"// {SPDX}\nint x;\n"),
            "a.css": ("b {}\n", f"/* {SPDX} */\nb {{}}\n"),
            "a.py": (f"x = 1\n# {SPDX}\n", f"# {SPDX}\nx = 1\n"),
            "run": ("#!/bin/sh\necho\n", f"#!/bin/sh\n# {SPDX}\necho\n"),
            "lib": ("# shellcheck shell=bash\n", f"# shellcheck shell=bash\n# {SPDX}\n"),
            "notes": ("text\n", "text\n"),
        }
        for name, (before, _) in sources.items():
            self.write(name, before)
        (self.root / "scripts/dev/spdx").chmod(0o755)
        code, printed, error = self.call("spdx")
        self.assertEqual((code, printed.split()), (1, ["a.cpp", "a.css", "a.py", "lib", "run"]))
        self.assertIn("5 files", error)
        self.assertEqual(self.call("spdx", "--fix")[0], 0)
        self.assertEqual(self.call("spdx"), (0, "", ""))
        for name, (_, after) in sources.items():
            self.assertEqual((self.root / name).read_text(), after)

    def test_commit_subjects(self):
        good = ["Add a check", "Pass words on", "Embed pictures", "Focus on x"]
        bad = ["Added a check", "adds a check", "Adding it", "Add it.", "WIP", "Add " + 70 * "x"]
        for number, subject in enumerate(["Begin", *good, *bad]):
            self.write("count", str(number))
            self.git("commit", "-q", "-m", subject)
        code, printed, _ = self.call("commit_subjects")
        reported = {line.partition(" ")[2] for line in printed.splitlines() if line[0] != " "}
        self.assertEqual((code, reported), (1, set(bad)))
        self.assertEqual(self.call("commit_subjects", f"HEAD~{len(bad)}")[0], 1)
        self.git("reset", "-q", "--hard", f"HEAD~{len(bad)}")
        shutil.copytree(DEV, self.root / "scripts/dev", dirs_exist_ok=True)
        self.assertEqual(self.call("commit_subjects"), (0, "", ""))
        self.assertEqual(self.call("commit_subjects", "nowhere")[0], 1)

    def test_house(self):
        """With rooms as floors, and with rooms on floors."""
        text = SOURCE.replace("LINES", 61 * "  work();\n")
        for floors in ("", "ground/"):
            shutil.rmtree(self.root / "src", ignore_errors=True)
            self.write("src/low/low.hpp", "int low();\n")
            self.write(f"src/{floors}high/high.cpp", text)
            code, printed, _ = self.call("house")
            self.assertEqual(code, 0)
            top = floors.rstrip("/") or "high"
            where = f"src/{floors}high/high.cpp"
            for line in (
                f"floors of src: 2: {', '.join(sorted(['low', top]))}",
                "arrows between floors: 1, 1 includes; in both directions: 0",
                f"  {top} -> low: 1",
                "functions: 5",
                f"longest function: {where}:24 many, 63 lines",
                "functions over 60 lines: 1",
                f"longest file: {where}, {text.count(chr(10))} lines",
                "functions with more than 6 parameters: 1",
                "reads of options outside Settings: 1 in 1 files",
            ):
                self.assertIn(line, printed.splitlines())


if __name__ == "__main__":
    unittest.main()
