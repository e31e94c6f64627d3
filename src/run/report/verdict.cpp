// SPDX-License-Identifier: BSD-2-Clause
#include "run/report/verdict.hpp"

#include <algorithm>
#include <cmath>

#include "base/system/text.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::report {
namespace {

/// The unstable eigenvalues of a run.
struct UnstableModes {
  const pencil::Eigenvalue* fastest = nullptr;  ///< borrowed
  sweep::Parameters at;                         ///< its point
  std::string name;                             ///< of its motion; empty if unclear
  double lowestFriction = INFINITY;             ///< of a point with an unstable mode
  int eigenvalues = 0;                          ///< of all points, stable ones included
};

/// Counts points and eigenvalues by verdict.
UnstableModes count(const analysis::Analysis& analysis, RunVerdict& verdict) {
  UnstableModes modes;
  for (const auto& segment : analysis.flutter.segments)
    for (const auto& point : segment.points) {
      ++verdict.pointsSolved;
      verdict.undecided += point.count(pencil::Verdict::undecided);
      verdict.uncertified += point.count(pencil::Verdict::uncertified);
      modes.eigenvalues += std::ssize(point.eigenvalues);
      verdict.pointsUnknown += point.stabilityIsUnknown();
      const int unstable = point.unstableCount();
      verdict.mostUnstable = std::max(verdict.mostUnstable, unstable);
      if (unstable == 0) continue;
      ++verdict.pointsUnstable;
      modes.lowestFriction = std::min(modes.lowestFriction, point.at.friction);
      for (std::size_t i = 0; i < point.eigenvalues.size(); ++i) {
        const auto& e = point.eigenvalues[i];
        if (!e.unstable || (modes.fastest && e.s.real() <= modes.fastest->s.real())) continue;
        const auto shape = std::ranges::find(point.shapes, i, &pencil::Shape::index);
        modes.fastest = &e, modes.at = point.at;
        modes.name = shape == point.shapes.end() ? "" : pencil::modeName(shape->components);
      }
    }
  return modes;
}

/// Returns the lowest critical friction at which stability is lost by an eigenvalue in the band;
/// none if an eigenvalue may lose it at a lower one.
std::optional<double> firstLoss(const analysis::Analysis& analysis) {
  std::optional<double> lowest;
  double uncertain = INFINITY;  // lower end of the lowest step with a loss
  const double top = analysis.flutter.bandTop();
  for (const auto& segment : analysis.flutter.segments)
    for (const auto& tracked : segment.trackedLines)
      for (const auto& critical : tracked.criticals)
        if (!critical.loss || critical.angularFrequency > top)
          continue;
        else if (critical.converged)
          lowest = std::min(lowest.value_or(INFINITY), critical.friction);
        else
          uncertain = std::min(uncertain, critical.friction - critical.errorEstimate);
  return lowest && uncertain < *lowest ? std::nullopt : lowest;
}

std::string placeText(const std::vector<sweep::Parameters>& points, int solved) {
  if (solved < std::ssize(points))
    return formatted("at the %d of %zu points of the sweep that have a result", solved,
                     points.size());
  return points.size() > 1 ? "at all points of the sweep"
                           : formatted("at friction %g", points.front().friction);
}

/// Returns what the sentence on stability must not hide: points and eigenvalues without verdict.
std::string openText(const RunVerdict& verdict) {
  std::string text;
  const auto add = [&](int count, const char* one, const char* several) {
    if (count > 0) text += formatted("; %d %s", count, count == 1 ? one : several);
  };
  add(verdict.undecided, "eigenvalue is undecided", "eigenvalues are undecided");
  add(verdict.uncertified, "eigenvalue is uncertified", "eigenvalues are uncertified");
  add(verdict.pointsUnknown, "point has no eigenvalue in the band, so its stability is unknown",
      "points have no eigenvalue in the band, so their stability is unknown");
  return text;
}

std::string stableSentence(const std::vector<sweep::Parameters>& points, const RunVerdict& verdict,
                           int eigenvalues) {
  const int known = verdict.pointsSolved - verdict.pointsUnknown;
  if (eigenvalues == 0)
    return "No eigenvalue was found in the band " + placeText(points, verdict.pointsSolved) + ".";
  const std::string where =
      verdict.pointsUnknown > 0
          ? formatted("at the %d of %zu points of the sweep with a known stability", known,
                      points.size())
          : placeText(points, known);
  return "Stable " + where + openText(verdict) + ".";
}

std::string onsetText(const std::vector<sweep::Parameters>& points, const RunVerdict& verdict,
                      double lowestFriction) {
  if (verdict.criticalFriction)
    return *verdict.criticalFriction > 0
               ? formatted("Stable up to friction %.6g", *verdict.criticalFriction)
               : "Unstable as soon as there is friction";
  const bool above = std::ranges::any_of(
      points, [&](const sweep::Parameters& at) { return at.friction < lowestFriction; });
  return formatted(above ? "Unstable from friction %g on" : "Unstable at friction %g already",
                   lowestFriction);
}

std::string unstableSentence(const std::vector<sweep::Parameters>& points,
                             const RunVerdict& verdict, const UnstableModes& modes) {
  std::string others;
  for (const auto& parameter : sweep::sweptParameters(points))
    if (parameter.value != &sweep::Parameters::friction)
      others += formatted(", %s %g", parameter.name, modes.at.*parameter.value);
  const auto& fastest = *modes.fastest;
  return onsetText(points, verdict, modes.lowestFriction) +
         formatted(
             "; above it, up to %d unstable mode%s at once. The fastest-growing one, at %.6g Hz, "
             "has a growth rate of %.4g 1/s (damping %.3g %%) at friction %g",
             verdict.mostUnstable, verdict.mostUnstable > 1 ? "s" : "",
             fastest.s.imag() / (2 * M_PI), fastest.s.real(), 100 * fastest.dampingRatio(),
             modes.at.friction) +
         others + (modes.name.empty() ? "" : ": " + modes.name) + openText(verdict) + ".";
}

std::string interruptedSentence(const RunVerdict& verdict, const UnstableModes& modes) {
  std::string found = "all of them are stable";
  if (modes.fastest)
    found = formatted("the lowest friction among them with an unstable mode is %g",
                      modes.lowestFriction);
  else if (verdict.pointsUnknown > 0)
    found = "none of them has an unstable mode";
  return formatted("The run was stopped before its end: %d of %d points are solved, and ",
                   verdict.pointsSolved, verdict.points) +
         found + openText(verdict) + ".";
}

}  // namespace

RunVerdict runVerdict(const analysis::Analysis& analysis) {
  const auto points = analysis.sweep.points();
  RunVerdict verdict;
  verdict.points = int(points.size());
  const UnstableModes modes = count(analysis, verdict);
  if (modes.fastest && sweep::sweptParameters(points).size() <= 1)
    if (const auto loss = firstLoss(analysis); loss && *loss <= modes.lowestFriction)
      verdict.criticalFriction = loss;
  if (analysis.interrupted())
    verdict.sentence = interruptedSentence(verdict, modes);
  else if (verdict.pointsSolved == 0)
    verdict.sentence = "No point of the sweep has a steady sliding state.";
  else if (!modes.fastest)
    verdict.sentence = stableSentence(points, verdict, modes.eigenvalues);
  else
    verdict.sentence = unstableSentence(points, verdict, modes);
  return verdict;
}

}  // namespace squeal::report
