// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Steady points of a mesh whose active sets differ little share the factorisation and the basis of
/// the contact that is closed wherever it is closed at any of them.
#include <memory>
#include <optional>
#include <vector>

#include "eigen/sweep_solver/sweep_solver.hpp"
#include "model/contact/coupled.hpp"
#include "problem/terms/influence.hpp"
#include "run/analysis/steady_sweep.hpp"

namespace squeal::analysis {

/// Collective. Returns the first steady point behind those that share a basis with point `first`,
/// which has a solution. They have the same active set, or, unless something asks for the matrices
/// of one active set by themselves, sets that differ in few nodes, `-flutter_released`.
std::size_t endOfShared(const Analysis& analysis, std::size_t first);

/// Returns the unknowns of `all`, whose gaps and sticking nodes are free in more places, as those
/// that `interior` has too and the others, the boundary; `all` is borrowed.
subspace::Substructure substructureOf(const contact::CoupledSystem& all,
                                      const contact::CoupledSystem& interior);

/// The problem of the steady points [first, last).
class MeshSweep : public sweep_solver::SweepProblem {
 public:
  /// Collective. Borrows all arguments during the life of the object.
  MeshSweep(const Analysis& analysis, std::size_t first, std::size_t last, CurrentSystem& current,
            terms::Influences& influences);
  std::vector<pencil::Term> termsOf(std::size_t i) const override;
  std::optional<std::vector<pencil::Term>> termsAt(const sweep::Parameters& at,
                                                   std::size_t like) override;
  void examine(std::size_t i, const pencil::Pencil& pencil, const sensitivity::StartSpace& start,
               pencil::ComplexModes& point) override;

 private:
  /// An active set of the points [first, last), or one that is passed through between points.
  struct OnPath {
    contact::ActiveSet set;
    std::size_t first = 0, last = 0;
  };
  const steady::Solution& steadyAt(std::size_t i) const { return analysis_.steady[first_ + i]; }
  void findSets();
  std::vector<sweep_solver::PointRange> pointRanges() const;
  std::optional<double> frictionOfPointBefore() const;
  std::vector<sweep_solver::PathPiece> piecesBehind(std::size_t point);
  std::vector<pencil::Term> termsOf(const steady::Solution& solution) const;

  const Analysis& analysis_;
  std::size_t first_;
  CurrentSystem& current_;
  terms::Influences& influences_;
  std::vector<OnPath> sets_;     // [range]
  contact::ActiveSet anywhere_;  // of all sets
  OwnedMat prestress_;           // of the first point, which K0 contains
  std::unique_ptr<contact::CoupledSystem> stressed_, released_;
  const contact::CoupledSystem* interior_ = nullptr;  // active wherever a point is
  const contact::CoupledSystem* all_ = nullptr;       // active where all points are
  std::unique_ptr<steady::Problem> problem_;          // for points between those of the sweep
};

}  // namespace squeal::analysis
