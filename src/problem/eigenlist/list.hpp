// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Lists of eigenvalues from the printed results of other programs.
#include <mpi.h>

#include <string>
#include <string_view>
#include <vector>

#include "algebra/linalg/complex.hpp"
#include "problem/eigenlist/settings.hpp"

namespace squeal::eigenlist {

/// Eigenvalues of a real problem, each with Im s ≥ 0; the list implies their conjugates. They are
/// in the order of the file.
struct List {
  std::vector<Complex> values;  ///< growth rate + i angular frequency, 1/s
  /// [value] its number in the file, which begins with 1 and counts dropped entries too
  std::vector<long> numbers;
  std::string layout;   ///< program, units and signs, for messages
  long conjugates = 0;  ///< dropped entries, whose conjugates are listed too
  long mirrored = 0;    ///< entries with Im s < 0, replaced by their conjugates
  long skipped = 0;     ///< modes below the last one that have no row in the table of a program
};

/// Returns the list in this text. Throws Error, without the name of the file, if the text contains
/// no list or several, if an entry is not finite, if figures of an entry contradict each other, or
/// if the unit of columns is not known.
List parse(std::string_view text, Format format, std::optional<Unit> unit);

/// Collective. Returns the list in the file of the settings, which rank 0 reads. Throws Error as
/// parse() does, naming the option and the file.
List read(MPI_Comm comm, const Settings& settings);

}  // namespace squeal::eigenlist
