// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/proof/diagonal_form.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "algebra/linalg/lu.hpp"
#include "algebra/linalg/qr.hpp"
#include "algebra/linalg/unsymmetric.hpp"
#include "eigen/proof/lengths.hpp"
#include "eigen/proof/norm_bound.hpp"

namespace squeal::proof {

using linalg::ComplexMatrix;
using linalg::DenseMatrix;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double smallDeviation = 1e-4;  // that of good eigenvectors is below 10⁻⁹

/// Returns true if P_VV and the couplings are functions of s².
bool even(const KeptProblem& problem) {
  const auto hasNoOddPower = [](const Coupling& coupling) {
    return linalg::isZero(coupling.coefficients[1]) && coupling.error[1] == 0;
  };
  return linalg::isZero(problem.matrices[1]) &&
         std::ranges::all_of(problem.toLeftOut, hasNoOddPower) &&
         std::ranges::all_of(problem.fromLeftOut, hasNoOddPower);
}

}  // namespace

/// L(z) = L0 + z L1, real, in coordinates of V divided by `scale`.
struct DiagonalForm::Pencil {
  DenseMatrix l0, l1;
  std::vector<double> scale;  // [N]

  Pencil(const Coefficients& matrices, double top, bool squared);
};

DiagonalForm::Pencil::Pencil(const Coefficients& matrices, double top, bool squared) {
  const PetscInt order = matrices[0].rows(), size = squared ? order : 2 * order;
  scale.assign(order, 1);
  for (PetscInt i = 0; i < order; ++i) {
    double sum = std::abs(matrices[0](i, i));
    if (!matrices[2].empty()) sum += top * top * std::abs(matrices[2](i, i));
    if (sum > 0) scale[i] = 1 / std::sqrt(sum);
  }
  l0 = DenseMatrix(size, size);
  l1 = DenseMatrix(size, size);
  const auto place = [&](DenseMatrix& to, PetscInt column, const DenseMatrix& from, double factor) {
    for (PetscInt j = 0; j < from.columns(); ++j)
      for (PetscInt i = 0; i < from.rows(); ++i)
        to(i, column + j) = factor * scale[i] * scale[j] * from(i, j);
  };
  // L(z) = P_0 + z top² P_2,   or on (q, p = z q)
  // L(z) = [P_0 0; 0 −1] + z [top P_1, top² P_2; 1 0]
  place(l0, 0, matrices[0], 1);
  place(l1, squared ? 0 : order, matrices[2], top * top);
  if (squared) return;
  place(l1, 0, matrices[1], top);
  for (PetscInt i = 0; i < order; ++i) {
    l0(order + i, order + i) = -1;
    l1(order + i, i) = 1;
  }
}

/// X and Y with the coordinates of V, stored as real numbers: rows of q and of p = z q, and columns
/// of the equations of P.
struct DiagonalForm::Vectors {
  DenseMatrix q, p, left;  // N × size, N × size or empty, size × N
};

DiagonalForm::DiagonalForm(const KeptProblem& problem, double top)
    : top_(top), reach_(problem.reach / top), squared_(even(problem)) {
  if (squared_) reach_ *= reach_;
  ensure(top > 0, "the top of a region is positive");
  ensure(!problem.matrices[0].empty(), "a kept problem has a stiffness");
  const Pencil pencil(problem.matrices, top, squared_);
  const auto vectors = diagonalise(pencil);
  if (regular_) setCouplings(problem, vectors);
}

namespace {

/// Returns approximate eigenvectors of length 1, stored as real numbers. With `perturbed`, those of
/// a matrix within round-off, whose eigenvalues are distinct.
std::pair<DenseMatrix, ConjugatePairs> eigenvectors(DenseMatrix a, bool perturbed) {
  const PetscInt n = a.rows();
  if (perturbed) {
    const double size = 1e-14 * quickBound(a);
    for (std::size_t i = 0; i < a.size(); ++i)
      a.data()[i] += size * std::sin(1 + 2.3 * static_cast<double>(i));
  }
  const auto pairs =
      linalg::standard(std::move(a), linalg::Vectors::right, [](Complex) { return true; });
  ensure(std::ssize(pairs) == n, "a matrix has as many eigenvalues as rows");
  DenseMatrix x(n, n);
  ConjugatePairs members(n, Member::real);
  for (PetscInt j = 0; j < n; ++j) {
    const auto& [value, vector, left] = pairs[j];
    const double size = length(vector);
    for (PetscInt i = 0; i < n; ++i) x(i, j) = vector[i].real() / size;
    if (value.imag() == 0) continue;
    ensure(j + 1 < n && pairs[j + 1].value == std::conj(value), "conjugates follow each other");
    for (PetscInt i = 0; i < n; ++i) x(i, j + 1) = vector[i].imag() / size;
    members[j++] = Member::first;
    members[j] = Member::second;
  }
  return {std::move(x), std::move(members)};
}

}  // namespace

DiagonalForm::Vectors DiagonalForm::diagonalise(const Pencil& pencil) {
  // At z = 1, which is on the boundary or near it, L is regular. L(1)⁻¹ L1 x = ν x
  DenseMatrix atTop = pencil.l0, quotient = pencil.l1;
  linalg::addScaled(atTop, 1, pencil.l1);
  const linalg::Lu<double> lu(atTop);
  if (!(lu.pivotRatio() > 0)) return {};
  lu.solve(quotient);
  Vectors vectors;
  for (const bool perturbed : {false, true}) {
    auto [stored, members] = eigenvectors(quotient, perturbed);
    pairs_ = std::move(members);
    vectors = measure(pencil, atTop, stored);
    regular_ = deviation(1) < smallDeviation;
    if (regular_) break;
  }
  return vectors;
}

/// Sets ν and the bounds of Δ for eigenvectors X.
DiagonalForm::Vectors DiagonalForm::measure(const Pencil& pencil, const DenseMatrix& atTop,
                                            const DenseMatrix& stored) {
  const PetscInt n = stored.rows(), order = std::ssize(pencil.scale);
  eta0_ = eta1_ = std::numeric_limits<double>::infinity();
  const auto atTopX = linalg::product(atTop, stored), l1X = linalg::product(pencil.l1, stored);
  const linalg::Lu<double> inverse(atTopX);
  if (!(inverse.pivotRatio() > 0)) return {};
  DenseMatrix inverted = linalg::identity(n);
  inverse.solve(inverted);
  // Y L(1) X − 1,   Y L1 X − diag(ν)
  ComplexMatrix unit = complexForm(linalg::product(inverted, atTopX), pairs_),
                slope = complexForm(linalg::product(inverted, l1X), pairs_),
                x = complexColumns(stored, pairs_), y = complexRows(inverted, pairs_);
  const std::array end{y.columns()};
  const auto lengths = rowLengths(y, end);
  std::vector<double> balance(n);  // X and Y of the same lengths
  for (PetscInt j = 0; j < n; ++j) balance[j] = std::sqrt(lengths[j]);
  nu_.resize(n);
  for (PetscInt j = 0; j < n; ++j) {
    nu_[j] = slope(j, j);
    unit(j, j) -= 1.0;
    slope(j, j) = 0;
    for (PetscInt i = 0; i < n; ++i) {
      x(i, j) *= balance[j];
      y(i, j) /= balance[i];
      unit(i, j) *= balance[j] / balance[i];
      slope(i, j) *= balance[j] / balance[i];
    }
  }
  const double roundOff = n * epsilon * quickBound(x) * quickBound(y);
  eta0_ = quickBound(unit) + roundOff * quickBound(atTop);
  eta1_ = quickBound(slope) + roundOff * quickBound(pencil.l1);
  Vectors vectors{DenseMatrix(order, n), DenseMatrix(squared_ ? 0 : order, squared_ ? 0 : n),
                  DenseMatrix(n, order)};
  for (PetscInt j = 0; j < n; ++j)
    for (PetscInt i = 0; i < order; ++i) {
      vectors.q(i, j) = pencil.scale[i] * balance[j] * stored(i, j);
      if (!squared_) vectors.p(i, j) = pencil.scale[i] * balance[j] * stored(order + i, j);
      vectors.left(j, i) = pencil.scale[i] / balance[j] * inverted(j, i);
    }
  normOfX_ = normBound(complexColumns(vectors.q, pairs_));
  normOfY_ = normBound(complexRows(vectors.left, pairs_));
  return vectors;
}

namespace {

/// Returns the coefficients of all parts, those of P_CV one below the other and those of P_VC side
/// by side, and the last row or column of each part.
Coefficients stacked(const std::vector<Coupling>& parts, PetscInt order, bool byRows,
                     std::vector<PetscInt>& ends) {
  Coefficients sum;
  PetscInt size = 0;
  for (const auto& part : parts) {
    PetscInt mine = 0;
    for (const auto& matrix : part.coefficients)
      mine = std::max(mine, byRows ? matrix.rows() : matrix.columns());
    for (int power = 0; power < 3; ++power) {
      const auto& matrix = part.coefficients[power];
      if (matrix.empty()) continue;
      ensure((byRows ? matrix.rows() : matrix.columns()) == mine &&
                 (byRows ? matrix.columns() : matrix.rows()) == order,
             "coefficients of a coupling have one size");
    }
    size += mine;
    ends.push_back(size);
  }
  for (int power = 0; power < 3; ++power)
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const auto& matrix = parts[i].coefficients[power];
      if (matrix.empty()) continue;
      auto& to = sum[power];
      if (to.empty()) to = byRows ? DenseMatrix(size, order) : DenseMatrix(order, size);
      const PetscInt first = i > 0 ? ends[i - 1] : 0;
      for (PetscInt j = 0; j < matrix.columns(); ++j)
        for (PetscInt k = 0; k < matrix.rows(); ++k)
          to(k + (byRows ? first : 0), j + (byRows ? 0 : first)) = matrix(k, j);
    }
  return sum;
}

/// Returns a part of P_CV with at most as many rows as its coefficients together have columns that
/// are not zero: F_k = Q R_k with orthonormal columns of Q, and Q joins X.
Coupling condensed(const Coupling& part) {
  DenseMatrix columns;
  for (const auto& matrix : part.coefficients)
    for (PetscInt j = 0; j < matrix.columns(); ++j)
      if (!linalg::isZero(matrix.columnRange(j, j + 1)))
        columns.append(matrix.columnRange(j, j + 1));
  if (columns.rows() <= columns.columns()) return part;
  const DenseMatrix r = linalg::triangularFactor(std::move(columns));
  Coupling result = part;
  PetscInt next = 0;
  for (auto& matrix : result.coefficients) {
    if (matrix.empty()) continue;
    const DenseMatrix old = std::exchange(matrix, DenseMatrix(r.rows(), matrix.columns()));
    for (PetscInt j = 0; j < old.columns(); ++j)
      if (!linalg::isZero(old.columnRange(j, j + 1)))
        std::ranges::copy(r.column(next++), matrix.column(j).begin());
  }
  return result;
}

/// Returns the parts of P_CV, or with `from` those of P_VC, in a condensed form.
std::vector<Coupling> condensed(const std::vector<Coupling>& parts, bool from) {
  std::vector<Coupling> result;
  for (const auto& part : parts)
    result.push_back(from ? transposed(condensed(transposed(part))) : condensed(part));
  return result;
}

/// Returns the bounds of the remainders of the powers of s / top, with the round-off of products
/// with the coefficients.
std::array<double, 3> errors(const std::vector<Coupling>& parts, double top) {
  std::array<double, 3> result = {};
  for (const auto& part : parts)
    for (int power = 0; power < 3; ++power) {
      const auto& matrix = part.coefficients[power];
      const double roundOff = (matrix.rows() + matrix.columns()) * epsilon *
                              std::sqrt(linalg::squaredLength(matrix.entries()));
      result[power] += std::pow(top, power) * (part.error[power] + roundOff);
    }
  return result;
}

}  // namespace

void DiagonalForm::setCouplings(const KeptProblem& problem, const Vectors& vectors) {
  const PetscInt order = problem.order();
  const auto to = stacked(condensed(problem.toLeftOut, false), order, true, rowEnds_),
             from = stacked(condensed(problem.fromLeftOut, true), order, false, columnEnds_);
  errorTo_ = errors(problem.toLeftOut, top_);
  errorFrom_ = errors(problem.fromLeftOut, top_);
  if (rowEnds_.empty() || columnEnds_.empty()) return;
  // a(z) = F_0 X + z top² F_2 X   or   [F_0, top F_1] X + z [0, top² F_2] X
  a_.assign(2, DenseMatrix(rowEnds_.back(), size()));
  b_.clear();
  for (int power = 0; power < 3; ++power) {
    const double unit = std::pow(top_, power);
    if (!to[power].empty())
      linalg::multiplyAdd(to[power], power > 0 && !squared_ ? vectors.p : vectors.q, a_[power / 2],
                          unit);
    if (squared_ && power == 1) continue;
    auto& b = b_.emplace_back();
    if (from[power].empty()) continue;
    b = complexRows(linalg::product(vectors.left, from[power]), pairs_);
    for (auto& entry : b.entries()) entry *= unit;
  }
  if (linalg::isZero(to[0]) && (squared_ || linalg::isZero(to[1]))) {
    // a(z) = z a_1: b takes the factor z, and a is constant.
    a_.erase(a_.begin());
    b_.insert(b_.begin(), ComplexMatrix());
  }
  while (b_.size() > 1 && b_.back().empty()) b_.pop_back();
  for (const auto& matrix : a_)
    aLengths_.push_back(columnLengths(complexColumns(matrix, pairs_), rowEnds_));
  for (const auto& matrix : b_)
    bLengths_.push_back(matrix.empty() ? std::vector<double>(size())
                                       : rowLengths(matrix, columnEnds_));
}

double DiagonalForm::error(const std::array<double, 3>& byPower, double reach) const {
  const double s = squared_ ? std::sqrt(reach) : reach;
  return byPower[0] + s * (byPower[1] + s * byPower[2]);
}

std::vector<Complex> DiagonalForm::eigenvaluesInPlane() const {
  std::vector<Complex> values;
  for (const auto nu : nu_)
    values.push_back(nu == 0.0 ? Complex(std::numeric_limits<double>::infinity()) : 1.0 - 1.0 / nu);
  return values;
}

std::vector<Complex> DiagonalForm::eigenvalues() const {
  std::vector<Complex> values;
  for (const auto z : eigenvaluesInPlane()) {
    if (!std::isfinite(std::abs(z))) continue;
    const auto s = outOfPlane(z);
    values.push_back(s);
    if (squared_) values.push_back(-s);
  }
  return values;
}

Complex DiagonalForm::outOfPlane(Complex z) const {
  return top_ * (squared_ ? linalg::rootOf(-z) : z);
}

}  // namespace squeal::proof
