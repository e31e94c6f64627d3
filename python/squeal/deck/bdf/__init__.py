# SPDX-License-Identifier: BSD-2-Clause
"""Bulk data of Nastran: lines, cards, and the model that they describe."""
