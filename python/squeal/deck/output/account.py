# SPDX-License-Identifier: BSD-2-Clause
"""Writes import.md: what became of each card, the sets with their sizes, and the choices made."""

from squeal.deck.case.groups import CELLS, FACES, NODES
from squeal.deck.journal import Fault


REACH = (
    "A node of a slave with faces counts as tied, or in reach, if the master covers a part of one"
    " of its faces within the distance of the tie, by default half the size of that face. The log"
    " of the program states the areas."
)


def write_account(path, model, case, journal):
    """`case` is None if the deck is refused. Raises OSError."""
    text = [f"# {model.title}", ""]
    text += _outcome(model, journal)
    text += _choices(journal)
    text += _cards(journal)
    text += _elements(model)
    text += _instances(model)
    text += _sets(model)
    if case is not None:
        text += _groups(case)
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(text) + "\n")


def _outcome(model, journal):
    lines = [f"Read as a deck of {model.program}. Cards: {journal.counted()}.", ""]
    if journal.refusals:
        lines += ["The deck cannot be translated:", ""]
        lines += [f"- {refusal}" for refusal in journal.refusals]
        lines.append("")
    return lines


def _choices(journal):
    if not journal.choices:
        return []
    return ["## Choices", "", *(f"- {choice}" for choice in journal.choices), ""]


def _cards(journal):
    lines = ["## Cards", "", "| place | card | outcome | remark |", "|---|---|---|---|"]
    for source, entry in journal.entries.items():
        if source.card:
            remarks = _cell("; ".join(entry.remarks))
            lines.append(f"| {_cell(str(source))} | {source.word} | {entry.status} | {remarks} |")
    return [*lines, ""]


def _cell(text):
    return text.replace("|", "\\|")


def _elements(model):
    lines = ["## Elements", "", "| type | elements | card |", "|---|---|---|"]
    for block in model.blocks:
        lines.append(f"| {block.kind} | {len(block.numbers)} | {_cell(str(block.source))} |")
    return [*lines, "", f"Nodes: {len(model.nodes.numbers)}", ""]


def _instances(model):
    """The numbers of the model are those of the part plus an offset."""
    if not model.instances:
        return []
    lines = ["## Instances", "", "| instance | node 1 of the part | element 1 |", "|---|---|---|"]
    for one in model.instances:
        name = _cell(one.name) or "the assembly"
        lines.append(f"| {name} | {one.node_offset + 1} | {one.element_offset + 1} |")
    return [*lines, ""]


def _sets(model):
    lines = ["## Sets and surfaces", "", "| kind | name | members | not in the deck |"]
    lines.append("|---|---|---|---|")
    for what, sets in (("node set", model.node_sets), ("element set", model.element_sets)):
        for key in sets:
            try:
                members = sets.members(key)
            except Fault as fault:  # refused where it is used
                lines.append(f"| {what} | {_cell(sets.spelled[key])} | {_cell(str(fault))} | |")
                continue
            absent = model.absent(members, sets) or ""
            lines.append(f"| {what} | {_cell(sets.spelled[key])} | {len(members)} | {absent} |")
    for surface in model.surfaces.values():
        nodal = surface.nodes is not None
        size = len(surface.nodes if nodal else surface.faces)
        what = "surface of nodes" if nodal else "surface of faces"
        lines.append(f"| {what} | {_cell(surface.name)} | {size} | |")
    return [*lines, ""]


def _groups(case):
    lines = ["## Groups of the mesh", "", "| kind | name | members |", "|---|---|---|"]
    for dimension, word in ((CELLS, "body"), (FACES, "faces"), (NODES, "nodes")):
        for name, members in case.groups[dimension].items():
            lines.append(f"| {word} | {_cell(name)} | {len(members)} |")
    if case.ties:
        lines += [
            "",
            "## Ties",
            "",
            "| tie | slave | tied nodes | free nodes |",
            "|---|---|---|---|",
        ]
        for name, side, tied, free in case.ties:
            lines.append(f"| {_cell(name)} | {side} | {tied} | {free} |")
    if case.contacts:
        lines += ["", "## Contacts", "", "| interface | nodes in reach | others |", "|---|---|---|"]
        lines += [f"| {name} | {reached} | {beyond} |" for name, reached, beyond in case.contacts]
    if case.contacts or any(row[1] == "faces" for row in case.ties):
        lines += ["", REACH]
    return [*lines, ""]
