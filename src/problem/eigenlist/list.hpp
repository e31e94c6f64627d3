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

/// Eigenvalues of a real problem, each with Im s ≥ 0; its conjugate counts as listed.
struct List {
  std::vector<Complex>
      values;           ///< growth rate + i angular frequency, 1/s, in the order of the file
  std::string layout;   ///< program, unit and sign, for messages
  long conjugates = 0;  ///< entries that were dropped as conjugates of others
  long mirrored = 0;    ///< entries with Im s < 0 that their conjugates replace
};

/// Returns the list in this text. Throws Error, without the name of the file, if there is none or
/// more than one, for an entry that is not finite, for figures of an entry that contradict each
/// other, and for columns whose unit is not known.
List parse(std::string_view text, Format format, std::optional<Unit> unit);

/// Collective. Returns the list of the settings, which rank 0 reads. Throws Error as parse() does,
/// naming the option and the file.
List read(MPI_Comm comm, const Settings& settings);

}  // namespace squeal::eigenlist
