// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The terms of a pencil, projected on a growing basis V. The projections VᵀAV are stored, and also
/// sketches of A V and AᵀV for the norms of residuals [M.39]. The product A V is stored only if at
/// most a quarter of the rows of A are nonzero, since otherwise it would take nearly as much memory
/// as V.
#include <span>
#include <vector>

#include "algebra/linalg/block.hpp"
#include "algebra/linalg/quadratic.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/subspace/basis.hpp"
#include "eigen/subspace/substructure.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::reduction {

using subspace::Basis;
using subspace::PointSpace;

/// The vectors of some eigenpairs, in coordinates of a basis, as columns of a real matrix. In a
/// problem without damping, a pair with real vectors and an imaginary s takes one column. All other
/// pairs take two.
class Coordinates {
 public:
  std::vector<const linalg::DensePair*> pairs;  ///< borrowed
  std::vector<PetscInt> firstColumn;            ///< [pair], followed by `columns`
  PetscInt columns = 0;                         ///< columns of all pairs

  /// The vectors of the pairs are in the coordinates of a point with this space.
  Coordinates(std::vector<const linalg::DensePair*> pairs, bool damped, const PointSpace& space);
  /// Returns true if the pair takes one column.
  bool isReal(std::size_t pair) const;
  /// Returns the real and imaginary parts of c s^power q, or of c conj(s)^power y for the left
  /// side, basis × columns. A pair of one column has only the real part.
  linalg::DenseMatrix times(pencil::Side side, int power, double c) const;
  /// Returns for each pair the sum of the values of its columns, [pair], from values [column].
  std::vector<double> perPair(const std::vector<double>& ofColumns) const;

 private:
  const std::vector<Complex>& vectorOf(std::size_t pair, pencil::Side side) const;
  // [pair] vectors in coordinates of the basis; empty if the point uses the whole basis
  std::vector<std::vector<Complex>> right_, left_;
};

/// The weights of the terms of a pencil at a point.
struct Weights {
  sweep::Parameters at;
  bool associated = false;  ///< only the terms of K0 and M0 have nonzero weights

  /// Returns the coefficient of a term.
  double of(const pencil::Term& term) const;
};

/// Pairs of one point; their vectors are borrowed.
struct PointPairs {
  Weights weights;
  Coordinates pairs;
};

/// Some terms of a pencil with their projections.
class ProjectedTerms {
 public:
  /// Collective. Projects these terms and shares their matrices. Borrows the basis during the
  /// lifetime of the object.
  ProjectedTerms(const Basis& basis, std::span<const pencil::Term> terms);
  std::size_t count() const { return parts_.size(); }
  /// Collective. Extends the projections to the new vectors of the basis.
  void extend();
  /// Not collective. Updates the projections for a basis that has become V · combinations.
  /// `combinations` is former size × new size.
  void combine(const linalg::DenseMatrix& combinations);
  /// Not collective. Adds Σ c_t VᵀA_tV to the matrices of the problem, which are empty or of the
  /// size of the basis.
  void addTo(const Weights& weights, linalg::DenseProblem& sum) const;
  /// Not collective. Adds to `result`, which has this rank's rows, combinations of the columns
  /// P(s) V q of all points, with one product per term, for the terms with few nonzero rows.
  /// `combinations` has one row per column P(s) V q, point after point, and one column per column
  /// of the result.
  void addThinTo(const std::vector<const PointPairs*>& points,
                 const linalg::DenseMatrix& combinations, linalg::Block& result) const;
  /// Collective. Does the same for the other terms. If one of them is K0, the result is less
  /// K0 V (VᵀK0V)⁻¹ `less`; an empty `less` is zero.
  void addWholeTo(const std::vector<const PointPairs*>& points,
                  const linalg::DenseMatrix& combinations, const linalg::DenseMatrix& less,
                  linalg::Block& result) const;
  /// Not collective. Returns Vᵀ times what addWholeTo() adds for an empty `less`.
  linalg::DenseMatrix projectedWhole(const std::vector<const PointPairs*>& points,
                                     const linalg::DenseMatrix& combinations) const;
  /// Returns true if one of the terms is K0.
  bool hasStiffness() const;
  /// Not collective. Adds the sketch of P(s) V q, or of P(s)ᴴ V y for the left side, to `sketch`,
  /// which is 2 Sketch::size × columns.
  void addTo(const PointPairs& point, pencil::Side side, linalg::DenseMatrix& sketch) const;

 private:
  struct Part {
    pencil::Term term;
    linalg::RowSet rows;             // nonzero rows of A if they are few, otherwise all rows
    OwnedMat matrix;                 // A in these rows
    bool isSymmetric;                // true if A is symmetric
    OwnedMat adjoint;                // Aᵀ; null if A is symmetric or has few rows
    linalg::Block timesSigns;        // A Ω in `rows`; empty if A is symmetric or has all rows
    linalg::Block timesV;            // A V in `rows`; empty if these are all rows
    linalg::DenseMatrix sketch;      // sketch of A V
    linalg::DenseMatrix leftSketch;  // sketch of AᵀV; empty if A is symmetric
    linalg::DenseMatrix projection;  // VᵀAV
  };
  Part partOf(pencil::Term term) const;
  void extend(Part& part) const;
  bool isStiffness(const Part& part) const { return part.term.matrix == basis_.stiffness(); }
  bool hasProductsFrom(const Part& part, PetscInt old) const;
  linalg::DenseMatrix coefficients(const Part& part, const std::vector<const PointPairs*>& points,
                                   const linalg::DenseMatrix& combinations) const;
  const Basis& basis_;
  std::vector<Part> parts_;
};

}  // namespace squeal::reduction
