// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The eigenvalue problems of groups of sweep points. Points whose active sets differ little share
/// one factorisation and one basis. The factorisation and the free modes in the basis are those
/// of the union of the active sets: a node is closed (or held) if it is closed (or held) at any
/// point of the group.
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "eigen/sweep_solver/sweep_solver.hpp"
#include "model/contact/coupled.hpp"
#include "problem/energies/components.hpp"
#include "problem/terms/influence.hpp"
#include "run/analysis/point_groups.hpp"
#include "run/analysis/sliding_brake.hpp"

namespace squeal::analysis {

/// Divides the unknowns of `all`, which is borrowed, into two parts. The interior consists of the
/// unknowns that `interior` also has. The boundary consists of those that only `all` has: gaps, and
/// tangential displacements of nodes of sticking interfaces.
subspace::Substructure substructureOf(const contact::CoupledSystem& all,
                                      const contact::CoupledSystem& interior);

/// The problem of one group of points.
class MeshSweep : public sweep_solver::SweepProblem {
 public:
  /// Collective. Borrows all arguments for the lifetime of the object. `segmentsBefore` is the
  /// total number of segments of the preceding groups (rangesBefore).
  MeshSweep(const SlidingBrake& brake, const PointGroup& group, int segmentsBefore,
            CurrentSystem& current, terms::Influences& influences,
            const energies::Components& components);
  const PointGroup& group() const { return group_; }
  std::vector<pencil::Term> termsOf(std::size_t i) const override;
  sweep_solver::RangeFactors frictionFactors() const override;
  pencil::JumpFactors jumpFactors() const override;
  pencil::PointFactors factorsAt(std::size_t i) const override;
  pencil::FrictionFactors releasedFriction() const override;
  std::optional<sweep_solver::PointBetween> between(const sweep::Parameters& at,
                                                    std::size_t range) override;
  void examine(std::size_t i, const pencil::Pencil& pencil, const sensitivity::StartSpace& start,
               pencil::ComplexModes& point) override;
  std::vector<pencil::CriticalMode> describe(const std::vector<pencil::ComplexMotion>& motions,
                                             const modes::Modes& modes) const override;
  /// Collective. Adds the energy shares of the parts of the model to all modes of a segment, and
  /// the participation of the free modes to its complex modes.
  void addComponents(sweep_solver::ModalSegment& segment) const;

 private:
  /// An active set and the points [first, last) of the group that have it; first = last = 0 if it
  /// occurs only between two points.
  struct SetOnPath {
    contact::ActiveSet set;
    std::size_t first = 0, last = 0;
  };
  const steady::Solution& steadyAt(std::size_t i) const {
    return brake_.states.solutions[group_.first + i];
  }
  /// The data of a point that are common to its modes, all borrowed.
  struct Energies {
    const steady::Solution& solution;
    const terms::FrictionState& friction;
    Mat prestress;
    const pencil::Pencil& pencil;
  };
  void addEnergies(const Energies& at, const pencil::ComplexModes& point,
                   pencil::Shape& shape) const;
  contact::Mask slidingInSome() const;
  void findSets();
  std::vector<sweep_solver::PointRange> pointRanges();
  std::vector<pencil::Term> slidingTerms(std::size_t set);
  std::optional<double> frictionOfPointBefore() const;
  std::vector<sweep_solver::PathPiece> piecesAfter(std::size_t point);
  std::vector<pencil::Term> termsOf(const steady::Solution& solution) const;
  std::shared_ptr<const steady::Solution> solutionOn(const contact::ActiveSet& set,
                                                     const sweep::Parameters& at);
  sensitivity::Forms formsOf(const sweep::Parameters& at,
                             std::shared_ptr<const steady::Solution> solution,
                             const pencil::Pencil& pencil) const;

  const SlidingBrake& brake_;
  PointGroup group_;
  CurrentSystem& current_;
  terms::Influences& influences_;
  const energies::Components& components_;
  /// The terms of a set of nodes that slide.
  struct SlidingTerms {
    std::size_t set;  // index in slides_
    std::vector<pencil::Term> terms;
  };

  std::vector<SetOnPath> sets_;        // [range]
  std::vector<contact::Mask> slides_;  // nodes that slide; a range that repeats the mask adds none
  std::vector<SlidingTerms> sliding_;  // of the masks used last
  contact::ActiveSet anywhere_;        // union: a node is closed if any of the sets closes it
  OwnedMat prestress_;                 // K_σ of the first point, which is part of K0
  std::unique_ptr<contact::CoupledSystem> stressed_, released_;
  const contact::CoupledSystem* interior_ = nullptr;  // closed: the nodes closed in any set
  const contact::CoupledSystem* all_ = nullptr;       // closed: those closed in all sets
  OwnedMat ownTrial_;                                 // T of all_, kept when current_ changes
  std::unique_ptr<steady::Problem> problem_;          // for points between those of the sweep
};

}  // namespace squeal::analysis
