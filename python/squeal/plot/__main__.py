# SPDX-License-Identifier: BSD-2-Clause
"""python3 -m squeal.plot: the command squeal-plot."""
from squeal.command import run

run("squeal.plot", "squeal-plot")
