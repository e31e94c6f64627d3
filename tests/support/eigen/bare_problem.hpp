// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The problem of a sweep whose points are not examined.
#include "eigen/sweep_solver/sweep_problem.hpp"

namespace squeal::test {

struct BareProblem : sweep_solver::SweepProblem {
  void examine(std::size_t, const pencil::Pencil&, const sensitivity::StartSpace&,
               pencil::ComplexModes&) override {}
};

}  // namespace squeal::test
