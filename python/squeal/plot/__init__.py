# SPDX-License-Identifier: BSD-2-Clause
"""Pictures of results: squeal-plot, or python3 -m squeal.plot."""
import importlib
import sys

HELP = """squeal-plot DIR: draws pictures of the results in the folder DIR and writes them there.

squeal-plot [stability] DIR
    stability.png: frequency, growth rate and damping ratio of every mode over the friction, or over
    the parameter that was swept instead; stability_map.png, if two or more parameters were swept
squeal-plot mode DIR [FRICTION] [-m MODE] [-o FILE.png]
    mode.png: the fastest growing mode whose shape was stored, at FRICTION if given; or mode number
    MODE in the list of a point
squeal-plot regime DIR [START]
    regime.png: the motion after flutter, with growth, spectrum and state of the contact nodes
Write ./mode for a folder that has the name of a kind of picture."""
KINDS = ("stability", "mode", "regime")


def main(words):
    if not words or words[0] in ("-h", "--help"):
        print(HELP, file=sys.stdout if words else sys.stderr)
        sys.exit(0 if words else 2)
    kind, *rest = words if words[0] in KINDS else ("stability", *words)
    importlib.import_module(f"squeal.plot.{kind}").main(rest)


__all__ = ["main"]
