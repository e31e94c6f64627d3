// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sensitivity/derive.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "algebra/linalg/null_vectors.hpp"
#include "base/system/mpi.hpp"
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

/// The eigenvalue next to another one, with vectors of the reduced problem.
struct Neighbour {
  Complex s;
  linalg::ComplexVector x, y;
};

/// Collective. Returns the eigenvalue nearest to one of a point: another one of its list, or the
/// mirror image in the imaginary axis of a problem in s². None without a reduced problem.
std::optional<Neighbour> neighbour(const pencil::ComplexModes& point, std::size_t index,
                                   const pencil::Pencil& pencil, const StartSpace& start) {
  if (start.projected.order() == 0) return {};
  const Complex s = point.eigenvalues[index].s;
  Complex nearest{INFINITY, 0};
  const auto consider = [&](Complex other) {
    if (std::abs(other - s) < std::abs(nearest - s)) nearest = other;
  };
  for (std::size_t i = 0; i < point.eigenvalues.size(); ++i)
    if (i != index) consider(point.eigenvalues[i].s);
  if (!pencil.hasPower(1)) consider(-std::conj(s));
  if (!std::isfinite(nearest.real()) || nearest == s) return {};
  auto vectors = linalg::nullVectors(start.projected, nearest, true);
  for (auto* vector : {&vectors.right, &vectors.left})
    mpi::broadcastEntries<Complex>(pencil.comm(), *vector, 0);
  return Neighbour{nearest, expanded(pencil, start.columns, vectors.right),
                   expanded(pencil, start.columns, vectors.left)};
}

/// Collective. Returns the second derivatives by one neighbour [M.90], one for each form,
///   s'' = 2 p_ij p_ji / (n_i n_j (s_i − s_j)),
/// with the forms p_ij = y_iᴴ (∂P/∂θ) x_j. `slopes` is n_i n_j with n_i = y_iᴴ P′ x_i.
std::vector<Complex> secondDerivatives(const EigenTriple& triple, const Neighbour& next,
                                       Complex slopes, const Forms& forms) {
  const auto there = forms({triple.s, next.x, triple.y}), back = forms({next.s, triple.x, next.y});
  std::vector<Complex> second;
  for (std::size_t k = 0; k < there.size(); ++k)
    second.push_back(2.0 * there[k].value * back[k].value / (slopes * (triple.s - next.s)));
  return second;
}

}  // namespace

void deriveShapes(pencil::ComplexModes& point, const pencil::Pencil& pencil,
                  const StartSpace& start, const factor::AssociatedSystem& system,
                  const Forms& forms) {
  if (point.shapes.empty()) return;
  std::vector<RightPair> pairs;
  for (const auto& shape : point.shapes)
    pairs.push_back({point.eigenvalues[shape.index].s, &shape.unknowns});
  const auto left = leftVectors(pencil, point.at, start, system.solver(), pairs, {});
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const EigenTriple triple{pairs[i].s, *pairs[i].vector, left[i].vector};
    const Complex slope = slopeForm(pencil, point.at, triple);
    pencil::Sensitivity result{condition(triple, slope, system.m0()),
                               separation(point.eigenvalues, point.shapes[i].index),
                               left[i].backwardError,
                               {}};
    if (result.regular()) {
      result.derivatives = forms(triple);
      for (auto& derivative : result.derivatives) derivative.value /= -slope;
      if (const auto next = neighbour(point, point.shapes[i].index, pencil, start)) {
        const Complex ofNext = slopeForm(pencil, point.at, {next->s, next->x, next->y});
        const auto second = secondDerivatives(triple, *next, slope * ofNext, forms);
        for (std::size_t k = 0; k < second.size(); ++k) result.derivatives[k].second = second[k];
      }
    }
    point.sensitivities.push_back(std::move(result));
  }
}

void deriveCritical(const CriticalPoint& point, const pencil::Pencil& pencil,
                    const StartSpace& start, const factor::AssociatedSystem& system,
                    const Forms& forms, pencil::CriticalMode& mode) {
  // Backward errors: those that are sought, since the scale of a residual is ‖K‖ and not the
  // distance to the next eigenvalue; and the limit of Sensitivity::regular().
  constexpr double accurate = 1e-7;
  const Search search{.accuracy = 1e-14, .simple = point.isCrossing};
  const Complex s{0, point.angularFrequency};
  const auto right = rightVector(pencil, point.at, start, system.solver(), s, search);
  const auto left =
      leftVectors(pencil, point.at, start, system.solver(), {{s, &right.vector}}, search);
  mode.rightBackwardError = right.backwardError;
  mode.leftBackwardError = left[0].backwardError;
  if (!(right.backwardError <= accurate && left[0].backwardError <= accurate)) return;
  const EigenTriple triple{s, right.vector, left[0].vector};
  const auto list = forms(triple);
  const auto friction = std::ranges::find(list, "friction", &pencil::Derivative::parameter);
  ensure(friction != list.end(), "the forms of a critical point include that of friction");
  // A crossing keeps Re s = 0. Where two eigenvalues meet, yᴴ P′ x = 0, and they keep meeting if
  // the sum of the forms vanishes.
  const Complex unit = point.isCrossing ? slopeForm(pencil, point.at, triple) : friction->value;
  const double change = (friction->value / unit).real();
  if (!(std::abs(change) > 0) || !std::isfinite(change)) return;
  for (const auto& form : list)
    if (form.parameter != friction->parameter)
      mode.derivatives.push_back({form.parameter, -(form.value / unit).real() / change});
}

Forms parameterForms(const pencil::Pencil& pencil, const sweep::Parameters& at) {
  return [&pencil, at](const EigenTriple& triple) {
    std::vector<pencil::Derivative> found;
    for (const auto& parameter : sweep::allParameters)
      if (parameter.value != &sweep::Parameters::pressure)
        found.push_back({parameter.name, parameterForm(pencil, at, triple, parameter.value)});
    return found;
  };
}

void deriveParameters(pencil::ComplexModes& point, const pencil::Pencil& pencil,
                      const StartSpace& start, const factor::AssociatedSystem& system) {
  deriveShapes(point, pencil, start, system, parameterForms(pencil, point.at));
}

}  // namespace squeal::sensitivity
