// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep_solver/point_text.hpp"

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
  text += formatted("%d eigenvalues below %.6g Hz proved, ratio %.2g, %d discs", found.count,
                    found.top / (2 * M_PI), found.ratio, found.discs);
  text += formatted(", %zu of %zu listed in discs of their own",
                    point.eigenvalues.size() - point.withoutDisc(), point.eigenvalues.size());
  for (const auto& one : found.missing)
    text += formatted(", missing within %.2g of %.9g%+.9gi", one.radius, one.centre.real(),
                      one.centre.imag());
  return text;
}

void requireFiniteEigenvalues(const pencil::ComplexModes& point) {
  for (const auto& e : point.eigenvalues)
    if (!std::isfinite(e.s.real()) || !std::isfinite(e.s.imag()) || !std::isfinite(e.backwardError))
      throw Error("an eigenvalue at " + sweep::parameterText(point.at) +
                  " is not finite: check the magnitudes of materials and factors");
}

}  // namespace squeal::sweep_solver
