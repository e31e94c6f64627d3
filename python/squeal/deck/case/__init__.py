# SPDX-License-Identifier: BSD-2-Clause
"""From a model to a case: groups of the mesh and options, the same for all input languages."""
