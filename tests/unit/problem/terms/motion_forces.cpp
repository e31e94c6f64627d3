// SPDX-License-Identifier: BSD-2-Clause
// Nodal forces and energy of a motion, against sums over all entries of the matrices.
#include <gtest/gtest.h>

#include <cmath>

#include "problem/terms/friction_work.hpp"
#include "support/algebra/sparse.hpp"

namespace squeal::test {
namespace {

constexpr PetscInt size = 6;

/// Returns a matrix of three diagonals: `lower` below, `upper` above, and `diagonal` times 1, 2, ….
OwnedMat banded(double diagonal, double lower, double upper) {
  EntryList entries;
  for (PetscInt i = 0; i < size; ++i) {
    if (diagonal != 0) entries.emplace_back(i, i, diagonal * (i + 1));
    if (i > 0) entries.emplace_back(i, i - 1, lower);
    if (i + 1 < size) entries.emplace_back(i, i + 1, upper);
  }
  return matrixOf(size, entries);
}

/// The entries of the motion.
std::vector<Complex> motion() {
  std::vector<Complex> u;
  for (int i = 0; i < size; ++i) u.emplace_back(std::cos(i), 0.5 * std::sin(2 * i));
  return u;
}

linalg::ComplexVector distributed(Mat like, const std::vector<Complex>& u) {
  std::vector<double> real, imaginary;
  for (const Complex entry : u) real.push_back(entry.real()), imaginary.push_back(entry.imag());
  return {vectorOf(like, true, real), vectorOf(like, true, imaginary)};
}

/// Returns A u, and adds uᴴ A u to `form`.
std::vector<Complex> times(Mat a, const std::vector<Complex>& u, Complex& form) {
  const linalg::DenseMatrix dense = denseCopy(a);
  std::vector<Complex> result(size);
  for (PetscInt i = 0; i < size; ++i) {
    for (PetscInt j = 0; j < size; ++j) result[i] += dense(i, j) * u[j];
    form += std::conj(u[i]) * result[i];
  }
  return result;
}

// r = (s² M + s (c C + v G) + K + v² K^R + K_σ) u,  E = |s|² uᴴ M u + uᴴ (K + v² K^R + K_σ) u.
TEST(MotionForces, AreThoseOfAllMatrices) {
  elasticity::Bodies bodies;
  bodies.stiffness = banded(5, -1, -1);
  bodies.mass = banded(0.3, 0.1, 0.1);
  const OwnedMat prestress = banded(0.5, 0.2, 0.2);
  const std::vector<Complex> u = motion();
  const linalg::ComplexVector given = distributed(bodies.mass, u);
  const Complex s(-0.2, 3);
  const sweep::Parameters at{0.4, 2, 1, 0.25};
  for (const bool all : {false, true}) {
    if (all) {
      bodies.damping = banded(0.7, 0.1, 0.1);
      bodies.gyroscopic = banded(0, -0.6, 0.6);
      bodies.rotationStiffness = banded(-0.4, 0.3, 0.3);
    }
    const auto found = terms::motionForces(bodies, {at, s, given, all ? prestress.get() : nullptr});
    std::vector<Complex> forces(size);
    Complex energy = 0;
    const auto add = [&](Mat a, Complex factor, double ofEnergy) {
      Complex form = 0;
      const auto part = times(a, u, form);
      for (PetscInt i = 0; i < size; ++i) forces[i] += factor * part[i];
      energy += ofEnergy * form;
    };
    add(bodies.stiffness, 1, 1);
    add(bodies.mass, s * s, std::norm(s));
    if (all) {
      add(prestress, 1, 1);
      add(bodies.rotationStiffness, 4, 4);
      add(bodies.damping, 0.25 * s, 0);
      add(bodies.gyroscopic, 2.0 * s, 0);
    }
    const auto real = allEntries(found.forces.real), imaginary = allEntries(found.forces.imaginary);
    double largest = 0;
    for (const Complex force : forces) largest = std::max(largest, std::abs(force));
    for (PetscInt i = 0; i < size; ++i) {
      EXPECT_NEAR(real[i], forces[i].real(), 1e-14 * largest);
      EXPECT_NEAR(imaginary[i], forces[i].imag(), 1e-14 * largest);
    }
    EXPECT_NEAR(found.energy, energy.real(), 1e-14 * std::abs(energy));
    EXPECT_NEAR(energy.imag(), 0, 1e-14 * std::abs(energy));  // the matrices are symmetric
  }
}

}  // namespace
}  // namespace squeal::test
