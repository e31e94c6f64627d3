// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Eigenvalues in the printed results of Abaqus, CalculiX, Nastran and Ansys.
///
/// The columns of a row are, by program:
///   Abaqus (.dat, "COMPLEX EIGENVALUE OUTPUT"): mode, Re s, Im s in rad/s (not in all versions),
///     Im s / 2π, damping ratio −2 Re s / |Im s|;
///   CalculiX (.dat, "EIGENVALUE OUTPUT" of a complex step): mode, Re ω, Re ω / 2π, Im ω for
///     motions e^(iωt), so that s = i ω;
///   Nastran (.f06, "COMPLEX EIGENVALUE SUMMARY"): root, order, Re s, Im s, |Im s| / 2π, damping
///     −2 Re s / |Im s|;
///   Ansys ("COMPLEX FREQUENCY (HERTZ)"): mode, Re s / 2π, Im s / 2π, "j", damping ratio
///     −Re s / |s|; the conjugate follows in a row without a mode number.
#include <vector>

#include "problem/eigenlist/lines.hpp"
#include "problem/eigenlist/list.hpp"

namespace squeal::eigenlist {

/// Returns the format of the first title that is recognised; `columns` without such a title.
Format formatOf(const std::vector<Line>& lines);

/// Returns the eigenvalues in the table of this format, conjugates included, and the number of
/// skipped modes; the other members are not set. Text between the rows, such as the heading of a
/// page, is skipped. Throws Error if the text contains several tables, for an incomplete row, and
/// for figures of a row that contradict each other.
List listed(const std::vector<Line>& lines, Format format);

/// Returns a text with the name of the program and the units and signs of its eigenvalues.
std::string layoutOf(Format format);

}  // namespace squeal::eigenlist
