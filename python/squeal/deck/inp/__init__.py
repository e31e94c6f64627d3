# SPDX-License-Identifier: BSD-2-Clause
"""The input language of Abaqus and CalculiX (.inp): lines, cards, and the model that they give."""
