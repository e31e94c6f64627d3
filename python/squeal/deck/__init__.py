# SPDX-License-Identifier: BSD-2-Clause
"""Decks of other programs, translated into a case: mesh.msh, case.yaml and import.md.

    lines -> cards -> model          one folder per input language (inp: CalculiX)
                      model -> case  common to all languages (case)
                               case -> files  (output)
"""
