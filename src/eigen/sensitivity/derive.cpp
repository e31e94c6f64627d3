// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sensitivity/derive.hpp"

#include <algorithm>
#include <cmath>

#include "eigen/sweep/parameters.hpp"

namespace squeal::sensitivity {
namespace {

double separation(const std::vector<pencil::Eigenvalue>& eigenvalues, std::size_t index) {
  double smallest = INFINITY;
  const Complex s = eigenvalues[index].s;
  for (std::size_t i = 0; i < eigenvalues.size(); ++i)
    if (i != index) smallest = std::min(smallest, std::abs(eigenvalues[i].s - s));
  return smallest / std::abs(s);
}

}  // namespace

void deriveShapes(pencil::ComplexModes& point, const pencil::Pencil& pencil,
                  const StartSpace& start, const factor::AssociatedSystem& system,
                  const Forms& forms) {
  if (point.shapes.empty()) return;
  std::vector<RightPair> pairs;
  for (const auto& shape : point.shapes)
    pairs.push_back({point.eigenvalues[shape.index].s, &shape.unknowns});
  const auto left = leftVectors(pencil, point.at, start, system.solver(), pairs);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const EigenTriple triple{pairs[i].s, *pairs[i].vector, left[i].y};
    const Complex slope = slopeForm(pencil, point.at, triple);
    pencil::Sensitivity result{condition(triple, slope, system.m0()),
                               separation(point.eigenvalues, point.shapes[i].index),
                               left[i].backwardError,
                               {}};
    if (result.regular()) result.derivatives = forms(triple);
    for (auto& derivative : result.derivatives) derivative.value /= -slope;
    point.sensitivities.push_back(std::move(result));
  }
}

void deriveParameters(pencil::ComplexModes& point, const pencil::Pencil& pencil,
                      const StartSpace& start, const factor::AssociatedSystem& system) {
  deriveShapes(point, pencil, start, system, [&](const EigenTriple& triple) {
    std::vector<pencil::Derivative> found;
    for (const auto& parameter : sweep::allParameters)
      if (parameter.value != &sweep::Parameters::pressure)
        found.push_back({parameter.name, parameterForm(pencil, point.at, triple, parameter.value)});
    return found;
  });
}

}  // namespace squeal::sensitivity
