// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/reduction/projected_basis.hpp"

#include <algorithm>

#include "algebra/linalg/serialization.hpp"
#include "base/petsc/arrays.hpp"

namespace squeal::reduction {

ProjectedBasis::ProjectedBasis(const pencil::Pencil& pencil, const factor::AssociatedSystem& system,
                               const modes::Modes& modes, Substructure substructure)
    : basis_(modes, system, std::move(substructure)), terms_(basis_, pencil.terms()) {
  basis_.releaseForces();
  check(MatGetSize(basis_.stiffness(), &unknowns_, nullptr));
  serialised_ = basis_.size();
}

int ProjectedBasis::addSet(const pencil::Pencil& pencil, const std::vector<unsigned char>& has) {
  const auto shared = std::make_shared<const pencil::Pencil>(pencil.with({}));
  const int number = newSet([shared] { return shared->with({}); }, has);
  projectTerms(*sets_[number]);
  return number;
}

int ProjectedBasis::addPassedSet(std::function<pencil::Pencil()> pencil,
                                 const std::vector<unsigned char>& has,
                                 std::vector<PetscInt> slidingRows) {
  ensure(slidingRows.empty() || (friction_ && slidingRows.back() < friction_->rows()),
         "the factors of friction have the rows of each active set");
  const int number = newSet(std::move(pencil), has);
  sets_[number]->slidingRows = std::move(slidingRows);
  return number;
}

int ProjectedBasis::newSet(std::function<pencil::Pencil()> pencil,
                           const std::vector<unsigned char>& has) {
  sets_.push_back(
      std::make_unique<PointSet>(PointSet{.space = PointSpace(basis_.boundaryStiffness(), has),
                                          .pencil = std::move(pencil),
                                          .terms = {},
                                          .slidingRows = {},
                                          .top = 0,
                                          .modesInBand = 0}));
  return std::ssize(sets_) - 1;
}

void ProjectedBasis::load(int number) {
  auto& set = *sets_[number];
  if (const auto known = std::ranges::find(loaded_, number); known != loaded_.end()) {
    loaded_.erase(known);
  } else {
    if (set.terms) return;  // the set of a point
    if (loaded_.size() == mostLoaded) {
      sets_[loaded_.front()]->terms.reset();
      loaded_.erase(loaded_.begin());
    }
    projectTerms(set);
  }
  loaded_.push_back(number);
}

void ProjectedBasis::projectTerms(PointSet& set) const {
  const pencil::Pencil pencil = set.pencil();
  set.terms.emplace(basis_,
                    std::span(pencil.terms()).first(pencil.affineCount()).subspan(terms_.count()));
}

PointState ProjectedBasis::state(const PointProblem& point, const Norms& norms) const {
  PointState state{.point = &point,
                   .set = sets_[point.set].get(),
                   .ownTerms = ProjectedTerms(basis_, point.pencil.pointSums(point.at)),
                   .damped = point.pencil.hasPower(1)};
  state.solution.norms = norms;
  return state;
}

void ProjectedBasis::extend(const std::vector<PointState*>& states) {
  terms_.extend();
  if (friction_) friction_->extend();
  for (auto& set : sets_)
    if (set->terms) set->terms->extend();
  for (auto* state : states) state->ownTerms.extend();
  basis_.releaseForces();  // used by no later extension
}

linalg::DenseProblem ProjectedBasis::project(const PointState& state) const {
  return state.set->space.restricted(projectOnAll(state));
}

linalg::DenseProblem ProjectedBasis::projectOnAll(const PointState& state) const {
  const Weights weights{state.point->at, state.associated};
  linalg::DenseProblem problem = projectOnAll(weights, *state.set);
  state.ownTerms.addTo(weights, problem);
  return problem;
}

linalg::DenseProblem ProjectedBasis::projectOnAll(const sweep::Parameters& at,
                                                  const PointSet& set) const {
  return projectOnAll({at, false}, set);
}

linalg::DenseProblem ProjectedBasis::projectOnAll(const Weights& weights,
                                                  const PointSet& set) const {
  linalg::DenseProblem problem;
  terms_.addTo(weights, problem);
  if (set.terms)
    set.terms->addTo(weights, problem);
  else if (friction_ && !weights.associated)
    friction_->addTo(weights.at, set.slidingRows, problem);
  return problem;
}

linalg::DenseProblem ProjectedBasis::projectAssociated() const {
  linalg::DenseProblem problem;
  terms_.addTo({.at = {}, .associated = true}, problem);
  return problem;
}

linalg::DenseProblem ProjectedBasis::projectOwn(const PointState& state) const {
  linalg::DenseProblem problem;
  state.ownTerms.addTo({state.point->at, false}, problem);
  return state.set->space.restricted(std::move(problem));
}

linalg::DenseMatrix ProjectedBasis::residualSketch(const PointState& state, const PointPairs& pairs,
                                                   pencil::Side side) const {
  linalg::DenseMatrix sketch(2 * subspace::Sketch::size, pairs.pairs.columns);
  for (const auto* terms : {&terms_, &state.set->terms.value(), &state.ownTerms})
    terms->addTo(pairs, side, sketch);
  return sketch;
}

linalg::Block ProjectedBasis::residualColumns(const PointState& state,
                                              const linalg::DensePair& pair,
                                              const linalg::ComplexVector& vector,
                                              pencil::Side side) const {
  const linalg::ComplexVector residual =
      pencil::residual(state.point->pencil, state.point->at, pair.s, vector, side);
  const bool real = Coordinates({&pair}, state.damped, state.set->space).isReal(0);
  linalg::Block result(basis_.localRows());
  for (const Vec part : {residual.real.get(), residual.imaginary.get()}) {
    if (real && result.columns() == 1) break;
    const ReadArray entries(part);
    result.append(std::span(entries.begin(), entries.end()));
  }
  basis_.clearBoundary(result);
  return result;
}

linalg::Block ProjectedBasis::residuals(const std::vector<PairsOfPoint>& points,
                                        const linalg::DenseMatrix& combinations,
                                        Residual kind) const {
  linalg::Block columns(basis_.localRows(), combinations.columns());
  if (combinations.empty()) return columns;
  /// Pairs with terms that they alone have, or that all have.
  struct Share {
    const ProjectedTerms* terms;
    std::vector<const PointPairs*> pairs;
    linalg::DenseMatrix combinations;
  };
  std::vector<Share> shares{{&terms_, {}, combinations}};
  PetscInt first = 0;
  for (const auto& [state, pairs] : points) {
    shares.front().pairs.push_back(pairs);
    const PetscInt last = first + pairs->pairs.columns;
    for (const auto* terms : {&state->set->terms.value(), &state->ownTerms})
      shares.push_back({terms, {pairs}, linalg::rowRange(combinations, first, last)});
    first = last;
  }
  for (const auto& share : shares) share.terms->addThinTo(share.pairs, share.combinations, columns);
  linalg::DenseMatrix along;  // VᵀR of the residuals R
  if (kind == Residual::outside && terms_.hasStiffness()) {
    along = linalg::transposedProductWithSparse(basis_.comm(), basis_.columns(), columns);
    for (const auto& share : shares)
      linalg::addScaled(along, 1, share.terms->projectedWhole(share.pairs, share.combinations));
    for (PetscInt j = 0; j < along.columns(); ++j)
      std::ranges::fill(along.column(j).first(basis_.boundarySize()), 0.0);
  }
  for (const auto& share : shares)
    share.terms->addWholeTo(share.pairs, share.combinations,
                            share.terms == &terms_ ? along : linalg::DenseMatrix(), columns);
  basis_.clearBoundary(columns);
  return columns;
}

void ProjectedBasis::combine(const linalg::DenseMatrix& directions) {
  const PetscInt boundary = basis_.boundarySize();
  linalg::DenseMatrix all(basis_.size(), boundary + directions.columns());
  for (PetscInt j = 0; j < boundary; ++j) all(j, j) = 1;
  for (PetscInt j = 0; j < directions.columns(); ++j)
    std::ranges::copy(directions.column(j), all.column(boundary + j).begin() + boundary);
  basis_.combine(all);
  terms_.combine(all);
  if (friction_) friction_->combine(all);
  for (auto& set : sets_)
    if (set->terms) set->terms->combine(all);
}

void ProjectedBasis::serialise(checkpoint::Archive& archive) {
  for (auto& set : sets_) archive.common(set->top, set->modesInBand);
  double ratio = basis_.lastEnergyRatio();
  long solves = basis_.solves();
  archive.common(ratio, solves);
  if (archive.reads()) {
    linalg::DenseMatrix columns;
    archive.own(columns);
    basis_.restore(columns, ratio, solves);
    extend({});
  } else {
    linalg::borrow(archive.own, basis_.columns().columnRange(serialised_, basis_.size()));
  }
  serialised_ = basis_.size();
}

}  // namespace squeal::reduction
