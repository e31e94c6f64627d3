#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Faults that other importers of decks have: what this one does with such a deck.

Each test names the report: repository and number of the issue on github.com.
"""
import sys
import unittest
from pathlib import Path

import numpy as np

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(repository / "tests/support/deck")]
sys.dont_write_bytecode = True
from small_decks import CUBE, STEEL, Imported, cube, model_of, refused

PART = (
    "*PART, NAME={}\n*NODE\n{}*ELEMENT, TYPE=C3D8, ELSET=E\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*END PART\n"
)
NODES = CUBE.split("\n", 1)[1].split("*ELEMENT")[0]


def members(text, key, kind="node_sets"):
    model, journal = model_of(text)
    assert not journal.refusals, journal.refusals
    return getattr(model, kind).members(key).tolist()


def assembled(parts, inside):
    return parts + f"*ASSEMBLY, NAME=A\n{inside}*END ASSEMBLY\n"


def instance(name, part, lines=""):
    return f"*INSTANCE, NAME={name}, PART={part}\n{lines}*END INSTANCE\n"


class Nodes(unittest.TestCase):
    def test_01_sets_on_cards_that_define_members(self):
        """nschloe/meshio 1527: the set of *NODE is dropped."""
        self.assertEqual(members("*NODE, NSET=S\n3, 0.\n4, 1.\n", "S"), [3, 4])
        self.assertEqual(members(CUBE, "CUBE", "element_sets"), [1])
        row = "*NODE\n1, 0.\n3, 1.\n*NGEN, NSET=S\n1, 3\n"
        self.assertEqual(members(row, "S"), [1, 2, 3])
        inside = "*INSTANCE, NAME=I, PART=P\n*NODE, NSET=S\n70, 5., 5., 5.\n*END INSTANCE\n"
        self.assertEqual(members(assembled(PART.format("P", NODES), inside), "I.S"), [70])

    def test_02_blocks_of_nodes_in_any_order(self):
        """nschloe/meshio 1528: a second block replaces the first."""
        nodes, rest = CUBE.split("5, 0., 0., 1.\n")
        more, rest = ("5, 0., 0., 1.\n" + rest).split("*ELEMENT", 1)
        text = nodes + "*ELEMENT" + rest + "*NODE\n" + more
        wanted = model_of(CUBE)[0]
        found = model_of(text)[0]
        self.assertEqual(found.nodes.coordinates.tolist(), wanted.nodes.coordinates.tolist())

    def test_03_parts_with_equal_numbers(self):
        """nschloe/meshio 1456: nodes of one part overwrite those of another."""
        far = NODES.replace(" 0., 0., 0.", " -1., 0., 0.")
        parts = PART.format("P", NODES) + PART.format("Q", far)
        model, _ = model_of(assembled(parts, instance("I", "P") + instance("J", "Q")))
        self.assertEqual(len(model.nodes.numbers), 16)
        first, second = model.blocks[0].nodes
        self.assertEqual(set(first) & set(second), set())
        self.assertEqual(model.nodes.at([first[0], second[0]])[:, 0].tolist(), [0, -1])

    def test_04_sizes_of_sets_are_shown(self):
        """nschloe/meshio 1489: sets by GENERATE are lost."""
        one = Imported(cube("*ELSET, ELSET=G, GENERATE\n1, 1\n*NSET, NSET=H, GENERATE\n2, 8, 2\n"))
        self.assertIn("| element set | G | 1 |", one.account)
        self.assertIn("| node set | H | 4 |", one.account)

    def test_05_sets_of_sets(self):
        """nschloe/meshio 783: an error; later versions leave the set empty."""
        text = "*NSET, NSET=A\n1\n*NSET, NSET=B\n2, 3\n*NSET, NSET=S\nA, 9, B\n8\n"
        self.assertEqual(members(text, "S"), [1, 2, 3, 8, 9])
        self.assertEqual(members(text + "*NSET, NSET=T\nS, A\n", "T"), [1, 2, 3, 8, 9])

    def test_06_sets_apart_from_their_elements(self):
        """nschloe/meshio 1366: they are empty."""
        for card in ("*ELSET, ELSET=S\n1\n", "*ELSET, ELSET=S\nCUBE\n"):
            self.assertEqual(members(card + CUBE, "S", "element_sets"), [1])

    def test_07_to_08_generate(self):
        """nschloe/meshio 663, AbaqusReader.jl 47, 55, 87: only in upper case, only at the end."""
        for card in ("*NSET, NSET=S, GENERATE", "*Nset, generate, nset=S", "*nset,Generate,nset=s"):
            self.assertEqual(members(card + "\n2, 6, 2\n", "S"), [2, 4, 6])
            self.assertEqual(members(card + "\n2, 3\n", "S"), [2, 3])
            self.assertIn("is empty", refused(cube(card + "\n6, 2, 2\n"))[0])
            self.assertIn("is empty", refused(cube(card + "\n2, 6, -2\n"))[0])


class LinesAndFiles(unittest.TestCase):
    def test_09_blank_lines(self):
        """nschloe/meshio 634: they end the block. The first one of *SPRING has a meaning."""
        model, _ = model_of(CUBE.replace("\n", "\n\n"))
        self.assertEqual(len(model.nodes.numbers), 8)
        spring = "*ELEMENT, TYPE=SPRINGA, ELSET=S\n9, 5, 7\n*SPRING, ELSET=S\n\n4.\n"
        one = Imported(cube(spring))
        self.assertEqual(one.options["spring"]["element_9"]["stiffness"], 4.0)

    def test_10_sets_and_surfaces_of_the_assembly(self):
        """AbaqusReader.jl 86: they are dropped without a word."""
        inside = instance("I", "P") + "*NSET, NSET=S, INSTANCE=I\n1\n*ELSET, ELSET=E\nI.E\n"
        text = assembled(PART.format("P", NODES), inside + "*SURFACE, NAME=F\nE, S1\n")
        self.assertEqual(members(text, "S"), [1])
        self.assertEqual(model_of(text)[0].surfaces["F"].faces.tolist(), [0])

    def test_11_places_of_instances(self):
        """AbaqusReader.jl 77: all parts are at the origin."""
        turn = "0., 0., 3.\n0., 0., 0., 1., 0., 0., 90.\n"
        text = assembled(PART.format("P", NODES), instance("I", "P") + instance("J", "P", turn))
        places = model_of(text)[0].nodes.coordinates
        # Between the nodes 1: (0, 0, 3) is turned to (0, -3, 0).
        self.assertLess(np.max(np.abs(places[8] - places[0] - [0, -3, 0])), 1e-15)

    def test_12_included_files(self):
        """AbaqusReader.jl 88: they are skipped with a warning."""
        (row,) = refused(cube() + "*INCLUDE, INPUT=mesh.inp\n")
        self.assertRegex(row, "there is no file .*mesh.inp")
        files = {"a.inp": "*INCLUDE, INPUT=b.inp\n", "b.inp": "*INCLUDE, INPUT=a.inp\n"}
        (row,) = refused(cube() + "*INCLUDE, INPUT=a.inp\n", files)
        self.assertIn("includes itself", row)
        files = {f"{n}.inp": f"*INCLUDE, INPUT={n + 1}.inp\n" for n in range(40)}
        (row,) = refused(cube() + "*INCLUDE, INPUT=0.inp\n", files)
        self.assertIn("nested too deeply", row)

    def test_13_local_systems(self):
        """AbaqusReader.jl 88: coordinates in a local frame are taken as global."""
        text = "*SYSTEM\n1., 0., 0., 1., 1., 0.\n*NODE\n1, 5., 0., 0.\n"
        self.assertEqual(model_of(text)[0].nodes.at([1]).tolist(), [[1, 5, 0]])

    def test_14_lines_of_data(self):
        """AbaqusReader.jl 36: lines below *SOLID SECTION are dropped."""
        one = Imported(cube().replace("MATERIAL=STEEL\n", "MATERIAL=STEEL\n2.,\n"))
        self.assertIn("no effect on solid cells", one.remarks("SOLID SECTION")[1])
        rows = refused(cube().replace("MATERIAL=STEEL\n", "MATERIAL=STEEL\n2.,\n3.,\n"))
        self.assertIn("at most 1 lines of data", rows[0])


class Elements(unittest.TestCase):
    def test_15_to_16_surfaces_by_sets_and_by_numbers(self):
        """libMesh 2315, 2317, 3347: element sets are unknown, blanks break the look-up."""
        text = (
            CUBE + "*ELSET, ELSET=OUTER\nCUBE\n*SURFACE, NAME= F , TYPE = ELEMENT\n  OUTER , S3\n"
        )
        text += "1, S4\n"
        one = model_of(text)[0].surfaces["F"]
        self.assertEqual(list(zip(one.elements, one.faces)), [(1, 2), (1, 3)])

    def test_17_whole_keywords(self):
        """libMesh 4181: *NODE RESPONSE is taken for *NODE."""
        rows = refused(cube("*NODE RESPONSE\n1, 9., 9., 9.\n*ELEMENT MATRIX\n1, 2\n"))
        self.assertEqual(
            [row.split(": ")[1] for row in rows], ["*NODE RESPONSE", "*ELEMENT MATRIX"]
        )

    def test_18_names_that_contain_a_type(self):
        """libMesh, abaqus_io.C: TYPE=C3D8, ELSET=PADS4 becomes a quadrilateral."""
        one = Imported(cube().replace("CUBE", "PADS4"))
        self.assertEqual(len(one.groups["PADS4"][0]), 8)

    def test_19_several_parts(self):
        """libMesh, abaqus_io.C: they are refused."""
        parts = PART.format("P", NODES) + PART.format("Q", NODES)
        model, journal = model_of(assembled(parts, instance("I", "P") + instance("J", "Q")))
        self.assertEqual(journal.refusals, [])
        self.assertEqual([one.name for one in model.instances], ["I", "J", ""])

    def test_20_one_name_for_two_kinds(self):
        """idaholab/moose 3358, 30385, 18873: node and side sets are merged."""
        text = CUBE + "*NSET, NSET=X\n1, 2\n*ELSET, ELSET=X\n1\n*SURFACE, NAME=X\nX, S2\n"
        model = model_of(text)[0]
        self.assertEqual(model.node_sets.members("X").tolist(), [1, 2])
        self.assertEqual(model.element_sets.members("X").tolist(), [1])
        self.assertEqual(model.surfaces["X"].faces.tolist(), [1])
        load = "*DSLOAD\nX, P, 1.\n*CLOAD\nX, 1, 1.\n"
        one = Imported(cube(text[len(CUBE) :], load))
        self.assertEqual(one.groups["X"], [1, 2])
        self.assertEqual(sorted(one.groups["X_faces"][0]), [5, 6, 7, 8])

    def test_21_elements_of_other_dimensions(self):
        """libMesh, abaqus_io.C: they are deleted."""
        rows = refused(cube("*ELEMENT, TYPE=S4\n7, 1, 2, 3, 4\n*ELEMENT, TYPE=T3D2\n8, 1, 2\n"))
        self.assertEqual([row.split(": ")[1] for row in rows], ["*ELEMENT, S4", "*ELEMENT, T3D2"])
        self.assertIn("(1 lines of data)", rows[0])

    def test_22_order_of_nodes(self):
        """ccx2paraview 2, nschloe/meshio 1538: nodes of C3D20 are twisted. tests/decks/test_cells
        compares the integrals of curved cells; here the middle nodes of all edges."""
        edges = "12 23 34 41 56 67 78 85 15 26 37 48".split()
        corners = np.array(model_of(CUBE)[0].nodes.coordinates)
        middle = [(corners[int(a) - 1] + corners[int(b) - 1]) / 2 for a, b in edges]
        rows = "".join(f"{n}, {x}, {y}, {z}\n" for n, (x, y, z) in enumerate(middle, 9))
        text = (
            cube()
            .replace("TYPE=C3D8", "TYPE=C3D20")
            .replace(
                "7, 8\n*NSET", "7, 8, 9, 10,\n" + ", ".join(map(str, range(11, 21))) + "\n*NSET", 1
            )
        )
        one = Imported(text + "*NODE\n" + rows)
        (cell,) = one.groups["CUBE"]
        # Edges of gmsh's 20-node hexahedron, from its manual.
        pairs = [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7)]
        pairs += [(5, 6), (6, 7)]
        places = one.coordinates[np.searchsorted(one.nodes, cell)]
        for (first, second), place in zip(pairs, places[8:]):
            self.assertEqual(((places[first] + places[second]) / 2).tolist(), place.tolist())

    def test_23_labels_of_faces(self):
        """simvia-tech/meshlane 35: S1 to S6 point to other faces after nodes are reordered."""
        for face, nodes in enumerate(([1, 2, 3, 4], [5, 6, 7, 8], [1, 2, 5, 6], [2, 3, 6, 7]), 1):
            one = Imported(cube("", "*DSLOAD\nF, P, 1.\n", f"*SURFACE, NAME=F\n1, S{face}\n"))
            self.assertEqual(sorted(one.groups["F"][0]), nodes)

    def test_26_unsupported_types_are_named_at_once(self):
        """simvia-tech/meshlane 30: the read stops, or springs become cells."""
        text = "*ELEMENT, TYPE=CONN3D2\n7, 1, 2\n*ELEMENT, TYPE=SC8R\n8, 1, 2, 3, 4, 5, 6, 7, 8\n"
        rows = refused(cube(text + "*ELEMENT, TYPE=B31\n9, 1, 2\n"))
        names = [row.split(": ")[1] for row in rows]
        self.assertEqual(names, ["*ELEMENT, CONN3D2", "*ELEMENT, SC8R", "*ELEMENT, B31"])
        spring = "*ELEMENT, TYPE=SPRINGA, ELSET=S\n9, 5, 7\n*SPRING, ELSET=S\n\n4.\n"
        self.assertEqual(set(Imported(cube(spring)).groups), {"CUBE", "BOTTOM", "node_5", "node_7"})


class Properties(unittest.TestCase):
    def test_27_blanks_in_names_of_materials(self):
        """OpenVSP 251, PrePoMax 28."""
        for first, second in (("Grey iron", "GREY IRON"), ('"Grey iron"', '"grey IRON"')):
            text = cube().replace("NAME=STEEL", f"NAME={first}")
            one = Imported(text.replace("MATERIAL=STEEL", f"MATERIAL={second}"))
            self.assertEqual(one.options["material"]["CUBE"]["young"], 210000.0)

    def test_28_sections_by_elements(self):
        """OpenRadioss/Tools 40: a section of another set of the same elements is not found."""
        text = cube("*ELSET, ELSET=OTHER\n1\n").replace(
            "SECTION, ELSET=CUBE", "SECTION, ELSET=OTHER"
        )
        self.assertEqual(Imported(text).options["material"]["OTHER"]["young"], 210000.0)

    def test_29_constraints_of_several_types(self):
        """OpenRadioss/Tools 80, 79: ties are lost; an empty ELSET= loops for ever."""
        loose = "*NODE\n20, 5., 0., 0.\n21, 6., 0., 0.\n"
        text = cube(loose + "*MPC\nBEAM, 5, 20\nTIE, 6, 7\nBEAM, 8, 20\nPIN, 1, 21\n", "")
        one = Imported(text, dialect="abaqus")
        (coupling,) = one.options["coupling"].values()
        self.assertEqual(one.groups[coupling["nodes"]], [5, 8])
        self.assertEqual(len(one.options["equation"]), 6)
        rows = refused(cube(loose + "*RIGID BODY, ELSET=, REF NODE=20\n"))
        self.assertIn("ELSET= has no value", rows[0])

    def test_30_lines_of_orientations(self):
        """OpenRadioss/Tools 60: without the second line the axes are wrong."""
        axes = "*ORIENTATION, NAME=O\n0., 1., 0., -1., 0., 0.\n"
        for more in ("", "3, 0.\n", "1,\n"):
            frame = model_of(axes + more)[0].orientations["O"]
            self.assertEqual(
                frame.axes_at(np.zeros(3)).tolist(), [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]
            )
        turned = model_of(axes + "3, 90.\n")[0].orientations["O"].axes_at(np.zeros(3))
        self.assertLess(np.max(np.abs(turned - [[-1, 0, 0], [0, -1, 0], [0, 0, 1]])), 1e-15)

    def test_31_names_after_their_use(self):
        """FEMaster 27: the element set after the surface that uses it is not found."""
        text = "*SURFACE, NAME=F\nLATE, S2\n" + CUBE + "*ELSET, ELSET=LATE\n1\n"
        self.assertEqual(model_of(text)[0].surfaces["F"].elements.tolist(), [1])
        text = STEEL + CUBE
        self.assertEqual(
            Imported(text + "*STEP\n*STATIC\n*BOUNDARY\nBOTTOM, 1, 3\n*END STEP\n").options[
                "material"
            ]["CUBE"]["poisson"],
            0.3,
        )

    def test_40_numbers_of_tied_nodes(self):
        """Dhondtguido/CalculiX 174: nodes on a planar edge are not tied."""
        brick = "*NODE\n41, 0., 0.5, 1.\n42, 1., 1., 1.\n43, .75, 1.5, 1.2\n44, .25, 1.5, 1.2\n"
        brick += "*ELEMENT, TYPE=C3D4, ELSET=CUBE\n2, 41, 42, 43, 44\n*ELSET, ELSET=LOWER\n1\n"
        tie = "*SURFACE, NAME=UP\nLOWER, S2\n*NSET, NSET=N\n41, 42, 43, 44\n"
        tie += "*SURFACE, NAME=N, TYPE=NODE\nN\n*TIE, NAME=T\nN, UP\n"
        one = Imported(cube(brick + tie))
        self.assertIn("| T | nodes | 2 | 2 |", one.account)
        self.assertIn("2 nodes tied, 2 free", one.remarks("TIE")[1])

    def test_members_that_are_missing_are_a_choice(self):
        one = Imported(cube("*NSET, NSET=SOME\n5, 6, 77\n*BOUNDARY\nSOME, 1\n"))
        text = "the node set 'SOME': left out are 1 of 3 members, which are not in the deck or not"
        text += " translated"
        self.assertIn(text, one.journal.choices)
        self.assertEqual(sorted(one.groups["SOME"]), [5, 6])

    def test_a_decimal_comma_is_shown(self):
        one = Imported(cube().replace("7.8E-9", "7,8E-9"))
        wanted = "7 at the temperature 8e-09, which is not used"
        self.assertTrue(any(wanted in text for text in one.journal.choices), one.journal.choices)

    def test_loads_outside_of_steps(self):
        (row,) = refused(cube("*CLOAD\n5, 1, 2.\n"))
        self.assertIn("*CLOAD: this card belongs after *STEP", row)


if __name__ == "__main__":
    unittest.main()
