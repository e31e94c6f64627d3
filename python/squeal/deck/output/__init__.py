# SPDX-License-Identifier: BSD-2-Clause
"""The files of a case: mesh.msh, case.yaml and import.md."""
