#pragma once
/// Terms of a pencil on a growing basis V: the products A V, by this rank's rows, the projections
/// VᵀAV, and sketches of A V and AᵀV for the norms of residuals.
#include <vector>

#include "linalg/block.hpp"
#include "linalg/quadratic.hpp"
#include "pencil/pencil.hpp"
#include "reduction/basis.hpp"
#include "sweep/parameters.hpp"

namespace squeal::reduction {

/// The vectors of some eigenpairs in coordinates of a basis, as columns of a real matrix. A pair
/// that has real vectors and a real s², in a problem without damping, takes one column, others take
/// two.
struct Coordinates {
  std::vector<const linalg::DensePair*> pairs;
  std::vector<PetscInt> firstColumn;  ///< [pair], and the end
  PetscInt columns = 0;

  Coordinates(std::vector<const linalg::DensePair*> pairs, bool damped);
  bool isReal(std::size_t pair) const;
  /// Returns the real and imaginary parts of c s^power q, or of c conj(s)^power y, as columns.
  linalg::DenseMatrix times(pencil::Side side, int power, double c) const;
};

/// Pairs found at one point; their vectors are borrowed.
struct PointPairs {
  sweep::Parameters at;
  Coordinates pairs;
};

/// Some terms of a pencil with their projections.
class ProjectedTerms {
 public:
  /// Collective. Takes the terms [first, last) of the pencil, whose matrices are shared. Borrows
  /// the basis and its sketch.
  ProjectedTerms(const Basis& basis, const pencil::Pencil& pencil, std::size_t first,
                 std::size_t last);
  /// Collective. Extends the projections to the vectors that the basis has gained.
  void extend();
  /// Turns the projections with a basis that has become V · combinations, its former size × its
  /// size. Not collective.
  void combine(const linalg::DenseMatrix& combinations);
  /// Adds Σ c_t VᵀA_tV to the matrices of the problem, which are empty or of the size of the basis.
  void addTo(const sweep::Parameters& at, linalg::DenseProblem& sum) const;
  /// Adds combinations of the columns P(s) V q of all points in turn, in one product per term.
  /// `combinations` has a row for each of these columns, and the columns of the result.
  void addTo(const std::vector<const PointPairs*>& points, const linalg::DenseMatrix& combinations,
             linalg::Block& result) const;
  /// Adds the sketch of P(s) V q or P(s)ᴴ V y.
  void addTo(const PointPairs& point, pencil::Side side, linalg::DenseMatrix& sketch) const;

 private:
  struct Part {
    pencil::Term term;
    linalg::RowSet rows, leftRows;   // of A and Aᵀ
    OwnedMat matrix, adjoint;        // these rows; no adjoint where A is symmetric
    linalg::Block timesV;            // A V, by `rows`
    linalg::Block rowsOfV;           // these rows of V; none if they are all
    linalg::DenseMatrix sketch;      // of A V
    linalg::DenseMatrix leftSketch;  // of AᵀV; empty where A is symmetric
    linalg::DenseMatrix projection;  // VᵀAV
  };
  Part partOf(pencil::Term term) const;
  void extend(Part& part) const;
  bool knownFrom(const Part& part, PetscInt old) const;
  void project(Part& part, PetscInt old) const;
  const Basis& basis_;
  std::vector<Part> parts_;
};

}  // namespace squeal::reduction
