// SPDX-License-Identifier: BSD-2-Clause
#include "algebra/linalg/quadratic.hpp"

#include <slepcsys.h>  // first: the next header needs it

#include <slepcblaslapack.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "algebra/linalg/lu.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "algebra/linalg/unsymmetric.hpp"
#include "base/petsc/check.hpp"
#include "base/petsc/log_events.hpp"

namespace squeal::linalg {
namespace {

/// Throws Error if an entry is inf or nan: LAPACK would return eigenvalues nevertheless.
void requireFinite(const DenseMatrix& a) {
  if (!std::ranges::all_of(a.entries(), [](double entry) { return std::isfinite(entry); }))
    throw Error("the reduced eigenproblem has an entry that is not finite");
}

/// Returns true if the inverse may be formed. With this bound, eigenvalues lose at most half of
/// their digits, and the largest ones none.
bool invertible(const Lu<double>& matrix) { return matrix.pivotRatio() > 1e-8; }

/// Replaces the left vectors u of M⁻¹ A, uᴴ M⁻¹ A = μ uᴴ, by the left vectors of (A, M),
///   y = M⁻ᵀ u.
void undoInverse(const Lu<double>& mass, std::vector<DensePair>& pairs) {
  if (pairs.empty()) return;
  const PetscInt m = pairs[0].left.size(), count = pairs.size();
  DenseMatrix parts(m, 2 * count);
  for (PetscInt j = 0; j < count; ++j)
    for (PetscInt i = 0; i < m; ++i) {
      parts(i, 2 * j) = pairs[j].left[i].real();
      parts(i, 2 * j + 1) = pairs[j].left[i].imag();
    }
  mass.solve(parts, true);
  for (PetscInt j = 0; j < count; ++j)
    for (PetscInt i = 0; i < m; ++i) pairs[j].left[i] = {parts(i, 2 * j), parts(i, 2 * j + 1)};
}

/// Returns true if A = sign Aᵀ within round-off: max |A_ij − sign A_ji| ≤ 1e-13 max |A_ij|.
bool hasSymmetry(const DenseMatrix& a, double sign) {
  double size = 0, difference = 0;
  for (PetscInt j = 0; j < a.columns(); ++j)
    for (PetscInt i = 0; i <= j; ++i) {
      size = std::max({size, std::abs(a(i, j)), std::abs(a(j, i))});
      const double here = std::abs(a(i, j) - sign * a(j, i));
      if (!(here <= difference)) difference = here;  // a NaN stays
    }
  return difference <= 1e-13 * size;
}

bool positiveDefinite(DenseMatrix a) {
  PetscBLASInt order = a.rows(), info = 0;
  LAPACKpotrf_("L", &order, a.data(), &order, &info);
  return info == 0;
}

/// The leading matrix M of a quadratic problem and its factors, both borrowed. If possible, M⁻¹ A
/// is formed, since QR takes a fraction of the time of QZ.
struct LeadingMatrix {
  const DenseMatrix& matrix;
  const Lu<double>& factors;
};

/// Returns the wanted eigenvalues of K q = μ M q for symmetric matrices, M positive definite.
std::vector<EigenPair> symmetricPairs(const DenseMatrix& mass, const DenseMatrix& stiffness,
                                      Vectors vectors, const EigenvalueFilter& wanted) {
  DenseMatrix factor = mass, q = stiffness;
  const auto values = symmetricEigen(q, factor);
  std::vector<EigenPair> pairs;
  for (std::size_t j = 0; j < values.size(); ++j) {
    if (!wanted(values[j])) continue;
    const auto column = q.column(j);
    auto& pair = pairs.emplace_back(
        EigenPair{values[j], std::vector<Complex>(column.begin(), column.end()), {}});
    if (vectors == Vectors::both) pair.left = pair.right;
  }
  return pairs;
}

std::vector<DensePair> linearInSquare(const LeadingMatrix& mass, const DenseMatrix& stiffness,
                                      Vectors vectors, const EigenvalueFilter& wanted) {
  // K q = μ M q, μ = −s² Both roots ±s are eigenvalues. One of these roots has Im s ≥ 0, or both if
  // they are real. The double root of μ = 0 is listed once.
  const EigenvalueFilter either = [&](Complex mu) {
    const Complex s = rootOf(mu);
    return wanted(s) || (s.imag() == 0 && wanted(-s));
  };
  const bool symmetric =
      hasSymmetry(mass.matrix, 1) && hasSymmetry(stiffness, 1) && positiveDefinite(mass.matrix);
  const bool inverted = !symmetric && invertible(mass.factors);
  DenseMatrix quotient = stiffness;
  if (inverted) mass.factors.solve(quotient);
  const auto solved = symmetric  ? symmetricPairs(mass.matrix, stiffness, vectors, either)
                      : inverted ? standard(std::move(quotient), vectors, either)
                                 : generalized(stiffness, mass.matrix, vectors, either);
  std::vector<DensePair> pairs;
  for (const auto& [mu, q, left] : solved) {
    const Complex s = rootOf(mu);
    if (wanted(s)) pairs.push_back({s, q, left});
    if (s.imag() == 0 && s != 0.0 && wanted(-s)) pairs.push_back({-s, q, left});
  }
  if (vectors == Vectors::both && inverted) undoInverse(mass.factors, pairs);
  return pairs;
}

/// Returns [I 0; 0 M].
DenseMatrix padded(const DenseMatrix& mass) {
  const PetscInt m = mass.rows();
  DenseMatrix b(2 * m, 2 * m);
  for (PetscInt j = 0; j < m; ++j) {
    b(j, j) = 1;
    for (PetscInt i = 0; i < m; ++i) b(m + i, m + j) = mass(i, j);
  }
  return b;
}

/// Returns the Frobenius norm.
double norm(const DenseMatrix& x) { return std::sqrt(squaredLength(x.entries())); }

std::vector<DensePair> companion(const LeadingMatrix& mass, const DenseMatrix& damping,
                                 const DenseMatrix& stiffness, Vectors vectors,
                                 const EigenvalueFilter& wanted) {
  const PetscInt m = stiffness.rows();
  // s = unit ŝ (Fan, Lin and Van Dooren 2004); a zero matrix does not determine the unit
  const double ratio = norm(stiffness) / norm(mass.matrix),
               unit = ratio > 0 && std::isfinite(ratio) ? std::sqrt(ratio) : 1;
  //   [0 I; −K̂ −Ẑ] (q, ŝq) = ŝ [I 0; 0 M] (q, ŝq),   K̂ = K / unit², Ẑ = Z / unit
  DenseMatrix lower = stiffness;
  lower.append(damping);
  if (invertible(mass.factors)) mass.factors.solve(lower);
  DenseMatrix a(2 * m, 2 * m);
  for (PetscInt j = 0; j < m; ++j) {
    a(j, m + j) = 1;
    for (PetscInt i = 0; i < m; ++i) {
      a(m + i, j) = -lower(i, j) / (unit * unit);
      a(m + i, m + j) = -lower(i, m + j) / unit;
    }
  }
  std::vector<DensePair> pairs;
  const EigenvalueFilter upper = [&](Complex value) {
    return value.imag() >= 0 && wanted(unit * value);
  };
  for (const auto& [value, right, left] :
       invertible(mass.factors) ? standard(a, vectors, upper)
                                : generalized(a, padded(mass.matrix), vectors, upper)) {
    const auto half = right.begin() + (std::abs(value) > 1 ? m : 0);  // the larger of q and ŝq
    // The left vector of the companion form is (u, y) with u = −K̂ᵀ y / conj ŝ and yᴴ P = 0.
    pairs.push_back(
        {unit * value, {half, half + m}, {left.begin() + (left.empty() ? 0 : m), left.end()}});
  }
  if (vectors == Vectors::both && invertible(mass.factors)) undoInverse(mass.factors, pairs);
  return pairs;
}

/// Scales a vector to the 2-norm 1, with its largest entry real.
void normalise(std::vector<Complex>& vector) {
  double sum = 0;
  std::size_t largest = 0;
  for (std::size_t i = 0; i < vector.size(); ++i) {
    sum += std::norm(vector[i]);
    if (std::norm(vector[i]) > std::norm(vector[largest])) largest = i;
  }
  if (sum == 0) return;
  const Complex entry = vector[largest],
                factor =
                    (entry.imag() == 0 ? 1 : std::conj(entry) / std::abs(entry)) / std::sqrt(sum);
  for (auto& value : vector) value *= factor;
  vector[largest] = vector[largest].real();
}

/// Returns the conjugate of s = 1/t for a root t of the reversed polynomial with Im t ≥ 0. Its
/// imaginary part is not negative either.
Complex reflected(Complex t) { return 1.0 / std::conj(t); }

}  // namespace

Complex rootOf(Complex mu) {
  const Complex s =
      mu.imag() == 0 && mu.real() >= 0 ? Complex(0, std::sqrt(mu.real())) : std::sqrt(-mu);
  return s.imag() < 0 ? -s : s;
}

bool conservative(const DenseProblem& problem) {
  return hasSymmetry(problem.stiffness, 1) && hasSymmetry(problem.mass, 1) &&
         hasSymmetry(problem.damping, -1) && positiveDefinite(problem.stiffness) &&
         positiveDefinite(problem.mass);
}

std::vector<DensePair> solveQuadratic(const DenseProblem& problem, Vectors vectors,
                                      const EigenvalueFilter& wanted) {
  // If K is better conditioned, as in a basis that is orthonormal in energy, the roots of the
  // reversed polynomial are computed:
  //   t² K + t Z + M,   t = 1/s
  constexpr double beyondDoubt = 0.01;
  if (problem.order() == 0) return {};
  const LoggedWork work(Work::denseEigenvalues);
  for (const auto* matrix : {&problem.mass, &problem.damping, &problem.stiffness})
    requireFinite(*matrix);
  const Lu<double> ofStiffness(problem.stiffness);
  std::optional<Lu<double>> ofMass;
  if (ofStiffness.pivotRatio() < beyondDoubt) ofMass.emplace(problem.mass);
  const bool reversed =
      !ofMass || (invertible(ofStiffness) && ofStiffness.pivotRatio() > ofMass->pivotRatio());
  const LeadingMatrix leading = reversed ? LeadingMatrix{problem.stiffness, ofStiffness}
                                         : LeadingMatrix{problem.mass, *ofMass};
  const auto& last = reversed ? problem.mass : problem.stiffness;
  const EigenvalueFilter root = [&](Complex t) {
    if (reversed && t == 0.0) return false;  // s is infinite: a motion without mass
    return !wanted || wanted(reversed ? reflected(t) : t);
  };
  auto pairs = problem.damping.empty() ? linearInSquare(leading, last, vectors, root)
                                       : companion(leading, problem.damping, last, vectors, root);
  for (auto& pair : pairs) {
    if (!reversed) break;
    pair = {reflected(pair.s), conjugated(std::move(pair.q)), conjugated(std::move(pair.left))};
  }
  // Growth rates are exactly zero here. With round-off in them, eigenvalues that a small friction
  // makes unstable would be reported as unstable at friction 0.
  if (!problem.damping.empty() && conservative(problem))
    for (auto& pair : pairs)
      if (std::abs(pair.s.real()) <= 1e-6 * std::abs(pair.s)) pair.s = {0, pair.s.imag()};
  for (auto& pair : pairs) {
    normalise(pair.q);
    normalise(pair.left);
  }
  std::sort(pairs.begin(), pairs.end(), [](const DensePair& a, const DensePair& b) {
    return a.s.imag() != b.s.imag() ? a.s.imag() < b.s.imag() : a.s.real() < b.s.real();
  });
  return pairs;
}

namespace {

/// Returns the right or left vectors of the pairs as real parts, then imaginary parts, m × 2 pairs.
DenseMatrix partsOf(const std::vector<DensePair>& pairs, std::vector<Complex> DensePair::*vector) {
  const PetscInt count = pairs.size(), m = count > 0 ? (pairs[0].*vector).size() : 0;
  DenseMatrix parts(m, 2 * count);
  for (PetscInt j = 0; j < count; ++j) {
    ensure(std::ssize(pairs[j].*vector) == m, "the vectors of pairs have one length");
    for (PetscInt i = 0; i < m; ++i) {
      parts(i, j) = (pairs[j].*vector)[i].real();
      parts(i, count + j) = (pairs[j].*vector)[i].imag();
    }
  }
  return parts;
}

ComplexMatrix fromParts(const DenseMatrix& parts) {
  const PetscInt count = parts.columns() / 2;
  ComplexMatrix result(parts.rows(), count);
  for (PetscInt j = 0; j < count; ++j)
    for (PetscInt i = 0; i < parts.rows(); ++i) result(i, j) = {parts(i, j), parts(i, count + j)};
  return result;
}

}  // namespace

ComplexMatrix timesVectors(const DenseView& a, const std::vector<DensePair>& pairs) {
  const DenseMatrix parts = partsOf(pairs, &DensePair::q);
  if (a.empty() || parts.empty()) return ComplexMatrix(parts.rows(), parts.columns() / 2);
  return fromParts(product(a, parts));
}

ComplexMatrix transposedTimesLeft(const DenseView& a, const std::vector<DensePair>& pairs) {
  const DenseMatrix parts = partsOf(pairs, &DensePair::left);
  if (a.empty() || parts.empty()) return ComplexMatrix(parts.rows(), parts.columns() / 2);
  return fromParts(transposedProduct(a, parts));
}

}  // namespace squeal::linalg
