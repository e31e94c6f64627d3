// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep_solver/point_text.hpp"

#include <algorithm>
#include <cmath>

#include "base/system/error.hpp"
#include "base/system/text.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::sweep_solver {

std::string pointText(const pencil::ComplexModes& point) {
  std::string text =
      formatted("%s: %d of %zu eigenvalues unstable", sweep::parameterText(point.at).c_str(),
                point.unstableCount(), point.eigenvalues.size());
  for (const auto verdict : {pencil::Verdict::undecided, pencil::Verdict::uncertified})
    if (const int count = point.count(verdict); count > 0)
      text += formatted(", %d %s", count, pencil::text(verdict));
  if (point.bandTop > 0 && std::isfinite(point.bandTop))
    text += formatted(" to %.4g Hz", point.bandTop / (2 * M_PI));
  text += formatted(", worst backward error %.1e", point.worstBackwardError());
  if (point.tolerance > 0) text += formatted(", estimated error %.1e", point.worstErrorEstimate());
  return text;
}

std::string completenessText(const pencil::ComplexModes& point) {
  const auto& found = *point.completeness;
  std::string text = sweep::parameterText(point.at) + ": ";
  if (!found.proved) return text + "not proved: " + found.reason;
  text += formatted("%g eigenvalues below ", found.pairs()) +
          roundedDown(found.top / (2 * M_PI), 6) + " Hz";
  if (std::isfinite(found.left)) text += " with Re s > -" + roundedDown(found.left, 4) + "/s";
  text += formatted(" proved, ratio %.2g, %d discs", found.ratio, found.discs);
  const auto left = std::ranges::count_if(point.eigenvalues,
                                          [&](const auto& e) { return e.s.real() <= -found.left; });
  const auto judged = static_cast<int>(point.eigenvalues.size() - left);
  text +=
      formatted(", %d of %d listed in discs of their own", judged - point.withoutDisc(), judged);
  if (left > 0) text += formatted(", %td listed farther left", left);
  for (const auto& one : found.missing)
    text += ", missing within " + roundedUp(one.radius, 2) +
            formatted(" of %.9g%+.9gi", one.centre.real(), one.centre.imag());
  for (const auto s : found.spurious)
    text += formatted(", %.9g%+.9gi is not an eigenvalue", s.real(), s.imag());
  for (const auto s : found.undecided)
    text += formatted(", undecided near %.9g%+.9gi", s.real(), s.imag());
  return text;
}

void requireFiniteEigenvalues(const pencil::ComplexModes& point) {
  for (const auto& e : point.eigenvalues)
    if (!std::isfinite(e.s.real()) || !std::isfinite(e.s.imag()) || !std::isfinite(e.backwardError))
      throw Error("an eigenvalue at " + sweep::parameterText(point.at) +
                  " is not finite: check the magnitudes of materials and factors");
}

}  // namespace squeal::sweep_solver
