// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/completeness/damped_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/linalg/rows.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/system/error.hpp"
#include "eigen/completeness/kept_span.hpp"
#include "eigen/proof/norm_bound.hpp"

namespace squeal::completeness {
namespace {

using linalg::DenseMatrix;
using linalg::DenseView;

constexpr double roundOff = 1e-15;  // of the entries of products of matrices, relative

/// What P_CV and P_VC may leave out, in the energy: it adds to the ratio after multiplication with
/// the norm of P_VV⁻¹ P_VC or P_CV P_VV⁻¹ by single eigenvectors, of the order of 50 and 10.
constexpr double smallTo = 3e-6, smallFrom = 3e-5;

double norm(const DenseView& a) { return proof::quickBound(a); }

/// Returns the columns of a matrix that have entries.
std::vector<unsigned char> usedColumns(const DenseMatrix& a) {
  std::vector<unsigned char> used(a.columns());
  for (PetscInt j = 0; j < a.columns(); ++j) used[j] = !linalg::isZero(a.columnRange(j, j + 1));
  return used;
}

/// Returns the rows of J that Φ or B use.
std::vector<PetscInt> usedJumps(const pencil::PointFactors& friction) {
  const auto slip = usedColumns(friction.slip), response = usedColumns(friction.response);
  std::vector<PetscInt> rows;
  for (std::size_t i = 0; i < slip.size(); ++i)
    if (slip[i] || response[i]) rows.push_back(static_cast<PetscInt>(i));
  return rows;
}

/// Returns [A, B; Bᵀ, D] for square blocks of one size.
DenseMatrix blocks(const DenseMatrix& a, const DenseMatrix& b, const DenseMatrix& d) {
  const PetscInt size = a.rows();
  DenseMatrix whole(2 * size, 2 * size);
  for (PetscInt j = 0; j < size; ++j)
    for (PetscInt i = 0; i < size; ++i) {
      whole(i, j) = a(i, j);
      whole(i, size + j) = whole(size + j, i) = b(i, j);
      whole(size + i, size + j) = d(i, j);
    }
  return whole;
}

/// Bounds of the friction of a point, with the norms of its factors.
struct Friction {
  std::vector<DenseMatrix> normal;           // [normal] N_XC N_XCᵀ, without c
  std::vector<double> normalOnV, normalOnC;  // [normal] norms, with c
  DenseMatrix convected;                     // D_C D_Cᵀ in the used rows
  double convectedOnV = 0, convectedOnC = 0;
  double slip = 0, response = 0;      // ‖Φ‖, ‖B‖
  double jumpsOnV = 0, jumpsOnC = 0;  // ‖J‖
};

/// The blocks of a point, in coordinates of V W.
class DampedPart {
 public:
  DampedPart(const DampedSet& set, DampedPoint& point, double top)
      : set_(set), point_(point), top_(top), reach_(1.3 * top), rows_(usedJumps(point.friction)) {
    const DenseMatrix jumps = linalg::rowsOf(rows_, set.jumps);
    const KeptSpan span(set.modes, set.energy, jumps);
    w_ = linalg::product(span.turn(), span.vectorsWith(point.vectors, point.forces));
    friction_.jumpsOnC = set.jumpsOnC + span.forcesLeft();
    first_ = set.modes.first;
    jumps_ = linalg::product(jumps, w_);
    slip_ = columnsOf(point.friction.slip);
    response_ = linalg::principalPart(rows_, point.friction.response);
    matrices_.push_back(linalg::congruent(set.mass, w_));
    for (const auto& body : set.bodies) matrices_.push_back(linalg::congruent(body.onV, w_));
    setFriction();
    setLeftProducts();
  }
  PointBounds bounds();

 private:
  DenseMatrix columnsOf(const DenseMatrix& a) const {
    return linalg::transposed(linalg::rowsOf(rows_, linalg::transposed(a)));
  }
  void setFriction();
  void setLeftProducts();
  void requireTerms(const proof::Coefficients& matrices) const;
  DenseMatrix leftProduct(std::size_t i, std::size_t j) const;
  proof::Coupling toLeftOut() const;
  DenseMatrix massNormal(const DampedSet::Normal& normal, const DenseMatrix& onV) const;
  proof::Coupling fromLeftOut() const;
  std::pair<DenseMatrix, double> otherParts(const DenseMatrix& slip) const;
  void addErrors(PointBounds& bounds) const;

  const DampedSet& set_;
  DampedPoint& point_;
  double top_, reach_;
  std::vector<PetscInt> rows_;
  DenseMatrix w_, jumps_, slip_, response_;
  PetscInt first_;                              // number of constraint modes
  std::vector<DenseMatrix> matrices_;           // M0 and those of the bodies
  std::vector<std::vector<DenseMatrix>> left_;  // [i][j ≤ i] of matrices_; empty if not used
  std::vector<DenseMatrix> normals_;            // [normal] N_X on V W
  DenseMatrix convected_;                       // D on V W
  Friction friction_;
};

void DampedPart::setFriction() {
  auto& f = friction_;
  f.slip = norm(slip_);
  f.response = norm(response_);
  f.jumpsOnV = norm(jumps_);
  for (std::size_t i = 0; i < set_.normals.size(); ++i) {
    const auto& [power, onV, flexibility, ofMass] = set_.normals[i];
    const double factor = point_.normalFactors[i];
    normals_.push_back(linalg::product(onV, w_));
    f.normalOnV.push_back(std::abs(factor) * norm(normals_.back()));
    f.normal.push_back(leftOf(flexibility, normals_.back(), first_));
    f.normalOnC.push_back(std::abs(factor) * std::sqrt(norm(f.normal.back())));
  }
  if (set_.convected.empty()) return;
  convected_ = linalg::product(linalg::rowsOf(rows_, set_.convected), w_);
  f.convected = leftOf(linalg::principalPart(rows_, set_.convectedFlexibility), convected_, first_);
  f.convectedOnV = norm(convected_);
  f.convectedOnC = std::sqrt(norm(f.convected));
}

/// Throws Error unless the factors and the matrices of the bodies add up to the problem.
void DampedPart::requireTerms(const proof::Coefficients& matrices) const {
  constexpr double apart = 1e-9;
  proof::Coefficients rest = matrices;
  for (auto& matrix : rest)
    if (matrix.empty()) matrix = DenseMatrix(w_.columns(), w_.columns());
  std::array<double, 3> sizes = {};
  const auto subtract = [&](int power, double factor, const DenseMatrix& matrix) {
    linalg::addScaled(rest[power], -factor, matrix);
    sizes[power] += std::abs(factor) * std::sqrt(linalg::squaredLength(matrix.entries()));
  };
  subtract(0, 1, linalg::identity(w_.columns()));
  subtract(2, 1, matrices_[0]);
  for (std::size_t i = 0; i < set_.bodies.size(); ++i)
    subtract(set_.bodies[i].power, point_.bodyFactors[i], matrices_[i + 1]);
  if (!rows_.empty()) {
    const DenseMatrix slip = linalg::product(slip_, jumps_),
                      left = linalg::transposedProduct(jumps_, response_);
    for (std::size_t i = 0; i < normals_.size(); ++i)
      subtract(set_.normals[i].power, point_.normalFactors[i],
               linalg::transposedProduct(slip, normals_[i]));
    subtract(1, 1, linalg::product(left, jumps_));
    if (!convected_.empty()) subtract(0, -point_.speed, linalg::product(left, convected_));
  }
  double total = 0;
  for (int power = 0; power < 3; ++power) total += std::pow(top_, power) * sizes[power];
  for (int power = 0; power < 3; ++power)
    if (std::pow(top_, power) * std::sqrt(linalg::squaredLength(rest[power].entries())) >
        apart * total)
      throw Error("the factors of friction do not give the terms of the problem");
}

/// Computes X_CVᵀ X'_CV of the matrices that the point has.
void DampedPart::setLeftProducts() {
  const PetscInt size = w_.columns(), modes = set_.modes.count;
  const auto isUsed = [&](std::size_t i) { return i == 0 || point_.bodyFactors[i - 1] != 0; };
  for (std::size_t i = 0; i < matrices_.size(); ++i) {
    auto& row = left_.emplace_back(i + 1);
    for (std::size_t j = 0; j <= i; ++j) {
      if (set_.products[i][j].empty() || !isUsed(i) || !isUsed(j)) continue;
      row[j] = linalg::congruent(set_.products[i][j], w_);
      linalg::addScaled(row[j], -1,
                        linalg::transposedProduct(linalg::rowRange(matrices_[i], first_, size),
                                                  linalg::rowRange(matrices_[j], first_, size)));
      // M0 does not couple the free modes with C.
      for (PetscInt k = first_; k < first_ + modes; ++k)
        for (PetscInt l = 0; l < size; ++l) {
          if (i == 0) row[j](k, l) = 0;
          if (j == 0) row[j](l, k) = 0;
        }
    }
  }
}

/// Returns X_CVᵀ X'_CV of two matrices of the bodies, 0: M0.
DenseMatrix DampedPart::leftProduct(std::size_t i, std::size_t j) const {
  return i >= j ? left_[i][j] : linalg::transposed(left_[j][i]);
}

/// Returns a majorant of s Σ c X_CV + s² M_CV, whose products are known. The blocks of matrices
/// without s become the remainder.
proof::Coupling DampedPart::toLeftOut() const {
  const PetscInt size = w_.columns();
  const DenseMatrix mass = leftProduct(0, 0);
  DenseMatrix linear(size, size), mixed(size, size);
  double remainder = 0;
  bool hasLinear = false;
  for (std::size_t i = 0; i < set_.bodies.size(); ++i) {
    const double factor = point_.bodyFactors[i];
    if (factor == 0) continue;
    if (set_.bodies[i].power == 0) {
      remainder += std::abs(factor) * std::sqrt(norm(leftProduct(i + 1, i + 1)));
      continue;
    }
    hasLinear = true;
    linalg::addScaled(mixed, factor, leftProduct(i + 1, 0));
    for (std::size_t j = 0; j < set_.bodies.size(); ++j)
      if (const double other = point_.bodyFactors[j]; other != 0 && set_.bodies[j].power == 1)
        linalg::addScaled(linear, factor * other, leftProduct(i + 1, j + 1));
  }
  proof::Coupling coupling;
  if (!hasLinear) {
    coupling = proof::couplingFromGram(linalg::symmetricPart(mass), std::array{2}, top_, smallTo);
  } else {
    const DenseMatrix gram = blocks(linear, mixed, mass);
    coupling =
        proof::couplingFromGram(linalg::symmetricPart(gram), std::array{1, 2}, top_, smallTo);
  }
  coupling.error[0] += remainder;
  coupling.error[2] += set_.modes.error;
  return coupling;
}

/// Returns N_XC M_CV.
DenseMatrix DampedPart::massNormal(const DampedSet::Normal& normal, const DenseMatrix& onV) const {
  const PetscInt size = w_.columns();
  DenseMatrix result = linalg::product(normal.mass, w_);
  linalg::addScaled(
      result, -1,
      linalg::product(onV.columnRange(first_, size), linalg::rowRange(matrices_[0], first_, size)));
  for (PetscInt j = first_; j < first_ + set_.modes.count; ++j)
    for (double& entry : result.column(j)) entry = 0;
  return result;
}

/// Returns a majorant of P_VC for |s| ≤ reach. The products of its main part
///   (Φ J)ᵀ_V N_0C + s² (M_VC + (Φ J)ᵀ_V N_2C)
/// are known. The other terms are small; their Gram matrices are added, weighted by their norms.
proof::Coupling DampedPart::fromLeftOut() const {
  const PetscInt size = w_.columns();
  const auto &stiff = set_.normals[0], &heavy = set_.normals[1];
  const DenseMatrix slip = linalg::product(slip_, jumps_);
  DenseMatrix inner = set_.normalProduct;  // N_0C N_2Cᵀ
  linalg::addScaled(inner, -1,
                    linalg::product(normals_[0].columnRange(first_, size),
                                    linalg::transposed(normals_[1].columnRange(first_, size))));
  DenseMatrix mass = leftProduct(0, 0);
  const auto mixed = linalg::transposedProduct(slip, massNormal(heavy, normals_[1]));
  linalg::addScaled(mass, 1, mixed);
  linalg::addScaled(mass, 1, linalg::transposed(mixed));
  linalg::addScaled(mass, 1, linalg::congruent(friction_.normal[1], slip));
  DenseMatrix both = massNormal(stiff, normals_[0]);  // N_0C (M_CV + N_2Cᵀ Φ J)
  linalg::multiplyAdd(inner, slip, both);
  both = linalg::transposedProduct(slip, both);
  DenseMatrix gram = blocks(linalg::congruent(friction_.normal[0], slip), both, mass);
  const auto [rest, size2] = otherParts(slip);
  if (size2 > 0) {
    // (A + B)(A + B)ᴴ ≤ (1 + t) A Aᴴ + (1 + 1/t) B Bᴴ
    constexpr double least = 0.02;
    const double t = std::clamp(size2, least, 1.0);
    for (double& entry : gram.entries()) entry *= 1 + t;
    for (PetscInt j = 0; j < size; ++j)
      for (PetscInt i = 0; i < size; ++i) gram(i, j) += (1 + 1 / t) * rest(i, j);
  }
  auto coupling = proof::transposed(
      proof::couplingFromGram(linalg::symmetricPart(gram), std::array{0, 2}, top_, smallFrom));
  coupling.error[2] += set_.modes.error;
  return coupling;
}

/// Returns B Bᵀ ≥ X Xᵀ for the sum X of all other parts of P_VC at any |s| ≤ reach, and a bound of
/// ‖B‖.
std::pair<DenseMatrix, double> DampedPart::otherParts(const DenseMatrix& slip) const {
  std::vector<DenseMatrix> squares;
  std::vector<double> sizes;
  double total = 0;
  const auto add = [&](DenseMatrix square, double factor) {
    const double size = std::abs(factor) * std::sqrt(norm(square));
    if (!(size > 0)) return;
    for (double& entry : square.entries()) entry *= factor * factor;
    squares.push_back(std::move(square));
    sizes.push_back(size);
    total += size;
  };
  for (std::size_t i = 0; i < set_.bodies.size(); ++i)
    if (point_.bodyFactors[i] != 0)
      add(leftProduct(i + 1, i + 1),
          point_.bodyFactors[i] * std::pow(reach_, set_.bodies[i].power));
  for (std::size_t i = 2; i < set_.normals.size(); ++i)
    add(linalg::congruent(friction_.normal[i], slip),
        point_.normalFactors[i] * std::pow(reach_, set_.normals[i].power));
  if (!friction_.convected.empty())
    add(linalg::congruent(friction_.convected,
                          linalg::product(linalg::transposed(response_), jumps_)),
        point_.speed);
  // (Σ X_i)(Σ X_i)ᵀ ≤ Σ w_i X_i X_iᵀ if Σ 1/w_i = 1
  DenseMatrix sum;
  for (std::size_t i = 0; i < squares.size(); ++i)
    linalg::addScaled(sum, total / sizes[i], squares[i]);
  return {std::move(sum), total};
}

/// Adds what the responses to the jumps leave out, and the bounds on C.
void DampedPart::addErrors(PointBounds& bounds) const {
  auto& [kept, leftOut] = bounds;
  auto &to = kept.toLeftOut.front().error, &from = kept.fromLeftOut.front().error;
  const auto& f = friction_;
  const double slip = f.jumpsOnC * f.slip, turned = f.jumpsOnC * f.response,
               speed = std::abs(point_.speed);
  for (std::size_t i = 0; i < set_.normals.size(); ++i) {
    to[set_.normals[i].power] += slip * f.normalOnV[i];
    leftOut.rest[set_.normals[i].power] += slip * f.normalOnC[i];
  }
  to[0] += speed * turned * f.convectedOnV;
  to[1] += turned * f.jumpsOnV;
  from[1] += turned * f.jumpsOnV;
  leftOut.rest[0] += speed * turned * f.convectedOnC;
  leftOut.rest[1] += turned * f.jumpsOnC;
  leftOut.mass = 1 / set_.modes.theta + set_.modes.error;
  for (std::size_t i = 0; i < set_.bodies.size(); ++i) {
    const auto& body = set_.bodies[i];
    const double size = std::abs(point_.bodyFactors[i]);
    if (body.power == 0) {
      leftOut.rest[0] += size * body.bound;
    } else if (body.skew) {
      leftOut.gyroscopic += size * body.bound;
    } else {
      leftOut.damping += size * body.bound;
      leftOut.rest[1] += size * body.below;
    }
  }
}

PointBounds DampedPart::bounds() {
  PointBounds result;
  auto& kept = result.kept;
  auto& problem = point_.problem;
  for (const int power : {0, 1, 2}) {
    auto matrix = std::exchange(problem.ofPower(power), DenseMatrix());
    if (!matrix.empty()) kept.matrices[power] = linalg::congruent(matrix, w_);
  }
  requireTerms(kept.matrices);
  kept.toLeftOut = {toLeftOut()};
  kept.fromLeftOut = {fromLeftOut()};
  kept.reach = reach_;
  addErrors(result);
  return result;
}

}  // namespace

PointBounds dampedBounds(const DampedSet& set, DampedPoint point, double top) {
  return DampedPart(set, point, top).bounds();
}

}  // namespace squeal::completeness
