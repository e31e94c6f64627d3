// SPDX-License-Identifier: BSD-2-Clause
#include "run/report/stability_table.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/system/text.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/settings.hpp"
#include "eigen/sweep/parameters.hpp"
#include "run/report/branches.hpp"
#include "run/report/proofs.hpp"

namespace squeal::report {
namespace {

/// Returns friction, and the parameters that are not 1 throughout the sweep.
std::vector<sweep::Parameter> shownParameters(const analysis::Analysis& analysis) {
  const auto points = analysis.sweep.points();
  std::vector<sweep::Parameter> shown;
  std::copy_if(sweep::allParameters.begin(), sweep::allParameters.end(), std::back_inserter(shown),
               [&](const sweep::Parameter& parameter) {
                 return parameter.value == &sweep::Parameters::friction ||
                        std::any_of(points.begin(), points.end(), [&](const sweep::Parameters& at) {
                          return at.*parameter.value != 1;
                        });
               });
  return shown;
}

/// Returns the beginning of a line of a sweep.
std::string rowHead(const sweep::Parameters& at, const std::vector<sweep::Parameter>& shown) {
  std::string head = "\n";
  for (const auto& parameter : shown) head += formatted("%8g  ", at.*parameter.value);
  return head;
}

/// Returns a remark on eigenvalues of uncertain growth; empty if there are none.
std::string uncertaintyText(const pencil::ComplexModes& point) {
  const int undecided = point.count(pencil::Verdict::undecided);
  std::string text = point.verdict() == pencil::Verdict::uncertified ? " (uncertified)" : "";
  if (undecided > 0) text += formatted("; %d undecided", undecided);
  return text;
}

/// Returns the text for a point without unstable modes.
std::string stableText(const analysis::Analysis& analysis,
                       const sweep_solver::ModalSegment& segment,
                       const pencil::ComplexModes& point) {
  if (point.stabilityIsUnknown()) return "no eigenvalue was found, so stability is unknown";
  if (point.eigenvalues.empty()) return "none: the band is proved to contain no eigenvalue";
  if (segment.openNodes > 0 && segment.openNodes == analysis.model.contact.interfaces.totalNodes)
    return "none: no contact is closed, nothing slides";
  if (point.verdict() == pencil::Verdict::undecided) return "none" + uncertaintyText(point);
  const int neutral = point.count(pencil::Verdict::neutral);
  return "none: steady sliding is stable" + uncertaintyText(point) +
         (neutral > 0
              ? formatted(", %d of %zu eigenvalues neutral", neutral, point.eigenvalues.size())
              : "");
}

/// Returns one line for one point of a sweep, with the lowest unstable modes.
std::string sweepRow(const analysis::Analysis& analysis, const sweep_solver::ModalSegment& segment,
                     const pencil::ComplexModes& point,
                     const std::vector<sweep::Parameter>& shown) {
  std::string row = rowHead(point.at, shown);
  if (point.unstableCount() == 0) return row + stableText(analysis, segment, point);
  int count = 0;
  for (const auto& e : point.eigenvalues)
    if (e.unstable && ++count <= 6)
      row += formatted("%s%.6g (%.4g)", count > 1 ? ", " : "", e.s.imag() / (2 * M_PI), e.s.real());
  return row + (count > 6 ? formatted(", and %d more in eigenvalues.csv", count - 6) : "") +
         uncertaintyText(point);
}

/// Returns the unstable modes of a single point, one per line; modes are numbered by frequency.
std::string modeRows(const analysis::Analysis& analysis, const sweep_solver::ModalSegment& segment,
                     const pencil::ComplexModes& point) {
  if (point.unstableCount() == 0)
    return formatted("\nfriction %g  ", point.at.friction) + stableText(analysis, segment, point);
  std::string rows;
  for (std::size_t i = 0; i < point.eigenvalues.size(); ++i) {
    const auto& e = point.eigenvalues[i];
    if (e.unstable)
      rows += formatted("\n%4zu  %12.6g %12.5g", i + 1, e.s.imag() / (2 * M_PI), e.s.real());
  }
  const std::string uncertainty = uncertaintyText(point);
  return uncertainty.empty() ? rows : rows + "\n     " + uncertainty;
}

/// Returns a remark on the point with the largest number of free modes in the band without a listed
/// eigenvalue, because of strong damping; empty if there is none.
std::string strongDampingText(const analysis::Analysis& analysis) {
  const pencil::ComplexModes* most = nullptr;
  for (const auto& segment : analysis.flutter.segments)
    for (const auto& point : segment.points)
      if (point.modesWithoutEigenvalue() > (most ? most->modesWithoutEigenvalue() : 0))
        most = &point;
  if (!most) return "";
  return formatted(
      "\n%s: %d of the %d free modes in the band have no eigenvalue there: their damping ratio "
      "exceeds -flutter_band_damping, or damping has moved them out of the band. Such strong "
      "damping may need a larger -modes_count; check with -flutter_method direct.",
      sweep::parameterText(most->at).c_str(), most->modesWithoutEigenvalue(),
      most->freeModesInBand);
}

/// Returns a line for each point whose list of eigenvalues ends below the band.
std::string coverageText(const analysis::Analysis& analysis) {
  std::string text;
  for (const auto& segment : analysis.flutter.segments)
    for (const auto& point : segment.points)
      if (point.coveredTo < point.directBandTop)
        text +=
            formatted("\n%s: the band is covered only up to %.5g Hz; raise -flutter_direct_limit",
                      sweep::parameterText(point.at).c_str(), point.coveredTo / (2 * M_PI));
  return text;
}

/// Returns a line for each point with eigenvalues that could not be certified.
std::string uncertifiedText(const analysis::Analysis& analysis) {
  std::string text;
  for (const auto& segment : analysis.flutter.segments)
    for (const auto& point : segment.points)
      if (point.bandTop > 0 && point.uncertifiedCount() > 0)
        text += formatted("\n%s: %d eigenvalues could not be certified, see eigenvalues.csv; %s",
                          sweep::parameterText(point.at).c_str(), point.uncertifiedCount(),
                          std::isinf(point.bandTop)
                              ? "the basis is the whole space, so round-off limits their accuracy"
                              : "raise -modes_count or -flutter_rounds");
  return text;
}

/// Returns the band and the largest errors of all eigenvalues; empty for the direct method without
/// a band.
std::string errorText(const analysis::Analysis& analysis) {
  std::string text;
  const auto listsAny = [](const sweep_solver::ModalSegment& segment) {
    return std::any_of(segment.points.begin(), segment.points.end(),
                       [](const auto& point) { return !point.eigenvalues.empty(); });
  };
  if (std::none_of(analysis.flutter.segments.begin(), analysis.flutter.segments.end(), listsAny) ||
      analysis.flutter.segments.front().points.front().bandTop <= 0)
    return text;
  double backward = 0, estimate = 0, top = INFINITY;
  for (const auto& segment : analysis.flutter.segments)
    for (const auto& point : segment.points) {
      top = std::min(top, point.bandTop);
      backward = std::max(backward, point.worstBackwardError());
      estimate = std::max(estimate, point.worstErrorEstimate());
    }
  const double requested = analysis.settings.pencil.band.top;
  if (top < requested)
    text += formatted(
        "\nThe free modes end below the %.5g Hz of -flutter_band, and so do the eigenvalues: "
        "raise -modes_count.",
        requested / (2 * M_PI));
  if (std::isfinite(top)) {
    text += formatted("\nEigenvalues with |s|/2π up to %.5g Hz", top / (2 * M_PI));
  } else {
    text += "\nAll eigenvalues";
    if (requested > 0) text += ", as the basis is the whole space (-flutter_band was not used)";
  }
  text += formatted(
      ": backward errors in the full-order problem up to %.1e, estimated errors |ds|/|s| up to "
      "%.1e.",
      backward, estimate);
  return text;
}

}  // namespace

std::string stabilityTable(const analysis::Analysis& analysis) {
  const bool sweep = analysis.sweep.points().size() > 1;
  const auto shown = shownParameters(analysis);
  std::string table = sweep ? "\n" : "\nmode  frequency Hz   growth 1/s";
  if (sweep) {
    for (const auto& parameter : shown) table += formatted("%8s  ", parameter.name);
    table += "unstable modes: frequency Hz (growth 1/s)";
  }
  for (const auto& solution : analysis.steady.solutions)
    if (!solution.converged)
      table += rowHead(solution.at, shown) +
               formatted("no steady sliding solution found (%s)", solution.reason.c_str());
  for (const auto& segment : analysis.flutter.segments)
    for (const auto& point : segment.points)
      table +=
          sweep ? sweepRow(analysis, segment, point, shown) : modeRows(analysis, segment, point);
  return table + coverageText(analysis) + strongDampingText(analysis) + uncertifiedText(analysis) +
         errorText(analysis) + trackingText(analysis) + proofText(analysis);
}

}  // namespace squeal::report
