#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""The proof that lists of eigenvalues are complete: test_proof.py PROGRAM MPIEXEC."""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
import pandas as pd
import scipy.io
import scipy.linalg

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "tests/support" / folder) for folder in ("harness", "steady")]
sys.dont_write_bytecode = True
from pressed_block import pressed_block
from watched_run import WatchedRun

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 else str(repository / "build/squeal")
MPIEXEC = sys.argv.pop(1) if len(sys.argv) > 1 else "mpirun -n"

SIZE = (
    "n_pad_theta=4,n_pad_r=2,n_free_theta=4,n_h_ring=1,n_h_lining=1,n_h_plate=1,n_hat=1,"
    "n_mount=1,n_plate=1,n_wall=1,n_inside=1"
)
BRAKE = [
    "-options_file",
    repository / "options/disc_brake.yaml",
    "-mesh_set",
    SIZE,
    "-modes_count",
    "50",
    "-flutter_band",
    "9000",
    "-report_fields",
    "off",
    "-flutter_track",
    "off",
    "-flutter_proof",
]
DAMPED = [
    "-flutter_friction",
    "0.6",
    "-flutter_friction_damping",
    "-material_disc_rayleigh_stiffness",
    "1e-7",
    "-material_lining_rayleigh_mass",
    "20",
]
LOWER = ["-modes_count", "30", "-flutter_band", "5000"]  # fewer eigenvalues: a third of the time
SOFT = [
    "-options_file",
    repository / "options/layer.yaml",
    "-mesh_set",
    "nx=8,ny=3",
    "-modes_count",
    "40",
    "-contact_plate_stiffness",
    "10",
    "-report_fields",
    "off",
    "-flutter_proof",
]
BLOCK = [*pressed_block("nx=8,ny=8", modes=20, frictions="0:0.5:0.1"), "-flutter_proof"]


class Proof(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.place = Path(temporary.name)

    def run_program(self, name, words, ranks=1):
        """Returns the folder of a run and its output."""
        folder = self.place / name
        done = subprocess.run(
            [*MPIEXEC.split(), str(ranks), PROGRAM, *words, "-report_dir", folder],
            capture_output=True,
            text=True,
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return folder, done.stdout

    def check_with_lapack(self, name, case, friction):
        """Compares the count and the discs with all eigenvalues of the full matrices by LAPACK.
        Returns the folder of the run."""
        matrices = self.place / f"{name}_matrices"
        export = ["-report_matrices", matrices, "-report_matrices_format", "matrix_market"]
        folder, _ = self.run_program(name, [*case, "-flutter_friction", f"{friction}", *export])
        k, m, k1, m1 = (
            scipy.io.mmread(matrices / f"{name}.mtx").toarray()
            for name in ("stiffness", "mass", "stiffness_friction1", "mass_friction1")
        )
        # s² = −1/μ for the eigenvalues μ of K⁻¹ M
        mu = scipy.linalg.eigvals(np.linalg.solve(k + friction * k1, m + friction * m1)).astype(
            complex
        )
        s = np.sqrt(-1 / mu)
        s = np.concatenate([s, -s])
        proof = pd.read_csv(folder / "proof.csv").iloc[0]
        self.assertEqual(proof.complete, 1)
        inside = np.abs(s) < 2 * np.pi * proof.top_hz
        self.assertEqual(2 * proof.eigenvalues, inside.sum())
        listed = pd.read_csv(folder / "eigenvalues.csv")
        self.assertGreater(listed.unstable.sum(), 0)
        for row in listed.itertuples():
            centre = complex(row.growth_rate_1_per_s, row.angular_frequency_rad_per_s)
            # LAPACK's errors are 1e-11 of the largest |s| that counts here.
            near = np.abs(s - centre) <= row.radius_1_per_s + 1e-6
            self.assertEqual(near.sum(), 1)
        return folder

    def test_all_eigenvalues_of_the_full_problem(self):
        folder = self.check_with_lapack("all", BRAKE, 0.6)
        listed = pd.read_csv(folder / "eigenvalues.csv")
        # A growth rate at least the radius from zero: all of these are proved to be unstable.
        grown = listed[listed.unstable == 1]
        self.assertTrue((grown.growth_rate_1_per_s > grown.radius_1_per_s).all())

    def test_soft_layer(self):
        """Under a soft layer, no normal forces are due to inertia."""
        self.check_with_lapack("soft", SOFT, 0.4)

    def test_exact_products_decide(self):
        """Bounds of the products of the mass with the responses prove the list below 11 kHz. Below
        12 kHz they do not, and the exact products, which take a solve each, prove it."""

        def solves(folder):
            """Each vector that the stage before solved for takes one more solve in the proof."""
            stages = json.loads((folder / "summary.json").read_text())["stages"]
            return stages["proof"]["right_hand_sides"] - stages["flutter"]["right_hand_sides"]

        lower = [*BRAKE, "-flutter_band", "11000", "-flutter_friction", "2"]
        few, _ = self.run_program("bounds", lower)
        self.assertEqual(pd.read_csv(few / "proof.csv").complete.tolist(), [1])
        many = self.check_with_lapack("products", [*BRAKE, "-flutter_band", "12000"], 2)
        self.assertGreater(solves(many), solves(few))

    def test_ranks(self):
        """The verdicts do not depend on the ranks; the ratios do, with the corrections."""
        words = [*BRAKE, "-flutter_friction", "0,0.3,0.6"]
        tables = []
        for ranks in (1, 2, 3):
            folder, output = self.run_program(f"ranks{ranks}", words, ranks)
            self.assertIn("Proof: the list is complete at 3 of 3 points", output)
            tables.append(pd.read_csv(folder / "proof.csv"))
        for table in tables[1:]:
            self.assertEqual(table.eigenvalues.tolist(), tables[0].eigenvalues.tolist())
            # The top lies between eigenvalues that are not listed, to 1e-5.
            np.testing.assert_allclose(table.top_hz, tables[0].top_hz, rtol=1e-5)
            self.assertTrue((table.ratio < 0.5).all())

    def test_opening_contact(self):
        """Several active sets with one basis, each with constraint modes of its own."""
        for ranks in (1, 2):
            folder, _ = self.run_program(f"block{ranks}", BLOCK, ranks)
            summary = json.loads((folder / "summary.json").read_text())
            self.assertGreater(len(summary["active_sets"]), 1)
            proof = pd.read_csv(folder / "proof.csv")
            self.assertTrue((proof.complete == 1).all())
            listed = pd.read_csv(folder / "eigenvalues.csv")
            for point, count in zip(proof.friction, proof.eigenvalues):
                self.assertLessEqual((listed.friction == point).sum(), count)

    def test_too_few_modes(self):
        """The band reaches nearly to the last free mode: nothing is proved."""
        words = [*BRAKE, "-flutter_friction", "0.6", "-modes_count", "32"]
        folder, output = self.run_program("few", words)
        self.assertIn("Not proved at friction 0.6: ", output)
        self.assertIn("-modes_count helps", output)
        row = pd.read_csv(folder / "proof.csv").iloc[0]
        self.assertEqual((row.complete, row.count_proved), (0, 0))

    def test_damped(self):
        """Damped materials and friction damping, against all eigenvalues by LAPACK."""
        matrices = self.place / "damped_matrices"
        export = ["-report_matrices", matrices, "-report_matrices_format", "matrix_market"]
        folder, _ = self.run_program("damped", [*BRAKE, *DAMPED, *export], 2)
        sums = {}
        for file in matrices.glob("*.mtx"):
            role = file.stem.split("_")[0]
            power = re.search(r"_friction(\d)", file.stem)
            factor = 0.6 ** int(power[1]) if power else 1
            sums[role] = sums.get(role, 0) + factor * scipy.io.mmread(file).toarray()
        k, c, m = sums["stiffness"], sums["damping"], sums["mass"]
        self.assertGreater(np.linalg.norm(c - c.T), 0)
        # z = 1/s: K x + z⁻¹ C x + z⁻² M x = 0, so that massless unknowns give z = 0
        n = len(k)
        companion = np.block([[-np.linalg.solve(k, c), -np.linalg.solve(k, m)], [np.eye(n), 0 * k]])
        z = scipy.linalg.eigvals(companion)
        s = 1 / z[np.abs(z) > 1e-8 * np.abs(z).max()]
        proof = pd.read_csv(folder / "proof.csv").iloc[0]
        self.assertEqual(proof.complete, 1)
        self.assertGreater(proof.left_1_per_s, 0)
        inside = (np.abs(s) < 2 * np.pi * proof.top_hz) & (s.real > -proof.left_1_per_s)
        self.assertEqual(proof.eigenvalues, inside.sum() // 2)
        listed = pd.read_csv(folder / "eigenvalues.csv")
        self.assertGreater(listed.unstable.sum(), 0)
        judged = listed[listed.growth_rate_1_per_s > -proof.left_1_per_s]
        self.assertGreater(len(judged), 20)
        self.assertTrue(np.isfinite(judged.radius_1_per_s).all())
        for row in judged.itertuples():
            centre = complex(row.growth_rate_1_per_s, row.angular_frequency_rad_per_s)
            # LAPACK's errors are 1e-10 of the largest |s| that counts here.
            near = np.abs(s - centre) <= row.radius_1_per_s + 1e-5
            self.assertEqual(near.sum(), 1)

    def test_damped_ranks(self):
        """The same verdicts and counts on any number of ranks."""
        tables = []
        for ranks in (1, 3):
            words = [*BRAKE, *DAMPED, *LOWER, "-flutter_friction", "0.3,0.6"]
            folder, output = self.run_program(f"damped{ranks}", words, ranks)
            self.assertIn("Proof: the list is complete at 2 of 2 points", output)
            self.assertIn(" and Re s > -", output)
            tables.append(pd.read_csv(folder / "proof.csv"))
        # The region ends in gaps between eigenvalues that are not listed, to 1e-3.
        self.assertEqual(tables[0].eigenvalues.tolist(), tables[1].eigenvalues.tolist())
        np.testing.assert_allclose(tables[1].top_hz, tables[0].top_hz, rtol=1e-3)
        np.testing.assert_allclose(tables[1].left_1_per_s, tables[0].left_1_per_s, rtol=1e-3)

    def test_rotating(self):
        """Terms of speed: without friction, and with strong friction damping at low speed."""
        words = ["-options_file", repository / "options/disc_brake_rotating.yaml", *BRAKE[2:]]
        words += ["-mesh_set", SIZE.replace("n_free_theta=4", "n_free_theta=12")]
        words += ["-modes_count", "40", "-flutter_band", "6000"]
        words += ["-flutter_friction", "0,0.6", "-flutter_speed", "1,10"]
        tables = []
        for ranks in (1, 3):
            folder, output = self.run_program(f"rotating{ranks}", words, ranks)
            self.assertIn("4 points with terms of speed or damping", output)
            self.assertIn("Proof: the list is complete at 4 of 4 points", output)
            tables.append(pd.read_csv(folder / "proof.csv"))
            self.assertTrue((tables[-1].ratio < 0.1).all())  # 0.033 reached
            self.assertTrue((tables[-1].without_disc == 0).all())
        self.assertEqual(tables[0].eigenvalues.tolist(), tables[1].eigenvalues.tolist())

    def test_damped_opening_contact(self):
        """Each active set has unknowns of its own."""
        for ranks in (1, 2):
            words = [*BLOCK, "-material_layer_rayleigh_stiffness", "1e-8"]
            folder, _ = self.run_program(f"damped_block{ranks}", words, ranks)
            summary = json.loads((folder / "summary.json").read_text())
            self.assertGreater(len(summary["active_sets"]), 1)
            proof = pd.read_csv(folder / "proof.csv")
            self.assertTrue((proof.complete == 1).all())
            self.assertTrue((proof.left_1_per_s > 0).all())

    def test_damped_proofs_are_kept(self):
        """A run that is killed after a proof and resumed proves only the other points."""
        damped = [*BRAKE, *DAMPED, *LOWER, "-flutter_friction", "0.2,0.4,0.6"]
        damped += ["-checkpoint_interval", "0"]
        command = [*MPIEXEC.split(), "1", PROGRAM]
        whole = WatchedRun(self.place / "proved", command, damped).finish_well()
        run = WatchedRun(self.place / "killed", command, damped)
        run.wait_for(
            lambda event: event["event"] == "checkpoint" and "_proofs_0000" in event["file"]
        )
        run.kill_ranks()
        self.assertNotEqual(run.finish(), 0)
        kept = len(list(run.folder.rglob("*_proofs_*.entry")))
        self.assertIn(kept, (1, 2))
        again = WatchedRun(run.folder, command, [*damped, "-resume"]).finish_well()
        ours, theirs = (one.text().count(" proved, ratio ") for one in (again, whole))
        self.assertEqual((ours, theirs), (3 - kept, 3))
        ours, theirs = (pd.read_csv(one.folder / "proof.csv") for one in (again, whole))
        self.assertEqual(list(theirs["complete"]), [1, 1, 1])
        for column in ("complete", "eigenvalues", "discs"):
            self.assertEqual(list(ours[column]), list(theirs[column]))
        ours, theirs = (
            pd.read_csv(one.folder / "eigenvalues.csv")["radius_1_per_s"].notna()
            for one in (again, whole)
        )
        self.assertEqual(list(ours), list(theirs))

    def test_reasons(self):
        """What is not covered is named."""
        words = [*BRAKE, "-flutter_friction", "0.6"]
        for name, more, reason in (
            ("modes_damped", ["-flutter_modal_damping", "0.01"], "modal damping is not a sparse"),
            ("modal", ["-flutter_basis", "modal"], "only with -flutter_basis corrected"),
            ("uncounted", ["-modes_sturm", "off"], "free modes is not confirmed"),
        ):
            _, output = self.run_program(name, [*words, *more])
            self.assertIn(reason, output)


if __name__ == "__main__":
    unittest.main()
