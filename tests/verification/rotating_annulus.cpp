// SPDX-License-Identifier: BSD-2-Clause
// An annulus that turns: gyroscopic terms and rotation stiffness split its double modes into
// forward and backward waves.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "base/system/text.hpp"
#include "eigen/direct/nearest.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "exact/annulus.hpp"
#include "model/contact/coupled.hpp"
#include "model/mesh/mesh.hpp"
#include "problem/terms/terms.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal {
namespace {

using test::Complex;

constexpr exact::annulus::Annulus annulus{1, 0.3, 1, 0.4, 1};
constexpr double speed = 0.05;  // ω, rad/s; shear waves run round the rim at 0.62 rad/s
constexpr double top = 4;       // rad/s, of the eigenvalues compared
constexpr int highestOrder = 4;

TEST(Annulus, RadialSolutionIsBesselsAtRest) {
  int count = 0;
  for (int n = 0; n <= highestOrder; ++n)
    for (double lambda : exact::annulus::vehicleFrequencies(annulus, n, 0, top)) {
      ++count;
      EXPECT_LT(exact::annulus::characteristic(annulus, n, lambda * (1 - 1e-10)) *
                    exact::annulus::characteristic(annulus, n, lambda * (1 + 1e-10)),
                0)
          << n << " " << lambda;
    }
  EXPECT_GE(count, 2 * highestOrder);
}

TEST(Annulus, RadialSolutionHasConverged) {
  for (int n = -highestOrder; n <= highestOrder; ++n) {
    const auto coarse = exact::annulus::vehicleFrequencies(annulus, n, speed, top, 14),
               fine = exact::annulus::vehicleFrequencies(annulus, n, speed, top, 24);
    ASSERT_FALSE(fine.empty()) << "n = " << n;
    ASSERT_EQ(coarse.size(), fine.size());
    for (std::size_t i = 0; i < fine.size(); ++i) EXPECT_NEAR(coarse[i] / fine[i], 1, 1e-10);
  }
}

/// `cells` along a quarter of the circle, quadrangles of 9 nodes.
std::string mesh(int cells) {
  std::string text = "Point(1) = {0, 0, 0};\n";
  for (int side = 0; side < 2; ++side)
    for (int q = 0; q < 4; ++q) {
      const double r = side ? annulus.outer : annulus.inner;
      text += formatted("Point(%d) = {%.17g, %.17g, 0};\n", 10 + 10 * side + q,
                        r * (q % 2 ? 0 : 1 - q), r * (q % 2 ? 2 - q : 0));
    }
  for (int q = 0; q < 4; ++q) {
    const int next = (q + 1) % 4;
    text +=
        formatted("Line(%d) = {%d, %d};\nCircle(%d) = {%d, 1, %d};\nCircle(%d) = {%d, 1, %d};\n",
                  10 + q, 10 + q, 20 + q, 20 + q, 10 + q, 10 + next, 30 + q, 20 + q, 20 + next);
  }
  for (int q = 0; q < 4; ++q) {
    const int next = (q + 1) % 4;
    text += formatted("Curve Loop(%d) = {%d, %d, %d, %d};\nPlane Surface(%d) = {%d};\n", 10 + q,
                      10 + q, 30 + q, -(10 + next), -(20 + q), 10 + q, 10 + q);
  }
  text +=
      formatted("Transfinite Curve {10 : 13} = %d;\nTransfinite Curve {20 : 23, 30 : 33} = %d;\n",
                cells / 2 + 1, cells + 1);
  text +=
      "Transfinite Surface {10 : 13};\nRecombine Surface {10 : 13};\nPhysical Curve(\"inner\") = "
      "{20 : 23};\n"
      "Physical Surface(\"disc\") = {10 : 13};\nMesh.ElementOrder = 2;\n";
  return test::writeFile(formatted("annulus_%d.geo", cells), text);
}

std::string turning(int cells, double omega) {
  return "-mesh_file " + mesh(cells) + test::material("disc", "1", "0.3", "1") +
         "-constraint_inner_clamped xy -motion_convective on " +
         formatted("-motion_disc_speed %.17g ", omega);
}

/// Frequencies Λ > 0 of the waves e^{i(nθ + Λt)}, by n.
using Waves = std::map<int, std::vector<double>>;

/// Collective. The order n of the shape: where the Fourier transform of u_r and u_θ on the rim,
/// whose nodes are equally spaced, is.
int orderOf(const mesh::Mesh& mesh, Vec real, Vec imaginary) {
  constexpr int range = 12;
  std::vector<double> sums(
      8 * range + 6, 0.0);  // [n][Re, Im of the transforms of u_r and u_θ], Σ |u|², number of nodes
  const PetscScalar *a = nullptr, *b = nullptr;
  check(VecGetArrayRead(real, &a));
  check(VecGetArrayRead(imaginary, &b));
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node) {
    const auto& x = mesh.coordinates[node];
    if (std::hypot(x[0], x[1]) < annulus.outer - 1e-9) continue;
    const Complex ux(a[2 * node], b[2 * node]), uy(a[2 * node + 1], b[2 * node + 1]);
    const Complex components[] = {x[0] * ux + x[1] * uy,
                                  x[0] * uy - x[1] * ux};  // the rim's radius is 1
    for (int n = -range; n <= range; ++n)
      for (int c = 0; c < 2; ++c) {
        const Complex part = components[c] * std::polar(1.0, -n * std::atan2(x[1], x[0]));
        const auto at = static_cast<std::size_t>(4 * (n + range) + 2 * c);
        sums[at] += part.real(), sums[at + 1] += part.imag();
      }
    sums[sums.size() - 2] += std::norm(ux) + std::norm(uy);
    sums.back() += 1;
  }
  check(VecRestoreArrayRead(real, &a));
  check(VecRestoreArrayRead(imaginary, &b));
  check(MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                      PETSC_COMM_WORLD));
  int best = 0;
  double power = 0;
  for (int n = -range; n <= range; ++n) {
    double square = 0;
    for (int i = 0; i < 4; ++i) square += std::pow(sums[4 * (n + range) + i], 2);
    if (square > power) power = square, best = n;
  }
  // Parseval: all of a pure wave is at its n, except for the contribution of the mesh cells.
  EXPECT_GT(power, (1 - 1e-3) * sums.back() * sums[sums.size() - 2]);
  return best;
}

/// Collective. All waves with Λ < top.
Waves computed(int cells, double omega) {
  test::setOptions(turning(cells, omega));
  const auto model = test::buildModel();
  const contact::CoupledSystem system(model.bodies, model.contact, {});
  const auto pencil = terms::affineTerms(model.contact, system);
  const auto solver = direct::nearestSolver(pencil, {0, 1});
  const auto found = solver->solve(40);
  EXPECT_GT(found.reached, top);
  Waves waves;
  for (const auto& pair : found.pairs) {
    const auto s = pair.s;
    if (s.imag() > top) continue;
    EXPECT_LT(std::abs(s.real()), 1e-9) << s;
    const OwnedVec u = elasticity::nodalVector(*model.mesh),
                   v = elasticity::nodalVector(*model.mesh);
    check(MatMult(system.transformation().trial, pair.real, u));
    check(MatMult(system.transformation().trial, pair.imaginary, v));
    waves[orderOf(*model.mesh, u, v)].push_back(s.imag());
  }
  for (auto& [n, list] : waves) std::sort(list.begin(), list.end());
  return waves;
}

/// Relative errors of the waves up to the order 4, by n and frequency.
std::vector<double> errors(const Waves& waves, double omega) {
  std::vector<double> list;
  for (int n = -highestOrder; n <= highestOrder; ++n) {
    const auto exact = exact::annulus::vehicleFrequencies(annulus, n, omega, top);
    const auto found = waves.count(n) ? waves.at(n) : std::vector<double>{};
    EXPECT_EQ(found.size(), exact.size()) << "n = " << n;
    for (std::size_t i = 0; i < exact.size(); ++i)
      list.push_back(i < found.size() ? std::abs(found[i] / exact[i] - 1) : NAN);
  }
  return list;
}

TEST(Annulus, WavesSplitByRotation) {
  const auto coarse = computed(14, speed), fine = computed(28, speed);
  const auto coarseErrors = errors(coarse, speed), fineErrors = errors(fine, speed);
  test::print("%zu waves: largest error %.1e, %.1e\n", fineErrors.size(), test::worst(coarseErrors),
              test::worst(fineErrors));
  test::expectOrder(4, 0.4, coarseErrors, fineErrors, "frequencies");
  EXPECT_LT(test::worst(fineErrors), 1e-5);
  // Not split, or shifted by (n ± 1) ω on top of the Coriolis term, they would be off by per cents.
  for (int n = 1; n <= highestOrder; ++n) {
    const double against = fine.at(n).at(0), along = fine.at(-n).at(0);
    test::print("n = %d: %.6f and %.6f, split by %.1f %%\n", n, against, along,
                100 * (along / against - 1));
    EXPECT_GT(along / against, 1.02);
  }
}

// P(s; −ω) = P(−s; ω): the same frequencies, each of the wave that runs the other way.
TEST(Annulus, TurningTheOtherWayMirrorsTheWaves) {
  const auto one = computed(14, speed), other = computed(14, -speed);
  ASSERT_GT(one.size(), 2u * highestOrder);
  ASSERT_EQ(one.size(), other.size());
  for (const auto& [n, list] : one) {
    const auto& mirrored = other.at(-n);
    ASSERT_EQ(list.size(), mirrored.size()) << n;
    for (std::size_t i = 0; i < list.size(); ++i) EXPECT_NEAR(mirrored[i] / list[i], 1, 1e-10);
  }
}

/// Every eigenvalue up to the top with Im s > 0.
std::vector<Complex> allExact() {
  std::vector<Complex> list;
  for (int n = -20; n <= 20; ++n)
    for (double frequency : exact::annulus::vehicleFrequencies(annulus, n, speed, top))
      list.emplace_back(0, frequency);
  return list;
}

// No contact, no friction, by either method of the whole program.
TEST(Annulus, ProgramWithoutContact) {
  const auto exact = allExact();
  for (const std::string method :
       {"-flutter_method direct -flutter_direct_band 0,0.64 -flutter_direct_count 25",
        "-modes_count 50 -flutter_band 0.64"}) {
    const auto analysis = test::runOptions(turning(12, speed) + "-flutter_friction 0 " + method);
    EXPECT_EQ(analysis.model.contact.interfaces.totalNodes, 0);
    ASSERT_EQ(analysis.flutter.segments.size(), 1u);
    auto found = test::eigenvaluesOf(analysis.flutter.segments[0].points.at(0));
    std::erase_if(found, [](Complex s) { return s.imag() > top; });
    EXPECT_EQ(found.size(), exact.size()) << method;
    const double error = test::worst(test::errors(exact, found).relative);
    test::print("%s: %zu eigenvalues, largest error %.1e\n", method.c_str(), found.size(), error);
    EXPECT_LT(error, 1e-3)
        << method;  // orders up to 6 on a mesh of 48 cells around; the waves are split by per cents
    for (const Complex s : found) EXPECT_LT(std::abs(s.real()), 1e-8) << method;
  }
}

}  // namespace
}  // namespace squeal
