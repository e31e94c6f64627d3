// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/mesh_sweep.hpp"

#include <algorithm>

#include "base/session/stages.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/text.hpp"
#include "model/elasticity/elasticity.hpp"
#include "problem/energies/shares.hpp"
#include "problem/terms/friction_work.hpp"
#include "problem/terms/terms.hpp"
#include "run/analysis/mode_components.hpp"
#include "steady/steady/limit_states.hpp"
#include "steady/steady/prestress.hpp"

namespace squeal::analysis {
subspace::Substructure substructureOf(const contact::CoupledSystem& all,
                                      const contact::CoupledSystem& interior) {
  auto unknowns = contact::compared(all.transformation(), interior.transformation());
  return {all.k0(), std::move(unknowns.shared), std::move(unknowns.released)};
}

MeshSweep::MeshSweep(const SlidingBrake& brake, const PointGroup& group, int segmentsBefore,
                     CurrentSystem& current, terms::Influences& influences,
                     const energies::Components& components)
    : brake_(brake),
      group_(group),
      current_(current),
      influences_(influences),
      components_(components) {
  const auto& [mesh, bodies, contact] = brake.model;
  for (std::size_t i = group.first; i < group.last; ++i)
    steadyPoints.push_back(brake.states.solutions[i].at);
  findSets();
  prestress_ = steady::prestressOf(*mesh, bodies, steadyAt(0));
  const auto systemOf = [&](const contact::ActiveSet& set) {
    if (!prestress_) return current.make(set);
    return std::make_unique<contact::CoupledSystem>(brake.model.bodies, brake.model.contact, set,
                                                    prestress_);
  };
  contact::ActiveSetHull hull(sets_.front().set);
  for (const auto& one : sets_) hull.add(one.set);
  anywhere_ = hull.anywhere;
  const contact::ActiveSet& everywhere = hull.everywhere;
  const bool differ = !contact::sameOnAllRanks(brake.comm(), anywhere_, everywhere);
  if (prestress_)
    stressed_ = systemOf(anywhere_);
  else if (differ)
    current.open();  // for both systems
  all_ = interior_ = stressed_ ? stressed_.get() : &current.of(anywhere_);
  if (differ) {
    Stage stage(brake.comm(), "contact");
    released_ = systemOf(everywhere);
    all_ = released_.get();
    substructure = substructureOf(*all_, *interior_);
    current.dropOpen();  // the basis needs the memory; making them again takes a few seconds
    stage.finish(formatted(
        "%" PetscInt_FMT " nodes open or slide in some of %zu active sets that share a basis",
        contact::countDifferent(brake.comm(), anywhere_, everywhere), sets_.size()));
  }
  system = interior_;
  ownTrial_ = all_->transformation().trial.share();
  trial = ownTrial_;
  pencil = terms::affineTerms(contact, *all_);
  ranges = pointRanges();
  frictionBefore = frictionOfPointBefore();
  if (frictionBefore) whyNoBasis = brake_.mesh().whySeparate;
  for (std::size_t i = 0; i < steadyPoints.size(); ++i)
    if (const auto& why = brake_.states.whyNotFromZero; group.first + i < why.size())
      whyNotFromZero.push_back(why[group.first + i]);
  continues = group.continues;
  isContinued = group.isContinued;
  rangesBefore = segmentsBefore;
}

/// Collective. Finds the active sets of the points and of the way between them.
void MeshSweep::findSets() {
  for (std::size_t i = 0; i < steadyPoints.size(); ++i) {
    std::vector<sweep_solver::PathPiece> pieces;
    if (i > 0 && sweep::growsInFriction(steadyPoints[i - 1], steadyPoints[i]))
      pieces = piecesAfter(i - 1);
    const contact::ActiveSet set = steady::activeSet(steadyAt(i));
    const double friction = steadyPoints[i].friction,
                 from = pieces.empty() ? friction : pieces.back().to;
    if (i > 0 && contact::sameOnAllRanks(brake_.comm(), set, steady::activeSet(steadyAt(i - 1)))) {
      const std::size_t range = *steps.back().back().range;
      sets_[range].last = i + 1;
      pieces.push_back({range, from, friction});
    } else {
      sets_.push_back({set, i, i + 1});
      pieces.push_back({sets_.size() - 1, from, friction});
    }
    steps.push_back(std::move(pieces));
  }
}

/// Collective. Returns the pieces of the path from a point to where the active set of the next one
/// on its line begins. If that is not known, it begins at the next point.
std::vector<sweep_solver::PathPiece> MeshSweep::piecesAfter(std::size_t point) {
  const sweep::Parameters &here = steadyPoints[point], &next = steadyPoints[point + 1];
  std::vector<condensed::ContactEvent> events;
  for (const auto& event : brake_.states.path)
    if (event.point == group_.first + point + 1) events.push_back(event);
  std::vector<double> own;
  for (const auto& event : events) own.push_back(event.at.friction);
  std::vector<double> frictions = concatenated(brake_.comm(), own);
  std::ranges::sort(frictions);
  frictions.erase(std::ranges::unique(frictions).begin(), frictions.end());
  contact::ActiveSet set = steady::activeSet(steadyAt(point));
  std::vector<contact::ActiveSet> after;  // [friction] the set beyond it
  for (const double friction : frictions) {
    for (const auto& event : events)
      if (event.at.friction == friction) {
        set.closed[event.node] = event.change != condensed::Change::opens;
        set.released[event.node] = event.isReleased;
      }
    after.push_back(set);
  }
  const contact::ActiveSet last = steady::activeSet(steadyAt(point + 1));
  // Whether a node of an interface with `_release` slides is known only at the points. A node that
  // opens or closes takes the state of the next point with that event; where other nodes begin or
  // cease to slide is not known.
  const auto& interfaces = brake_.model.contact.interfaces;
  const contact::Mask& closedBefore = steadyAt(point).closed;
  for (std::size_t i = 0; i < set.released.size(); ++i)
    if (interfaces.options[interfaces.nodes[i].interface].releases &&
        (!closedBefore[i] || !last.closed[i]))
      set.released[i] = last.released[i];
  const std::size_t range = *steps[point].back().range;
  const bool changes =
      !contact::sameOnAllRanks(brake_.comm(), steady::activeSet(steadyAt(point)), last);
  if (!contact::sameOnAllRanks(brake_.comm(), set, last) || (changes && frictions.empty()))
    return {{std::nullopt, next.friction, next.friction}};
  std::vector<sweep_solver::PathPiece> pieces;
  double from = here.friction;
  for (std::size_t k = 0; k < frictions.size(); ++k) {
    pieces.push_back({k == 0 ? range : sets_.size() - 1, from, frictions[k]});
    if (k + 1 < frictions.size()) sets_.push_back({after[k], 0, 0});
    from = frictions[k];
  }
  if (pieces.empty()) pieces.push_back({range, from, from});
  return pieces;
}

/// Returns the friction of the point before the first one, if the two differ only in friction.
std::optional<double> MeshSweep::frictionOfPointBefore() const {
  if (group_.first == 0 || group_.continues) return {};
  const steady::Solution& before = brake_.states.solutions[group_.first - 1];
  if (!before.converged || !sweep::growsInFriction(before.at, steadyPoints[0])) return {};
  return before.at.friction;
}

/// Collective. Returns the active sets with their points, boundary unknowns and terms.
std::vector<sweep_solver::PointRange> MeshSweep::pointRanges() {
  std::vector<sweep_solver::PointRange> found;
  const auto& contact = brake_.model.contact;
  const PetscInt dimension = contact.mesh->dimension;
  const auto& rows = all_->transformation().rows;
  const Concatenation ranks(brake_.comm(), substructure.boundary.size());
  const contact::Mask some = slidingInSome();
  const Concatenation factorRows(brake_.comm(), std::ranges::count(some, 1));
  std::vector<PetscInt> contactNode(contact.mesh->ownedNodes, -1);
  for (std::size_t i = 0; i < contact.interfaces.nodes.size(); ++i)
    contactNode[contact.interfaces.nodes[i].node] = i;
  for (const auto& [set, first, last] : sets_) {
    sweep_solver::PointRange range;
    range.first = first, range.last = last;
    range.openNodes = std::ranges::count(set.closed, 0);
    range.openNodes = mpi::sum(brake_.comm(), range.openNodes);
    std::vector<unsigned char> own;
    for (const PetscInt k : substructure.boundary) {
      const PetscInt i = contactNode[rows[k] / dimension];
      const bool isGap = rows[k] % dimension == dimension - 1;
      own.push_back(!set.closed[i] || (!isGap && set.released[i]));
    }
    range.has = ranks.gathered(own);
    contact::Mask slides = set.closed;
    std::vector<unsigned char> ownRows;
    for (std::size_t i = 0; i < slides.size(); ++i) {
      slides[i] = slides[i] && some[i];
      if (some[i]) ownRows.push_back(slides[i]);
    }
    if (range.isPassed() && contact.slipIsConstant()) {
      const auto rows = factorRows.gathered(ownRows);
      for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i]) range.slidingRows.push_back(i);
    }
    if (ranks.size() > 0) {
      // Most changes on a path concern nodes without friction.
      if (slides_.empty() || contact::countDifferent(brake_.comm(), slides, slides_.back()) > 0)
        slides_.push_back(std::move(slides));
      range.terms = [this, k = slides_.size() - 1] { return slidingTerms(k); };
    }
    found.push_back(std::move(range));
  }
  return found;
}

/// Collective. Returns the friction terms of a set of nodes that slide, by its index.
std::vector<pencil::Term> MeshSweep::slidingTerms(std::size_t set) {
  constexpr std::size_t most = 2;  // a path may pass through hundreds of sets
  auto known = std::ranges::find(sliding_, set, &SlidingTerms::set);
  if (known == sliding_.end()) {
    if (sliding_.size() == most) sliding_.erase(sliding_.begin());
    sliding_.push_back({set, terms::slidingTerms(brake_.model.contact, *all_, slides_[set])});
  } else {
    std::rotate(known, known + 1, sliding_.end());  // the most recently used one is the last
  }
  std::vector<pencil::Term> shared;
  for (const auto& term : sliding_.back().terms) shared.push_back(term.share());
  return shared;
}

/// Returns the nodes that slide in some of the sets, but not in all.
contact::Mask MeshSweep::slidingInSome() const {
  contact::Mask nodes = anywhere_.closed;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    nodes[i] = nodes[i] && !all_->closed()[i] &&
               brake_.model.contact.interfaces.nodes[i].role == contact::Role::sliding;
  return nodes;
}

pencil::FrictionFactors MeshSweep::releasedFriction() const {
  return terms::frictionFactors(brake_.model.contact, *all_, slidingInSome());
}

pencil::JumpFactors MeshSweep::jumpFactors() const {
  if (prestress_) return {{}, {}, {}, "the geometric stiffness differs between points"};
  return terms::jumpFactors(brake_.model.contact, *all_, anywhere_.closed);
}

pencil::PointFactors MeshSweep::factorsAt(std::size_t i) const {
  return terms::pointFactors(brake_.model.contact, steadyAt(i), anywhere_.closed,
                             brake_.mesh().terms);
}

sweep_solver::RangeFactors MeshSweep::frictionFactors() const {
  sweep_solver::RangeFactors factors{
      terms::frictionFactors(brake_.model.contact, *all_, anywhere_.closed), {}};
  const auto& all = anywhere_.closed;
  const Concatenation ranks(brake_.comm(), std::ranges::count(all, 1));
  for (const auto& one : sets_) {
    std::vector<unsigned char> own;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i]) own.push_back(one.set.closed[i]);
    const auto closed = ranks.gathered(own);
    auto& rows = factors.rowsOf.emplace_back();
    for (std::size_t i = 0; i < closed.size(); ++i)
      if (closed[i]) rows.push_back(i);
  }
  return factors;
}

std::vector<pencil::Term> MeshSweep::termsOf(std::size_t i) const { return termsOf(steadyAt(i)); }

std::vector<pencil::Term> MeshSweep::termsOf(const steady::Solution& solution) const {
  OwnedMat change;
  if (prestress_ && &solution != &steadyAt(0)) {
    change = steady::prestressOf(*brake_.model.mesh, brake_.model.bodies, solution);
    check(MatAXPY(change, -1, prestress_, SAME_NONZERO_PATTERN));
  }
  return terms::pointTerms(brake_.model.contact, *all_, solution, change, brake_.mesh().terms);
}

/// Collective. Returns the steady state at a point with an active set, borrowed if it is one of the
/// sweep; null if no state with this set is found.
std::shared_ptr<const steady::Solution> MeshSweep::solutionOn(const contact::ActiveSet& set,
                                                              const sweep::Parameters& at) {
  sweep::Parameters steady = at;
  steady.damping = 1;
  const auto& solutions = brake_.states.solutions;
  const auto known = std::ranges::find(solutions, steady, &steady::Solution::at);
  if (known != solutions.end() && known->converged &&
      contact::sameOnAllRanks(brake_.comm(), steady::activeSet(*known), set))
    return {std::shared_ptr<void>(), &*known};
  if (!problem_)
    problem_ = std::make_unique<steady::Problem>(*brake_.model.mesh, brake_.model.bodies,
                                                 brake_.model.contact);
  auto solution = problem_->solve(steady, current_.of(anywhere_));
  if (!solution.converged) return {};
  auto onSet = steady::onActiveSet(brake_.model.contact, std::move(solution), set);
  return onSet ? std::make_shared<const steady::Solution>(std::move(*onSet)) : nullptr;
}

std::optional<sweep_solver::PointBetween> MeshSweep::between(const sweep::Parameters& at,
                                                             std::size_t range) {
  const auto solution = solutionOn(sets_[range].set, at);
  if (!solution) return {};
  return sweep_solver::PointBetween{termsOf(*solution), [=, this](const pencil::Pencil& ofPoint) {
                                      return formsOf(at, solution, ofPoint);
                                    }};
}

/// Collective. Returns the forms at a point with this steady state.
sensitivity::Forms MeshSweep::formsOf(const sweep::Parameters& at,
                                      std::shared_ptr<const steady::Solution> solution,
                                      const pencil::Pencil& ofPoint) const {
  const auto prestress = std::make_shared<const OwnedMat>(
      steady::prestressOf(*brake_.model.mesh, brake_.model.bodies, *solution));
  const auto state = std::make_shared<const terms::BodyPoint>(
      terms::BodyPoint{at, *interior_, *solution, *prestress});
  // The forms borrow the state.
  return [solution, prestress, state, forms = influences_.forms(ofPoint, *state)](
             const sensitivity::EigenTriple& triple) { return forms(triple); };
}

std::vector<pencil::CriticalMode> MeshSweep::describe(
    const std::vector<pencil::ComplexMotion>& motions, const modes::Modes& modes) const {
  auto found = analysis::describe(*all_, motions, modes);
  for (std::size_t i = 0; i < motions.size(); ++i)
    found[i].name = energies::nameOfMotion(components_, brake_.model.bodies,
                                           linalg::product(trial, *motions[i].x));
  return found;
}

void MeshSweep::addComponents(sweep_solver::ModalSegment& segment) const {
  analysis::addComponents(components_, brake_.model.bodies, trial, prestress_, segment);
  addParticipations(*all_, segment);
  addCorrelations(components_.bodyMac(), trial, segment);
}

/// Collective. Adds to a shape of a point its friction work and the shares of the components.
void MeshSweep::addEnergies(const Energies& at, const pencil::ComplexModes& point,
                            pencil::Shape& shape) const {
  const auto& [mesh, bodies, contact] = brake_.model;
  const auto u = linalg::ComplexVector::copied(shape.real, shape.imaginary);
  const terms::Motion motion{point.at, point.eigenvalues[shape.index].s, u, at.prestress};
  const auto force = terms::motionForces(bodies, motion);
  const auto friction =
      terms::frictionGrowth(contact, at.solution.closed, at.friction, motion, force);
  shape.frictionWork.clear();
  for (const auto& growth : friction) shape.frictionWork.push_back(growth.sum());
  double modal = 0;
  if (brake_.settings.pencil.isModallyDamped())
    modal = energies::modalGrowth(at.pencil, shape.unknowns, bodies, motion, force.energy);
  shape.components =
      energies::sharesOfComplexMode(components_, bodies, contact, {motion, force, friction, modal});
}

void MeshSweep::examine(std::size_t i, const pencil::Pencil& ofPoint,
                        const sensitivity::StartSpace& start, pencil::ComplexModes& point) {
  if (point.shapes.empty()) return;
  const steady::Solution& solution = steadyAt(i);
  const OwnedMat prestress = steady::prestressOf(*brake_.model.mesh, brake_.model.bodies, solution);
  const auto friction = terms::frictionState(brake_.model.contact, solution, brake_.mesh().terms);
  for (auto& shape : point.shapes)
    addEnergies({solution, friction, prestress, ofPoint}, point, shape);
  if (!brake_.settings.solver.sensitivity.wanted) return;
  Stage stage(brake_.model.mesh->comm, "flutter");
  influences_.derive(point, ofPoint, {point.at, *interior_, solution, prestress}, start);
  double error = 0;
  for (const auto& sensitivity : point.sensitivities)
    error = std::max(error, sensitivity.leftBackwardError);
  stage.finish(formatted("%s: sensitivities of %zu eigenvalues, worst left backward error %.1e",
                         sweep::parameterText(point.at).c_str(), point.sensitivities.size(),
                         error));
}

}  // namespace squeal::analysis
