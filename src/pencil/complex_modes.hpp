#pragma once
/// The friction-perturbed eigenproblem (paper, section 4): which modes flutter, at which friction,
/// how fast they grow.
#include <complex>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "linalg/complexvector.hpp"
#include "sweep/parameters.hpp"

namespace squeal::pencil {

struct Eigenvalue {
  std::complex<double> s;    ///< growth rate + i angular frequency, 1/s
  double backwardError = 0;  ///< of the full-order problem
  double errorEstimate = 0;  ///< of |δs|/|s|; NaN where there is none (direct method)
  bool certified = false;    ///< both are as small as asked for
  bool unstable = false;     ///< Re s > -flutter_unstable_tolerance · |s|
};

/// A complex mode d = real + i imaginary in nodal displacements, N entries, largest entry 1.
struct Shape {
  std::size_t index;  ///< into Point::eigenvalues
  OwnedVec real, imaginary;
  linalg::ComplexVector unknowns;    ///< the same d in the unknowns x
  std::vector<double> frictionWork;  ///< [owned contact node] what friction there adds to the
                                     ///< growth rate, 1/s: frictionWork()
};

struct Derivative {
  std::string parameter;
  std::complex<double> value;  ///< ds/dθ, 1/s per unit of the parameter
};

/// What is known of one eigenvalue besides its value.
struct Sensitivity {
  double condition = 0;  ///< 2 |s| ‖x‖_M ‖y‖_M / |yᴴ P′(s) x|: 1 for a symmetric problem, infinite
                         ///< at an exceptional point
  /// Distance to the nearest of the other eigenvalues found, relative to |s|
  double separation = 0;
  double leftBackwardError = 0;
  std::vector<Derivative> derivatives;  ///< empty if not regular()
  /// False where eigenvalues meet, and so have no derivatives, and where the left vector was not
  /// found.
  bool regular() const;
};

/// Everything found at one point of the sweep.
struct FrictionPoint {
  sweep::Parameters at;
  std::vector<Eigenvalue> eigenvalues;     ///< Im s ≥ 0, by ascending frequency
  std::vector<Shape> shapes;               ///< of the fastest growing ones
  std::vector<Sensitivity> sensitivities;  ///< [shape]; empty unless they are asked for
  /// rad/s: eigenvalues with |s| up to here are listed, and corrected; 0: none are
  double bandTop = 0;
  int freeModesInBand = 0;  ///< free modes up to bandTop
  bool damped = false;      ///< the problem has terms in s
  double accuracy = 0;      ///< backward error asked for
  double tolerance = 0;     ///< estimate of |δs|/|s| asked for
  double askedTo = 0;       ///< rad/s: upper end of the band asked of the direct method; 0: none
  double coveredTo = 0;  ///< rad/s: all eigenvalues of that band with |s| below are listed; 0: none
  /// Of a damped problem, the free modes of the band that no eigenvalue listed answers to: those
  /// are damped too strongly to be listed, or have been moved beyond the top.
  int modesWithoutEigenvalue() const;
  int unstableCount() const;
  int uncertifiedCount() const;
  double worstBackwardError() const;
  double worstErrorEstimate() const;
  /// Null if there are no eigenvalues.
  const Eigenvalue* fastestGrowing() const;
};

/// `-flutter_accuracy`: backward error up to which an eigenvalue is certified.
double accuracyAsked();

/// Marks unstable eigenvalues.
void judge(std::vector<Eigenvalue>& eigenvalues);

/// Indices of the `-flutter_shapes` fastest growing eigenvalues below `-flutter_shapes_below`, the
/// fastest first.
std::vector<std::size_t> shapesWanted(const FrictionPoint& point);
/// Collective. Keeps the shapes of these eigenvalues; `modes` are theirs in the unknowns x, of any
/// length.
void keepShapes(FrictionPoint& point, Mat trial, const std::vector<std::size_t>& indices,
                std::vector<linalg::ComplexVector> modes);

}  // namespace squeal::pencil
