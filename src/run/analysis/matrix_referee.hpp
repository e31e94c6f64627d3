// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The judgement of a list of eigenvalues for a problem given by matrices.
#include <string>

#include "eigen/referee/referee.hpp"
#include "eigen/sweep/sweep.hpp"
#include "problem/eigenlist/list.hpp"
#include "run/analysis/flutter.hpp"
#include "run/analysis/settings.hpp"

namespace squeal::analysis {

/// A list of eigenvalues and the judgement on it.
struct JudgedList {
  eigenlist::List list;
  referee::Judgement judgement;
};

/// Collective. Reads the list of `-referee_list`, and prints its size, units and sign conventions.
/// Throws Error as eigenlist::read() does, and if the sweep has more than one point.
eigenlist::List readList(MPI_Comm comm, const Settings& settings, const sweep::Sweep& sweep);

/// Collective. Judges the list at the only point of the sweep. Sets `flutter` to the eigenvalues
/// that are proved.
JudgedList judgeList(MPI_Comm comm, const Settings& settings, const sweep::Sweep& sweep,
                     Flutter& flutter);

}  // namespace squeal::analysis
