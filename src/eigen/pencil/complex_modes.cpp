// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/pencil/complex_modes.hpp"

#include <algorithm>
#include <cmath>

#include "base/petsc/check.hpp"

namespace squeal::pencil {
namespace {

/// Without an estimate of its error, a growth rate up to this fraction of |s| counts as round-off,
/// which splits double eigenvalues by the square root of the machine precision or more.
constexpr double noise = 1e-6;
/// The largest condition number for which derivatives are computed. At this value, relative errors
/// of 1e-8 in the vectors change yᴴ P′ x by a thousandth.
constexpr double worstCondition = 1e5;
/// Largest backward error of a left vector for which derivatives are computed.
constexpr double worstLeftError = 1e-7;
/// Derivatives are computed for eigenvalues farther apart than this; round-off splits a multiple
/// eigenvalue by less.
constexpr double closest = 1e-7;

/// Returns true if every other eigenvalue, and the image −conj s of this one, is farther away than
/// the sum of both errors. The distance to the edge of the band must exceed twice the error, since
/// the eigenvalues beyond are unknown.
bool isolated(const ComplexModes& point, const Eigenvalue& e) {
  const double error = e.error, top = point.bandTop > 0 ? point.bandTop : INFINITY;
  if (e.s.real() != 0 && std::abs(e.s.real()) <= error) return false;
  if (!(std::abs(e.s) + 2 * error < top)) return false;
  return std::ranges::all_of(point.eigenvalues, [&](const Eigenvalue& other) {
    return &other == &e || std::abs(other.s - e.s) > error + other.error;
  });
}

}  // namespace

double Derivative::growthHoldsTo() const {
  return 0.2 * std::abs(value.real()) / std::abs(second.real());
}

bool Sensitivity::regular() const {
  return leftBackwardError < worstLeftError && condition < worstCondition && separation > closest;
}

int ComplexModes::modesWithoutEigenvalue() const {
  const int found = eigenvalues.size();
  return damped ? std::max(0, freeModesInBand - found) : 0;
}

int ComplexModes::withoutDisc() const {
  const double left = completeness ? completeness->left : INFINITY;
  return static_cast<int>(std::ranges::count_if(
      eigenvalues, [=](const auto& e) { return std::isnan(e.radius) && e.s.real() > -left; }));
}

bool ComplexModes::listIsProved() const {
  return completeness && completeness->proved && completeness->missing.empty() &&
         completeness->spurious.empty() && completeness->undecided.empty() && withoutDisc() == 0;
}

int ComplexModes::unstableCount() const {
  return std::ranges::count_if(eigenvalues, [](const auto& e) { return e.unstable; });
}

int ComplexModes::count(Verdict verdict) const {
  return std::ranges::count(eigenvalues, verdict, &Eigenvalue::verdict);
}

Verdict ComplexModes::verdict() const {
  for (const Verdict one : {Verdict::unstable, Verdict::uncertified, Verdict::undecided,
                            Verdict::neutral, Verdict::stable})
    if (count(one) > 0) return one;
  return Verdict::uncertified;
}

int ComplexModes::uncertifiedCount() const {
  return std::ranges::count_if(eigenvalues, [](const auto& e) { return !e.certified; });
}

double ComplexModes::worstBackwardError() const {
  double worst = 0;
  for (const auto& eigenvalue : eigenvalues)
    if (!std::isnan(worst) && !(eigenvalue.backwardError <= worst))
      worst = eigenvalue.backwardError;
  return worst;
}

double ComplexModes::worstErrorEstimate() const {
  double worst = 0;
  for (const auto& eigenvalue : eigenvalues)
    if (!std::isnan(worst) && !(eigenvalue.errorEstimate() <= worst))
      worst = eigenvalue.errorEstimate();
  return worst;
}

const Eigenvalue* ComplexModes::fastestGrowing() const {
  const Eigenvalue* fastest = nullptr;
  for (const auto& eigenvalue : eigenvalues)
    if (!fastest || eigenvalue.s.real() > fastest->s.real()) fastest = &eigenvalue;
  return fastest;
}

const char* text(Verdict verdict) {
  switch (verdict) {
    case Verdict::unstable:
      return "unstable";
    case Verdict::stable:
      return "stable";
    case Verdict::undecided:
      return "undecided";
    case Verdict::neutral:
      return "neutral";
    case Verdict::uncertified:
      return "uncertified";
  }
  return "";
}

void setVerdicts(ComplexModes& point, Symmetry symmetry, const Criteria& criteria) {
  for (auto& e : point.eigenvalues) {
    const double growth = e.s.real(), size = std::abs(e.s), error = e.error,
                 excess = growth - criteria.unstable * size;
    if (!std::isfinite(error)) {
      e.verdict = Verdict::uncertified;
      e.unstable = excess > 0 && growth > noise * size;
      continue;
    }
    const bool isNeutral =
        std::abs(growth) <= error && e.s.imag() > error &&
        (symmetry == Symmetry::conservative || (symmetry == Symmetry::even && isolated(point, e)));
    e.verdict = isNeutral         ? Verdict::neutral
                : excess > error  ? Verdict::unstable
                : excess < -error ? Verdict::stable
                                  : Verdict::undecided;
    e.unstable = e.verdict == Verdict::unstable;
  }
}

std::vector<std::size_t> shapesToStore(const ComplexModes& point, const Criteria& criteria) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < point.eigenvalues.size(); ++i)
    if ((point.eigenvalues[i].unstable || criteria.stableShapes) &&
        point.eigenvalues[i].s.imag() < criteria.shapesBelow)
      order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return point.eigenvalues[a].s.real() > point.eigenvalues[b].s.real();
  });
  order.resize(std::min<std::size_t>(order.size(), criteria.shapes));
  return order;
}

std::string modeName(const std::vector<Component>& components) {
  std::vector<const Component*> bodies;
  for (const auto& one : components)
    if (one.kind == "body" && one.kinetic >= 0.15) bodies.push_back(&one);
  std::ranges::stable_sort(bodies, [](auto* a, auto* b) { return a->kinetic > b->kinetic; });
  if (bodies.size() > 3) bodies.resize(3);
  if (std::ranges::all_of(bodies, [](auto* body) { return body->motion.empty(); })) return {};
  std::string name;
  for (const auto* body : bodies) {
    name += (name.empty() ? "" : " + ") + body->name;
    if (!body->motion.empty()) name += " " + body->motion;
  }
  return name;
}

void storeShapes(ComplexModes& point, Mat trial, const std::vector<std::size_t>& indices,
                 std::vector<linalg::ComplexVector> modes) {
  for (std::size_t k = 0; k < indices.size(); ++k) {
    Shape shape{};
    shape.index = indices[k];
    shape.unknowns = std::move(modes[k]);
    check(MatCreateVecs(trial, nullptr, shape.real.out()));
    check(VecDuplicate(shape.real, shape.imaginary.out()));
    check(MatMult(trial, shape.unknowns.real, shape.real));
    check(MatMult(trial, shape.unknowns.imaginary, shape.imaginary));
    PetscReal a = 0, b = 0;
    check(VecNorm(shape.real, NORM_INFINITY, &a));
    check(VecNorm(shape.imaginary, NORM_INFINITY, &b));
    for (Vec part : {shape.real.get(), shape.imaginary.get(), shape.unknowns.real.get(),
                     shape.unknowns.imaginary.get()})
      check(VecScale(part, 1 / std::max(a, b)));
    point.shapes.push_back(std::move(shape));
  }
}

}  // namespace squeal::pencil
