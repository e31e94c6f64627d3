// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sensitivity/sensitivity.hpp"

#include <cmath>

namespace squeal::sensitivity {
namespace {

double massNorm(Mat mass, const linalg::ComplexVector& u) {
  return std::sqrt(std::abs(dot(u, product(mass, u))));
}

}  // namespace

Complex slopeForm(const pencil::Pencil& pencil, const sweep::Parameters& at,
                  const EigenTriple& triple) {
  Complex sum = 0;
  for (int power = 1; power <= 2; ++power) {
    if (!pencil.hasPower(power)) continue;
    linalg::ComplexVector product = linalg::ComplexVector::like(triple.x.real);
    pencil.apply(power, at, triple.x.real, product.real);
    pencil.apply(power, at, triple.x.imaginary, product.imaginary);
    sum += (power == 1 ? 1.0 : 2.0 * triple.s) * dot(triple.y, product);
  }
  return sum;
}

Complex parameterForm(const pencil::Pencil& pencil, const sweep::Parameters& at,
                      const EigenTriple& triple, double sweep::Parameters::*parameter) {
  Complex sum = 0;
  for (const auto& term : pencil.terms())
    if (const double slope = term.slope(at, parameter); slope != 0)
      sum += slope * std::pow(triple.s, term.power) * dot(triple.y, product(term.matrix, triple.x));
  return sum;
}

double condition(const EigenTriple& triple, Complex slope, Mat mass) {
  return 2 * std::abs(triple.s) * massNorm(mass, triple.x) * massNorm(mass, triple.y) /
         std::abs(slope);
}

}  // namespace squeal::sensitivity
