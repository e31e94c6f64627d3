// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/referee/referee.hpp"

#include <algorithm>
#include <cmath>

#include "base/session/stages.hpp"
#include "base/system/error.hpp"
#include "base/system/text.hpp"
#include "eigen/proof/matrix_bounds.hpp"
#include "eigen/referee/kept_space.hpp"
#include "eigen/referee/rows.hpp"

namespace squeal::referee {
namespace {

constexpr double reach = 1.7;    // of the free modes, relative to the top
constexpr double nearby = 1.12;  // of eigenvalues that get corrections: the top may move
constexpr double guard = 1.3;    // the same of a damped problem: it makes the ratio smaller

double largest(std::span<const Complex> list) {
  double size = 0;
  for (const auto s : list) size = std::max(size, std::abs(s));
  return size;
}

/// The free modes in V, and the number of eigenvalues below θ by the inertia.
struct FreeModes {
  modes::Modes modes;
  PetscInt counted = 0;
  double below = 0;        ///< θ
  bool confirmed = false;  ///< as many of the modes lie below θ
};

/// Returns true if `counted` eigenvalues lie below the shift, and none is near it.
bool agrees(const std::vector<double>& lambda, PetscInt counted, double shift) {
  constexpr double apart = 1e-6;
  return std::ranges::count_if(lambda, [&](double value) { return value < shift; }) == counted &&
         std::ranges::none_of(
             lambda, [&](double value) { return std::abs(value - shift) < apart * shift; });
}

/// Collective. Returns the free modes that the proof needs: as many as are given, or all up to the
/// reach and some more.
FreeModes freeModes(const ShiftedSystem& shifted, double top, const modes::Settings& given,
                    const std::string& purpose) {
  const auto& system = shifted.system;
  modes::Settings settings = given;
  settings.sturm = true;
  // The eigenvalues of K + σ M may lie so close together, compared with their distance from zero,
  // that block Lanczos makes no progress.
  if (shifted.shift > 0 && settings.solver == modes::Settings::Solver::automatic)
    settings.solver = modes::Settings::Solver::eps;
  FreeModes found;
  if (!given.countGiven) {
    constexpr int beyond = 4;
    found.below = reach * reach * top * top + shifted.shift;
    found.counted = factor::shiftedFactor(system.k0(), system.m0(), found.below, system.solver())
                        ->inertia()
                        .negative;
    const PetscInt most = system.size() - factor::zeroRows(system.m0());
    settings = settings.withCount(static_cast<int>(std::min(found.counted + beyond, most)));
  }
  found.modes = modes::compute(system, settings, {.stage = "modes", .subject = purpose});
  if (given.countGiven) {
    found.below = found.modes.inertiaShift;
    found.counted = found.modes.inertiaCount;
  }
  found.confirmed = agrees(found.modes.lambda, found.counted, found.below);
  return found;
}

/// Returns the middle of a gap of the eigenvalues on V above the list: of the first one, or of a
/// wider one that begins at most 1 % higher, since the first one may divide a flutter pair. An
/// eigenvalue is in the list if it is within 1 % of an entry.
double topAbove(std::span<const Complex> list, std::span<const Complex> values, double limit) {
  constexpr double same = 0.01;
  double inside = largest(list);
  for (const auto s : values) {
    const double size = std::abs(s);
    const bool known = std::ranges::any_of(
        list, [&](Complex entry) { return std::abs(entry - s) <= same * size; });
    if (known && size < limit) inside = std::max(inside, size);
  }
  std::vector<double> ends{inside, std::max(limit, inside)};
  for (const auto s : values)
    if (const double size = std::abs(s); size > inside && size < limit) ends.push_back(size);
  std::ranges::sort(ends);
  std::size_t widest = 1;
  for (std::size_t k = 2; k < ends.size() && ends[k - 1] <= (1 + same) * inside; ++k)
    if (ends[k] - ends[k - 1] > ends[widest] - ends[widest - 1]) widest = k;
  return (ends[widest - 1] + ends[widest]) / 2;
}

/// Collective. Adds to `bounds` the bounds of M_a, C and G on the space that V leaves out, for
/// regions with |s| ≤ `top` and Re s ≥ −`left`, rad/s.
void boundOthers(const SplitProblem& problem, const factor::AssociatedSystem& system, double top,
                 double left, proof::LeftOut& bounds) {
  if (bounds.mass == 0) return;  // nothing is left out
  const Mat skewMass = problem.skew(2), gyroscopic = problem.skew(1),
            damping = problem.symmetric(1);
  if (!skewMass && !gyroscopic && !damping) return;
  const proof::MatrixBounds others(system, bounds.mass, {skewMass, gyroscopic, damping});
  bounds.skewMass = others.ofSkew(skewMass, top * top);
  bounds.gyroscopic = others.ofSkew(gyroscopic, top);
  const auto [whole, below] = others.ofDamping(damping, left, top);
  bounds.damping = whole;
  bounds.rest[1] += below;
}

}  // namespace

BoundedProblem bounded(const Problem& at, double top, const modes::Settings& settings,
                       const Log& log) {
  BoundedProblem result;
  result.wanted = top;
  const SplitProblem problem(at.pencil, at.at);
  const ShiftedSystem shifted = shiftedSystem(problem, top);
  const FreeModes free = freeModes(shifted, top, settings, log.subject);
  Stage stage(shifted.system.comm(), log.stage);
  KeptSpace space(problem, shifted, free.modes, at.vectors);
  const double left = problem.damped() ? 1.5 * proof::mostLeft * top : INFINITY,
               reached = (problem.damped() ? guard : nearby) * top;
  for (int round = 0; round < at.rounds && !space.isWhole(); ++round)
    space.correct(
        space.pairs([&](Complex s) { return std::abs(s) < reached && s.real() > -left; }));
  result.projected = space.problem();
  result.confirmed = free.confirmed || space.isWhole();
  const PetscInt counted = free.confirmed ? free.counted : 0;
  result.leftOut =
      space.leftOut(counted, counted > 0 ? free.modes.lambda[counted - 1] : 0, free.below);
  boundOthers(problem, shifted.system, top, std::min(left, top), result.leftOut);
  result.sizes = {.unknowns = shifted.system.size(),
                  .modes = static_cast<PetscInt>(std::ssize(free.modes.lambda)),
                  .basis = space.size(),
                  .shift = shifted.shift,
                  .asymmetry = problem.asymmetry(),
                  .damped = problem.damped(),
                  .solves = space.solves()};
  stage.finish(log.subject + formatted("basis of %" PetscInt_FMT ", %ld solves", result.sizes.basis,
                                       result.sizes.solves));
  return result;
}

Judgement judge(const BoundedProblem& problem, std::span<const Complex> list,
                const Settings& settings) {
  Judgement judgement;
  judgement.sizes = problem.sizes;
  const proof::DiagonalForm form(problem.projected.kept(problem.wanted), problem.wanted);
  const auto values = form.eigenvalues();
  judgement.region.top = settings.top > 0
                             ? proof::placedTop(values, problem.wanted, settings.within)
                             : topAbove(list, values, nearby * problem.wanted);
  if (judgement.sizes.damped) {
    auto [region, count] = proof::proveDamped(form, problem.leftOut, judgement.region.top,
                                              settings.left, list, settings.discs);
    judgement.region = region;
    judgement.count = std::move(count);
  } else {
    judgement.count = proof::proveCount(form, problem.leftOut, judgement.region, settings.discs);
  }
  judgement.why = problem.confirmed ? proof::reason(judgement.count, settings.remedies)
                                    : "the inertia does not confirm the number of free modes";
  const auto discs = problem.confirmed
                         ? proof::enclose(form, problem.leftOut, judgement.region, judgement.count)
                         : std::vector<proof::Enclosure>();
  setRows(list, discs, settings.tolerance, judgement);
  return judgement;
}

Judgement judge(const Problem& problem, std::span<const Complex> list, const Settings& settings,
                const modes::Settings& modes) {
  const double wanted = settings.top > 0 ? settings.top : 1.04 * largest(list);
  if (!(wanted > 0)) throw Error("the list has only zeros; give -referee_top");
  const BoundedProblem reduced = bounded(problem, wanted, modes, Log());
  Stage stage(problem.pencil.comm(), "referee");
  const Judgement judgement = judge(reduced, list, settings);
  stage.finish(judgement.sentence());
  return judgement;
}

}  // namespace squeal::referee
