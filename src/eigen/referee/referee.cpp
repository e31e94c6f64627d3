// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/referee/referee.hpp"

#include <algorithm>
#include <cmath>

#include "base/session/stages.hpp"
#include "base/system/error.hpp"
#include "base/system/text.hpp"
#include "eigen/referee/kept_space.hpp"
#include "eigen/referee/norms.hpp"
#include "eigen/referee/rows.hpp"

namespace squeal::referee {
namespace {

constexpr double reach = 1.7;    // of the free modes, relative to the top
constexpr double nearby = 1.12;  // of eigenvalues that get corrections: the top may move
constexpr double leastLeft = 0.02, mostLeft = 0.2;
constexpr int rounds = 2;

double largest(std::span<const Complex> list) {
  double size = 0;
  for (const auto s : list) size = std::max(size, std::abs(s));
  return size;
}

/// Returns the largest −Re s of the list, at most this.
double mostDamped(std::span<const Complex> list, double limit) {
  double decay = 0;
  for (const auto s : list)
    if (-s.real() <= limit) decay = std::max(decay, -s.real());
  return decay;
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
FreeModes freeModes(const ShiftedSystem& shifted, double top, const modes::Settings& given) {
  const auto& system = shifted.system;
  modes::Settings settings = given;
  settings.sturm = true;
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
  found.modes =
      modes::compute(system, settings, {.stage = "modes", .subject = "for the referee: "});
  if (given.countGiven) {
    found.below = found.modes.inertiaShift;
    found.counted = found.modes.inertiaCount;
  }
  found.confirmed = agrees(found.modes.lambda, found.counted, found.below);
  return found;
}

/// Returns the first gap of the eigenvalues on V above the list: an eigenvalue is in the list if
/// it is within 1 % of an entry.
double topAbove(std::span<const Complex> list, std::span<const Complex> values, double limit) {
  constexpr double same = 0.01;
  double inside = largest(list), outside = limit;
  for (const auto s : values) {
    const double size = std::abs(s);
    const bool known = std::ranges::any_of(
        list, [&](Complex entry) { return std::abs(entry - s) <= same * size; });
    if (known && size < limit) inside = std::max(inside, size);
  }
  for (const auto s : values)
    if (std::abs(s) > inside) outside = std::min(outside, std::abs(s));
  return (inside + outside) / 2;
}

/// Returns why the count is not proved; empty if it is.
std::string reasonOf(const proof::CountProof& count) {
  const std::string place = formatted("s = %.6g %+.6gi", count.place.real(), count.place.imag());
  switch (count.verdict) {
    case proof::Verdict::proved:
      return "";
    case proof::Verdict::indefinite:
      return formatted(
          "the part left out is not bounded (delta %.2g); more free modes (-modes_count), or a "
          "smaller -referee_left of a strongly damped problem, would help",
          count.definiteness);
    case proof::Verdict::edge:
      return "an eigenvalue lies on the boundary at " + place + "; another -referee_top would help";
    case proof::Verdict::ratio:
      return formatted("the ratio is %.3g at ", count.ratio) + place +
             "; more free modes (-modes_count) or another -referee_top would help";
    case proof::Verdict::tooManyDiscs:
      return formatted("%" PetscInt_FMT " expansions do not suffice at ", count.evaluations) +
             place + "; another -referee_top, or more -referee_discs, would help";
    default:
      return "the reduced problem is singular at the top, or nearly so";
  }
}

/// Everything that the proof needs.
struct Prepared {
  proof::KeptProblem kept;
  proof::LeftOut bounds;
};

/// Proves the count, with the reach to the left that the settings or the list ask for; if that
/// fails, with the smallest one.
void proveIn(const proof::DiagonalForm& form, const proof::LeftOut& bounds,
             std::span<const Complex> list, const Settings& settings, Judgement& judgement) {
  const double top = judgement.region.top;
  if (!judgement.damped) {
    judgement.count = proof::proveCount(form, bounds, judgement.region, settings.discs);
    return;
  }
  std::vector<double> lefts{settings.left};
  if (settings.left == 0)
    lefts = {std::max(leastLeft, 1.05 * mostDamped(list, mostLeft * top) / top), leastLeft};
  const auto values = form.eigenvalues();
  for (const double left : lefts) {
    judgement.region.left = left >= 1 ? 2 * top : proof::placedLeft(values, top, left * top, 0.3);
    judgement.count = proof::proveCount(form, bounds, judgement.region, settings.discs);
    if (judgement.count.verdict == proof::Verdict::proved) return;
  }
}

/// Collective. Builds V and its couplings.
Prepared prepare(const SplitProblem& problem, const ShiftedSystem& shifted, const FreeModes& free,
                 double wanted, Judgement& judgement) {
  KeptSpace space(problem, shifted, free.modes);
  const double left = problem.damped() ? 1.5 * mostLeft * wanted : INFINITY;
  for (int round = 0; round < rounds && !space.isWhole(); ++round)
    space.correct(
        space.pairs([&](Complex s) { return std::abs(s) < nearby * wanted && s.real() > -left; }));
  Prepared prepared;
  prepared.kept = space.problem(wanted);
  const PetscInt counted = free.confirmed ? free.counted : 0;
  prepared.bounds =
      space.leftOut(counted, counted > 0 ? free.modes.lambda[counted - 1] : 0, free.below);
  boundOthers(problem, shifted.system, prepared.bounds);
  judgement.basis = space.size();
  judgement.solves = space.solves();
  return prepared;
}

}  // namespace

Judgement judge(const Problem& at, std::span<const Complex> list, const Settings& settings,
                const modes::Settings& modeSettings) {
  const double wanted = settings.top > 0 ? settings.top : 1.04 * largest(list);
  if (!(wanted > 0)) throw Error("the list has only zeros; give -referee_top");
  Judgement judgement;
  const SplitProblem problem(at.pencil, at.at);
  const ShiftedSystem shifted = shiftedSystem(problem, wanted);
  judgement.unknowns = shifted.system.size();
  judgement.shift = shifted.shift;
  judgement.asymmetry = problem.asymmetry();
  judgement.damped = problem.damped();
  const FreeModes free = freeModes(shifted, wanted, modeSettings);
  judgement.modes = std::ssize(free.modes.lambda);
  Stage stage(shifted.system.comm(), "referee");
  const Prepared prepared = prepare(problem, shifted, free, wanted, judgement);
  const proof::DiagonalForm form(prepared.kept, wanted);
  const auto values = form.eigenvalues();
  judgement.region.top =
      settings.top > 0 ? proof::placedTop(values, wanted) : topAbove(list, values, nearby * wanted);
  proveIn(form, prepared.bounds, list, settings, judgement);
  judgement.why = reasonOf(judgement.count);
  if (!free.confirmed && judgement.basis < judgement.unknowns)
    judgement.why = "the inertia does not confirm the number of free modes";
  const auto discs = judgement.proved() || free.confirmed
                         ? proof::enclose(form, prepared.bounds, judgement.region, judgement.count)
                         : std::vector<proof::Enclosure>();
  setRows(list, discs, settings.tolerance, judgement);
  stage.finish(judgement.sentence());
  return judgement;
}

}  // namespace squeal::referee
