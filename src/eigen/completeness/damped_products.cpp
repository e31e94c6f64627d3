// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/completeness/damped_products.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/linalg/rows.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/system/error.hpp"
#include "base/system/mpi.hpp"
#include "eigen/completeness/basis_products.hpp"
#include "eigen/completeness/list_judgement.hpp"
#include "eigen/proof/count.hpp"
#include "eigen/proof/matrix_bounds.hpp"
#include "eigen/reduction/factored_friction.hpp"

namespace squeal::completeness {

using linalg::DenseMatrix;

namespace {

/// Returns true for a term of the bodies other than K0 and M0.
bool isOfBodies(const pencil::Term& term) {
  return !term.isAssociated() && !term.containsFriction();
}

/// Returns the largest |coefficient| of a term at the points.
double largestFactor(const pencil::Term& term, const std::vector<DampedList>& points) {
  double largest = 0;
  for (const auto& point : points)
    largest = std::max(largest, std::abs(term.coefficient(point.problem->at)));
  return largest;
}

/// Collective. Returns true if A = −Aᵀ, false if A = Aᵀ, both within round-off.
bool isSkew(Mat matrix) {
  constexpr double roundOff = 1e-9;
  PetscReal size = 0, sums[2] = {};
  check(MatNorm(matrix, NORM_FROBENIUS, &size));
  for (const int k : {0, 1}) {
    OwnedMat sum;
    check(MatTranspose(matrix, MAT_INITIAL_MATRIX, sum.out()));
    check(MatAXPY(sum, k == 0 ? -1 : 1, matrix, DIFFERENT_NONZERO_PATTERN));
    check(MatNorm(sum, NORM_FROBENIUS, &sums[k]));
  }
  if (std::min(sums[0], sums[1]) > roundOff * size)
    throw Error("a matrix of the bodies is neither symmetric nor antisymmetric");
  return sums[1] < sums[0];
}

/// Collective. Returns the rows and columns of the interior unknowns.
OwnedMat interiorOf(Mat matrix, std::vector<PetscInt> interior) {
  OwnedMat part;
  PetscInt first = 0;
  check(MatGetOwnershipRange(matrix, &first, nullptr));
  for (PetscInt& row : interior) row += first;
  OwnedIS set;
  check(ISCreateGeneral(commOf(matrix), interior.size(), interior.data(), PETSC_COPY_VALUES,
                        set.out()));
  check(MatCreateSubMatrix(matrix, set, set, MAT_INITIAL_MATRIX, part.out()));
  return part;
}

/// Collective. Returns Jᵀ − K0 V c, which J agrees with on C, with V c ≈ K0⁻¹ Jᵀ. The columns of
/// `transposed` are those of Jᵀ, and `onV` is J V. `point` belongs to the sweep.
linalg::Block remainderOf(const reduction::ReducedProblem& reduced,
                          const reduction::PointProblem& point, const linalg::Block& transposed,
                          const DenseMatrix& onV) {
  const auto& basis = reduced.basis();
  const PetscInt size = basis.size(), boundary = basis.boundarySize();
  DenseMatrix energy = reduced.projectAssociated(point.set).stiffness;
  std::vector<PetscInt> interior;
  for (PetscInt i = energy.rows() - (size - boundary); i < energy.rows(); ++i)
    interior.push_back(i);
  const DenseMatrix turn = linalg::inverseTransposed(
                        linalg::choleskyFactor(linalg::principalPart(interior, energy))),
                    turned = linalg::product(onV.columnRange(boundary, size), turn),
                    c = linalg::product(turn, linalg::transposed(turned));
  linalg::Block rest = transposed, stiffness(basis.localRows());
  linalg::appendProduct(basis.stiffness(),
                        linalg::product(basis.columns().columnRange(boundary, size), c), stiffness);
  linalg::addScaled(rest, -1, stiffness);
  return rest;
}

/// The rows of J and D that the friction needs.
struct Jumps {
  std::vector<PetscInt> rows;           ///< of the factors, ascending
  linalg::Block transposed, convected;  ///< Jᵀ and Dᵀ in these columns
};

/// Collective. Returns the rows in which J is not zero. It is zero along normals that are
/// coordinate axes.
Jumps jumpsOf(const pencil::JumpFactors& factors) {
  constexpr double roundOff = 1e-13;
  const auto choose = [](const linalg::Block& all, const std::vector<PetscInt>& rows) {
    linalg::Block some(all.rows());
    for (const PetscInt row : rows) some.append(all.column(row));
    return some;
  };
  Jumps jumps;
  const linalg::Block all = columnsOf(factors.jumps);
  std::vector<double> squares;
  for (PetscInt j = 0; j < all.columns(); ++j)
    squares.push_back(linalg::squaredLength(all.column(j)));
  mpi::sumAlike(commOf(factors.jumps), squares);
  const double largest = squares.empty() ? 0 : *std::ranges::max_element(squares);
  for (PetscInt j = 0; j < all.columns(); ++j)
    if (squares[j] > roundOff * roundOff * largest) jumps.rows.push_back(j);
  jumps.transposed = choose(all, jumps.rows);
  if (factors.convected) jumps.convected = choose(columnsOf(factors.convected), jumps.rows);
  return jumps;
}

/// Collective. Returns Fᵀ V.
DenseMatrix onBasis(const reduction::ReducedProblem& reduced, const linalg::Block& f) {
  return linalg::transposedProduct(reduced.basis().comm(), f, reduced.basis().columns());
}

}  // namespace

CommonProducts::CommonProducts(reduction::ReducedProblem& reduced, const DampedSweep& sweep,
                               const std::vector<DampedList>& points, const KnownModes& known,
                               const pencil::Pencil& associated) {
  all_.modes = known;
  const auto& factors = sweep.factors;
  const Jumps jumps = jumpsOf(factors);
  jumpRows_ = jumps.rows;
  addJumps(reduced, *points.front().problem, jumps.transposed);
  if (factors.convected) {
    all_.convected = onBasis(reduced, jumps.convected);
    all_.convectedFlexibility = reduced.flexibility(jumps.convected);
  }
  const OwnedMat mass = associated.assembled(2, {});
  addNormals(reduced, factors, mass);
  for (const auto& term : points.front().problem->pencil.terms())
    if (isOfBodies(term) && largestFactor(term, points) > 0) bodies_.push_back(&term);
  addBodies(sweep, points);
  addProducts(reduced, sweep.modes.lambda, mass);
}

/// Collective. Adds the responses to the jumps to the basis.
void CommonProducts::addJumps(reduction::ReducedProblem& reduced,
                              const reduction::PointProblem& point,
                              const linalg::Block& transposed) {
  constexpr PetscInt combinations = 16;
  constexpr double accurate = 1e-10;  // of ‖J‖
  all_.jumps = DenseMatrix(0, reduced.basisSize());
  if (transposed.columns() == 0) return;
  const DenseMatrix signs = randomSigns(transposed.columns(), combinations);
  const linalg::Block combined = linalg::product(transposed, signs);
  const DenseMatrix whole = reduced.flexibility(combined);
  reduced.addResponses(transposed);
  for (const bool isLast : {false, true}) {
    all_.jumps = onBasis(reduced, transposed);
    // An estimate of ‖J x‖ for x in C with energy 1: four times its mean.
    const DenseMatrix left = reduced.flexibility(
        remainderOf(reduced, point, combined, linalg::transposedProduct(signs, all_.jumps)));
    double sum = 0, all = 0;
    for (PetscInt j = 0; j < combinations; ++j) sum += left(j, j), all += whole(j, j);
    all_.jumpsOnC = 4 * std::sqrt(std::max(sum, 0.0) / combinations);
    if (isLast || sum <= accurate * accurate * all) return;
    // The basis omits what is nearly linearly dependent; the rest of the responses has less of it.
    reduced.addResponses(remainderOf(reduced, point, transposed, all_.jumps));
  }
}

/// Collective. Adds N_X V, N_X K0⁻¹ N_Xᵀ, and N_X K0⁻¹ M0 V for stiffness and mass.
void CommonProducts::addNormals(reduction::ReducedProblem& reduced,
                                const pencil::JumpFactors& factors, Mat mass) {
  const auto& basis = reduced.basis();
  linalg::Block first;  // N_0ᵀ
  for (const auto& term : factors.normal) {
    const linalg::Block forces = columnsOf(term.matrix), responses = reduced.responses(forces);
    DampedSet::Normal normal{term.power,
                             reduction::productWithBasis(basis, term.matrix),
                             linalg::transposedProduct(basis.comm(), forces, responses),
                             {}};
    if (term.isAssociated()) {
      linalg::Block inertia(basis.localRows());
      linalg::appendProduct(mass, responses, inertia);
      normal.mass = linalg::transposedProduct(basis.comm(), inertia, basis.columns());
    }
    if (all_.normals.empty())
      first = forces;
    else if (all_.normals.size() == 1)
      all_.normalProduct = linalg::transposedProduct(basis.comm(), first, responses);
    all_.normals.push_back(std::move(normal));
  }
}

/// Collective. Bounds the matrices of the bodies on C.
void CommonProducts::addBodies(const DampedSweep& sweep, const std::vector<DampedList>& points) {
  double top = 0;
  for (const auto& point : points) top = std::max(top, (1 + above) * point.list->bandTop);
  std::vector<OwnedMat> interior;
  std::vector<Mat> matrices;
  for (const auto* term : bodies_) {
    interior.push_back(all_.modes.first == 0 ? term->matrix.share()
                                             : interiorOf(term->matrix, sweep.interior));
    matrices.push_back(interior.back());
  }
  if (bodies_.empty()) return;
  const proof::MatrixBounds bounds(sweep.system, 1 / all_.modes.theta + all_.modes.error, matrices);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const double factor = largestFactor(*bodies_[i], points);
    DampedSet::Body body{.power = bodies_[i]->power, .skew = isSkew(bodies_[i]->matrix), .onV = {}};
    if (body.skew) {
      body.bound = bounds.ofSkew(matrices[i], factor * std::pow(top, body.power));
    } else if (body.power == 0) {
      body.bound = bounds.ofSymmetric(matrices[i], factor);
    } else {
      const auto [whole, below] =
          bounds.ofDamping(matrices[i], factor * proof::mostLeft * top, factor * top);
      body.bound = whole;
      body.below = below;
    }
    all_.bodies.push_back(std::move(body));
  }
}

/// Collective. Computes Vᵀ X V and Vᵀ X_iᵀ K0⁻¹ X_j V.
void CommonProducts::addProducts(reduction::ReducedProblem& reduced,
                                 const std::vector<double>& lambda, Mat mass) {
  constexpr PetscInt atOnce = 128;  // limits the memory
  const auto& basis = reduced.basis();
  all_.products.resize(bodies_.size() + 1);
  all_.products[0].push_back(massFlexibility(reduced, all_.modes, lambda, mass, basis.size()));
  for (std::size_t j = 0; j < bodies_.size(); ++j) {
    auto& body = all_.bodies[j];
    std::vector<DenseMatrix> columns(j + 2, DenseMatrix(basis.size()));  // [i] of X_iᵀ K0⁻¹ X_j
    body.onV = DenseMatrix(basis.size());
    for (PetscInt first = 0; first < basis.size(); first += atOnce) {
      const PetscInt last = std::min(first + atOnce, basis.size());
      linalg::Block forces(basis.localRows());
      basis.appendProducts(bodies_[j]->matrix, first, last, forces);
      body.onV.append(linalg::transposedProduct(basis.comm(), basis.columns(), forces));
      const linalg::Block responses = reduced.responses(forces);
      for (std::size_t i = 0; i < columns.size(); ++i) {
        // Of a matrix without s, only the norm is used.
        if (i <= j && (body.power == 0 || (i > 0 && all_.bodies[i - 1].power == 0))) continue;
        linalg::Block products(basis.localRows());
        linalg::appendProduct(i == 0 ? mass : bodies_[i - 1]->matrix.get(), responses, products);
        auto part = linalg::transposedProduct(basis.comm(), basis.columns(), products);
        if (i > 0 && all_.bodies[i - 1].skew)
          for (double& entry : part.entries()) entry = -entry;
        columns[i].append(part);
      }
    }
    // Vᵀ X_jᵀ K0⁻¹ X_i V
    for (const auto& matrix : columns) all_.products[j + 1].push_back(linalg::transposed(matrix));
  }
}

DampedSet CommonProducts::of(const subspace::PointSpace& space) const {
  const auto square = [&](const DenseMatrix& matrix) {
    linalg::DenseProblem one;
    one.stiffness = matrix;
    return space.restricted(std::move(one)).stiffness;
  };
  DampedSet set;
  set.modes = all_.modes;
  set.modes.first = space.own();
  for (const auto& body : all_.bodies)
    set.bodies.push_back({body.power, body.skew, square(body.onV), body.bound, body.below});
  for (const auto& row : all_.products) {
    auto& to = set.products.emplace_back();
    for (const auto& matrix : row) to.push_back(matrix.empty() ? DenseMatrix() : square(matrix));
  }
  for (const auto& [power, onV, flexibility, ofMass] : all_.normals)
    set.normals.push_back({power, space.restrictedColumns(onV), flexibility,
                           ofMass.empty() ? DenseMatrix() : space.restrictedColumns(ofMass)});
  set.normalProduct = all_.normalProduct;
  set.jumps = space.restrictedColumns(all_.jumps);
  set.jumpsOnC = all_.jumpsOnC;
  if (!all_.convected.empty()) set.convected = space.restrictedColumns(all_.convected);
  set.convectedFlexibility = all_.convectedFlexibility;
  return set;
}

pencil::PointFactors CommonProducts::restricted(const pencil::PointFactors& factors) const {
  constexpr double roundOff = 1e-12;
  DenseMatrix rows = linalg::rowsOf(jumpRows_, factors.response);
  const double all = linalg::squaredLength(rows.entries());
  for (const PetscInt column : jumpRows_) std::ranges::fill(rows.column(column), 0.0);
  if (linalg::squaredLength(rows.entries()) > roundOff * roundOff * all)
    throw Error("friction damping couples contact nodes with nodes that cannot slide");
  return {linalg::transposed(linalg::rowsOf(jumpRows_, linalg::transposed(factors.slip))),
          linalg::principalPart(jumpRows_, factors.response)};
}

}  // namespace squeal::completeness
