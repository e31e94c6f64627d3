// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/matrix_referee.hpp"

#include "base/session/stages.hpp"
#include "base/system/text.hpp"
#include "run/analysis/matrix_flutter.hpp"

namespace squeal::analysis {
namespace {

/// Returns the eigenvalues that are proved, each with the radius of its disc as error.
pencil::ComplexModes provedModes(const referee::Judgement& judgement, const sweep::Parameters& at) {
  pencil::ComplexModes point;
  point.at = at;
  point.damped = judgement.sizes.damped;
  for (const auto& disc : judgement.eigenvalues) {
    if (disc.isolation != proof::Isolation::single) continue;
    pencil::Eigenvalue e;
    e.s = {disc.s.real(), std::max(disc.s.imag(), 0.0)};
    e.backwardError = NAN;
    e.error = disc.inner;
    e.certified = true;
    point.eigenvalues.push_back(e);
  }
  pencil::setVerdicts(point, pencil::Symmetry::none, {});
  std::size_t i = 0;
  for (const auto& disc : judgement.eigenvalues) {
    if (disc.isolation != proof::Isolation::single) continue;
    if (disc.neutral) point.eigenvalues[i].verdict = pencil::Verdict::neutral;
    if (disc.neutral) point.eigenvalues[i].unstable = false;
    ++i;
  }
  return point;
}

}  // namespace

eigenlist::List readList(MPI_Comm comm, const Settings& settings, const sweep::Sweep& sweep) {
  if (sweep.pointCount() > 1)
    throw Error(
        formatted("option %s: a list belongs to one point, but the sweep has %.0f; give "
                  "one value of -flutter_friction, _speed and _damping",
                  eigenlist::listOption().c_str(), sweep.pointCount()));
  Stage stage(comm, "list");
  auto list = eigenlist::read(comm, settings.referee->list);
  constexpr double largest = 1e50;  // rad/s; squares remain finite
  for (const Complex s : list.values)
    if (std::abs(s) > largest)
      throw Error(formatted("option %s: the entry %g%+gi is larger than %g rad/s",
                            eigenlist::listOption().c_str(), s.real(), s.imag(), largest));
  std::string halves;
  if (list.conjugates > 0) halves = formatted("; %ld conjugates dropped", list.conjugates);
  if (list.skipped > 0) halves += formatted("; %ld mode numbers without a row", list.skipped);
  if (list.mirrored > 0)
    halves += formatted("; %ld with Im s < 0 taken as their conjugates", list.mirrored);
  stage.finish(formatted("%zu eigenvalues with Im s ≥ 0 (%s)%s", list.values.size(),
                         list.layout.c_str(), halves.c_str()));
  return list;
}

JudgedList judgeList(MPI_Comm comm, const Settings& settings, const sweep::Sweep& sweep,
                     Flutter& flutter) {
  JudgedList result{.list = readList(comm, settings, sweep), .judgement = {}};
  auto named = readMatrices(comm, settings, sweep);
  std::vector<pencil::Term> terms;
  for (auto& item : named) terms.push_back(std::move(item.term));
  const pencil::Pencil pencil(std::move(terms));
  const auto at = sweep.points().front();
  result.judgement = referee::judge({pencil, at}, result.list.values, settings.referee->proof,
                                    settings.solver.modes.value_or(modes::Settings()));
  if (!result.judgement.sizes.damped && settings.referee->proof.left > 0)
    printLine(comm,
              "option -referee_left was not used: without terms in s the region is a whole disc");
  flutter.segments.resize(1);
  flutter.segments[0].unknowns = result.judgement.sizes.unknowns;
  flutter.segments[0].solves = result.judgement.sizes.solves;
  flutter.segments[0].points.push_back(provedModes(result.judgement, at));
  flutter.complete = true;
  return result;
}

}  // namespace squeal::analysis
