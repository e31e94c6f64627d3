# SPDX-License-Identifier: BSD-2-Clause
"""Imports matrices of other programs: a file → entries in coordinate form → a case of matrices.

command.py reads the words of squeal-import, sources.py recognises formats, a module for each format
returns a coordinate.Matrix, system.py numbers the rows and checks them, output.py writes the case.
"""
