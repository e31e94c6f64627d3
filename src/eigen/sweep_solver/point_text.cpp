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

void requireFiniteEigenvalues(const pencil::ComplexModes& point) {
  for (const auto& e : point.eigenvalues)
    if (!std::isfinite(e.s.real()) || !std::isfinite(e.s.imag()) || !std::isfinite(e.backwardError))
      throw Error("an eigenvalue at " + sweep::parameterText(point.at) +
                  " is not finite: check the magnitudes of materials and factors");
}

}  // namespace squeal::sweep_solver
