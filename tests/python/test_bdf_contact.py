#!/usr/bin/python3
# SPDX-License-Identifier: BSD-2-Clause
"""Contacts, glue and brake squeal of Nastran decks: a pad on a disc, in both forms."""
import sys
import unittest
from pathlib import Path

import numpy as np

repository = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(repository / "python"), str(repository / "tests/support/deck")]
sys.dont_write_bytecode = True
from small_bdf import imported, refusals
from write_bdf import free

SECTORS, INNER, OUTER = 12, 1.0, 2.0
CONTROL = "SOL 400\nCEND\nSPC = 1\nLOAD = 2\n{}METHOD = 3\nBEGIN BULK\n"
NX = CONTROL.format("BCSET = 5\nBGSET = 6\n").replace("400", "103").replace("METHOD", "METHOD")
MSC = CONTROL.format("BCONTACT = 5\nBSQUEAL = 7\n")


def ring(first, low, high, sectors):
    """Returns the grids of sectors of a ring by (sector, radius, height), and its elements."""
    grids, cells = {}, []
    count = SECTORS if sectors == SECTORS else sectors + 1
    for sector in range(count):
        angle = 2 * np.pi * sector / SECTORS
        for at, radius in enumerate((INNER, OUTER)):
            for side, height in enumerate((low, high)):
                place = (radius * np.cos(angle), radius * np.sin(angle), height)
                grids[sector, at, side] = first + len(grids), place
    for sector in range(sectors):
        after = (sector + 1) % count
        ring = [(sector, 0), (sector, 1), (after, 1), (after, 0)]
        cells.append([grids[(*one, side)][0] for side in (0, 1) for one in ring])
    return dict(grids.values()), cells


def brake():
    """A disc of 12 elements, a pad of 2 on it, and a plate of 2 above the pad."""
    text = ""
    for number, (low, high, sectors) in enumerate(
        [(0.0, 0.5, SECTORS), (0.5, 0.75, 2), (0.75, 1.0, 2)], 1
    ):
        grids, cells = ring(100 * number, low, high, sectors)
        text += "".join(free("GRID", at, None, *map(float, one)) for at, one in grids.items())
        for at, nodes in enumerate(cells, 1):
            text += free("CHEXA", 100 * number + at, number, *nodes)
        text += free("PSOLID", number, 1)
    text += free("MAT1", 1, 2.0e5, None, 0.25, 8.0e-9) + free("EIGRL", 3, None, None, 4)
    text += free("SPC1", 1, 123, *(100 + 4 * sector + at for sector in range(12) for at in (0, 1)))
    for element, nodes in ((301, (301, 307)), (302, (305, 311))):
        text += free("PLOAD4", 2, element, 3.0, None, None, None, *nodes)
    return text


def faces(name, number, elements, layer, first):
    """Returns a region of the lower or upper faces of elements of a ring."""
    words, grids = [], (0, 2, 6)
    for at, element in enumerate(elements):
        words += [element, *(layer + 4 * at + one for one in grids)]
    return free(name, number, *[None] * (first - 2), *words)


SIMCENTER = (
    faces("BSURFS", 11, (101, 102), 101, 5)
    + faces("BSURFS", 12, (201, 202), 200, 5)
    + faces("BSURFS", 13, (201, 202), 201, 5)
    + faces("BSURFS", 14, (301, 302), 300, 5)
    + "BCTSET,5,12,11,.3,0.,.1\nBCTPARM,5,PENN,1.,PENT,1.\nBGSET,6,13,14,.2\n"
    + "BCRPARA,11,,0.,FLEX\n"
)
HEXAGON = (
    "BSURF,21,101,THRU,112\nBCPROP,22,2\nBSURF,23,301,THRU,309,BY,1\n"
    "BCBODY1,31,,3D,DEFORM,21\nBCBODY1,32,,3D,DEFORM,22\nBCBODY1,33,,,,23\n"
    "BCTABL1,5,41,42\nBCONECT,41,,51,32,31\nBCONECT,42,52,,33,32\n"
    "BCONPRP,51,,FRIC,.3\nBCONPRG,52,,IGLUE,1\n"
)
BRKSYS = (
    "BRKSYS,7,1.\n,INNER,32,31,61,,71\nBRKPROP,71,,AVSTIF,1.+12,FRICT,.4\n"
    "MOTION,61,50.\n,ROTAT,0.,0.,2.,0.,0.,1.\n"
)
BSQUEAL = "BSQUEAL,7,,1.+12\n,0.,0.,1.,0.,0.,0.\nBCPARA,,FTYPE,6\n"


def corners(groups, name):
    return sorted({node for row in groups[name] for node in row})


class Contacts(unittest.TestCase):
    def test_pairs_of_faces(self):
        one = imported(NX + brake() + SIMCENTER)
        (contact,) = one.options["contact"].values()
        self.assertEqual((contact["pad"], contact["disc"]), ("bsurfs_12", "bsurfs_11"))
        # Nothing moves: friction holds up to its limit.
        self.assertEqual((contact["role"], contact["friction"]), ("sticking", 0.3))
        self.assertEqual(contact["gap"], "measured")
        self.assertEqual(corners(one.groups, "bsurfs_12"), [200, 202, 204, 206, 208, 210])
        (tie,) = one.options["tie"].values()
        self.assertEqual(tie, {"slave": "bsurfs_13", "master": "bsurfs_14", "tolerance": 0.2})
        self.assertIn("PENN is not used", one.account)

    def test_both_distances_of_a_pair(self):
        one = imported(NX + brake() + SIMCENTER.replace(",.3,0.,.1", ",.3,-.1,.1"))
        self.assertEqual(len(one.options["contact"]), 1)
        self.assertTrue(any("MIND and MAXD are not used" in text for text in one.journal.choices))

    def test_sets_that_are_not_selected(self):
        one = imported(NX.replace("BCSET = 5\n", "") + brake() + SIMCENTER)
        self.assertNotIn("contact", one.options)
        self.assertIn("BCTSET | not used | set 5 is not selected", one.account)

    def test_bodies_face_each_other(self):
        one = imported(MSC.replace("BSQUEAL = 7\n", "") + brake() + HEXAGON)
        (contact,) = one.options["contact"].values()
        self.assertEqual(contact["role"], "frictionless")  # FTYPE of BCPARA is 0
        self.assertIn("FTYPE of BCPARA is 0", one.account)
        self.assertEqual(corners(one.groups, contact["pad"]), [200, 202, 204, 206, 208, 210])
        self.assertTrue(set(corners(one.groups, contact["disc"])) >= {101, 103, 105, 107, 109, 111})
        self.assertTrue(all(node % 2 for node in corners(one.groups, contact["disc"])))
        (tie,) = one.options["tie"].values()
        self.assertEqual(corners(one.groups, tie["slave"]), [300, 302, 304, 306, 308, 310])

    def test_brake_system(self):
        one = imported(MSC + brake() + HEXAGON + BRKSYS)
        (contact,) = one.options["contact"].values()
        self.assertEqual(contact["role"], "sliding")
        self.assertEqual(one.options["flutter"]["friction"], 0.4)
        self.assertEqual(one.options["flutter"]["friction_damping"], False)
        motion = one.options["motion"]["psolid_1"]
        self.assertEqual((motion["speed"], motion["axis"]), (1.0, "0.0,0.0,1.0"))
        self.assertTrue(any("only its direction counts" in text for text in one.journal.choices))
        one = imported(MSC + brake() + HEXAGON + BRKSYS, speed=5.0)
        self.assertEqual(one.options["motion"]["psolid_1"]["speed"], 5.0)
        one = imported(MSC + brake() + HEXAGON + BRKSYS.replace("FRICT,.4", "FRICT,0."))
        self.assertEqual(one.options["flutter"]["friction"], 0.3)
        one = imported(MSC + brake() + HEXAGON + BRKSYS.replace("61,50.", "61,-50."))
        self.assertEqual(one.options["motion"]["psolid_1"]["axis"], "0.0,0.0,-1.0")

    def test_one_axis_for_all_contacts(self):
        one = imported(MSC + brake() + HEXAGON + BSQUEAL)
        (contact,) = one.options["contact"].values()
        self.assertEqual(contact["role"], "sliding")
        self.assertEqual(one.options["flutter"]["friction"], 0.3)
        self.assertEqual(list(one.options["motion"]), ["psolid_1"])

    def test_two_pads_on_one_disc(self):
        """Two contacts name surfaces of the same disc."""
        pads = "BSURF,24,201\nBCBODY1,32,,3D,DEFORM,24\nBSURF,25,202\nBCBODY1,34,,3D,DEFORM,25\n"
        cards = HEXAGON.replace("BCBODY1,32,,3D,DEFORM,22\n", pads).replace("BCPROP,22,2\n", "")
        cards = cards.replace("41,42", "41,43").replace(
            "BCONECT,42,52,,33,32", "BCONECT,43,,51,34,31"
        )
        one = imported(MSC + brake() + cards + BSQUEAL)
        self.assertEqual(len(one.options["contact"]), 2)
        self.assertEqual(list(one.options["motion"]), ["psolid_1"])

    def test_friction_of_a_brake_needs_no_ftype(self):
        one = imported(MSC + brake() + HEXAGON + BSQUEAL.split("BCPARA")[0])
        (contact,) = one.options["contact"].values()
        self.assertEqual(contact["role"], "sliding")
        self.assertEqual(one.options["flutter"]["friction"], 0.3)

    def test_the_stiffness_of_contact(self):
        """A penalty is hard contact, unless it is a soft layer."""
        soft = BSQUEAL.replace("1.+12", "1.+5")
        for cards, stiffness in ((BSQUEAL, None), (soft, 1.0e5)):
            one = imported(MSC + brake() + HEXAGON + cards)
            (contact,) = one.options["contact"].values()
            self.assertEqual(contact.get("stiffness"), stiffness)

    def test_tables_of_contact(self):
        cards = HEXAGON.split("BCTABL1")[0] + "BCPARA,,FTYPE,6\nBCTABLE,5\n"
        cards += ",SECNDRY,32,,,.25\n,PRIMARY,31\n,SECNDRY,33,,,,,1\n,PRIMARY,32\n"
        one = imported(MSC.replace("BSQUEAL = 7\n", "") + brake() + cards)
        (contact,) = one.options["contact"].values()
        self.assertEqual((contact["role"], contact["friction"]), ("sticking", 0.25))
        self.assertEqual(len(one.options["tie"]), 1)

    def test_interference_in_a_table_is_refused(self):
        cards = HEXAGON.split("BCTABL1")[0] + "BCTABLE,5\n,SECNDRY,32,,,.25,.1\n,PRIMARY,31\n"
        rows = refusals(MSC.replace("BSQUEAL = 7\n", "") + brake() + cards)
        self.assertTrue(any("BCTABLE, CINTERF: an interference" in row for row in rows), rows)

    def test_what_is_refused(self):
        text = MSC + brake() + HEXAGON
        for cards, reason in (
            (BRKSYS.replace("7,1.", "7,.5"), "BRKSYS, OMETH: OMETH 0.5"),
            (BRKSYS.replace("ROTAT", "TRANS"), "MOTION, FORM: only FORM ROTAT"),
            (BRKSYS.replace(",71\n", ",72\n"), "there is no BRKPROP 72"),
            (BRKSYS.replace("32,31", "33,31"), "no contact with friction has these bodies"),
            (BRKSYS.replace("0.,0.,1.\n", "9.,0.,1.\n"), "0 of the bodies in contact go around"),
            (BSQUEAL.replace(",0.,0.,1.", ",0.,0.,0."), "the axis is zero"),
            (BRKSYS + "BCPARA,,OMEGA,6\n", "BCPARA, OMEGA: the parameter OMEGA"),
        ):
            rows = refusals(text + cards)
            self.assertTrue(any(reason in row for row in rows), rows)
        for card, reason in (
            ("BCRPARA,12,,.1\n", "BCRPARA, OFFSET: offsets of contact"),
            ("BCTPARM,5,TIED,1\n", "BCTPARM, TIED: the parameter TIED = 1"),
        ):
            rows = refusals(NX + brake() + SIMCENTER + card)
            self.assertTrue(any(reason in row for row in rows), rows)
        for old, new, reason in (
            ("BCONPRG,52,,IGLUE,1", "BCONPRG,52,,IGLUE,1,JGLUE,1", "JGLUE: glue that may open"),
            ("FRIC,.3", "FRIC,9", "FRIC: tables of friction"),
            ("BCONECT,41,,51,32,31", "BCONECT,41,,59,32,31", "there is no BCONPRP 59"),
            ("32,31\n", "32,39\n", "there is no contact region 39"),
            ("DEFORM,22", "RIGID,22", "BEHAV: only bodies of solid elements"),
        ):
            self.assertIn(old, text)
            rows = refusals((text + BSQUEAL).replace(old, new))
            self.assertTrue(any(reason in row for row in rows), rows)


if __name__ == "__main__":
    unittest.main()
