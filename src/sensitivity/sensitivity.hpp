#pragma once
/// Derivatives of eigenvalues by left and right vectors, on the pencil alone: ds/dθ = −yᴴ (∂P/∂θ)(s) x / yᴴ P′(s) x, with
/// P′ = dP/ds = 2 s M̄ + Z̄.
#include <complex>
#include <string>
#include <vector>

#include "linalg/complexvector.hpp"
#include "pencil/pencil.hpp"

namespace squeal::flutter {

struct Derivative {
  std::string parameter;
  std::complex<double> value;  ///< ds/dθ, 1/s per unit of the parameter
};

/// What is known of one eigenvalue besides its value.
struct Sensitivity {
  double condition = 0;  ///< 2 |s| ‖x‖_M ‖y‖_M / |yᴴ P′(s) x|: 1 for a symmetric problem, infinite at an exceptional point
  double separation = 0;  ///< distance to the nearest of the other eigenvalues found, relative to |s|
  double leftBackwardError = 0;
  std::vector<Derivative> derivatives;  ///< empty if not regular()
  /// False where eigenvalues meet, and so have no derivatives, and where the left vector was not found.
  bool regular() const;
};

struct EigenTriple {
  std::complex<double> s;
  const ComplexVector& x;  ///< right vector, in the unknowns
  const ComplexVector& y;  ///< left vector
};

/// `-flutter_sensitivities`.
bool sensitivitiesWanted();

/// Collective. yᴴ P′(s) x.
std::complex<double> slopeForm(const Pencil& pencil, const Parameters& at, const EigenTriple& triple);
/// Collective. yᴴ (∂P/∂θ)(s) x as far as the coefficients of the terms hold θ.
std::complex<double> parameterForm(const Pencil& pencil, const Parameters& at, const EigenTriple& triple,
                                   double Parameters::*parameter);
/// Collective. Sensitivity::condition for the given yᴴ P′(s) x, in the norm of the mass M0.
double condition(const EigenTriple& triple, std::complex<double> slope, Mat mass);

}  // namespace squeal::flutter
