// SPDX-License-Identifier: BSD-2-Clause
// Layers whose meshes do not match on the sliding surface: convergence of frequencies and growth
// rates to the exact waves.
#include <gtest/gtest.h>

#include "exact/antiplane.hpp"
#include "exact/moving_layers.hpp"
#include "exact/two_layers.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

namespace two_layers = exact::two_layers;

const std::vector<double> frictions{0.1, 0.3, 0.5};
constexpr std::size_t count = 12;

std::vector<Complex> exactAt(double friction) {
  if (friction == 0.1) return exactValues(two_layers::friction01, count);
  if (friction == 0.3) return exactValues(two_layers::friction03, count);
  return exactValues(two_layers::friction05, count);
}

/// The lowest eigenvalues of the problem on all unknowns, so that no modal basis adds to the error
/// of the mesh; [friction].
std::vector<Errors> fullOrder(const std::string& mesh, const std::string& options) {
  const analysis::Analysis analysis =
      runCase("two_layers", options + " -mesh_set " + mesh +
                                " -elasticity_mass consistent -flutter_friction 0.1,0.3,0.5"
                                " -flutter_method direct -flutter_direct_count 24");
  EXPECT_FALSE(analysis.model.contact.interfaces.reports.at(0).matching);
  std::vector<Errors> result;
  for (std::size_t i = 0; i < frictions.size(); ++i) {
    result.push_back(
        errors(exactAt(frictions[i]), eigenvaluesOf(analysis.flutter.segments.at(0).points.at(i))));
    print("%s, f = %g: frequency %.1e, growth rate %.1e\n", mesh.c_str(), frictions[i],
          worst(result.back().frequency), worst(result.back().growth));
  }
  return result;
}

/// Root mean squares: single errors change sign between two meshes.
void expectOrder(double least, const std::string& coarse, const std::string& fine,
                 const std::string& options = "") {
  const auto before = fullOrder(coarse, options), after = fullOrder(fine, options);
  for (std::size_t i = 0; i < frictions.size(); ++i) {
    const double frequency = std::log2(rootMeanSquare(before[i].frequency) /
                                       rootMeanSquare(after[i].frequency)),
                 growth =
                     std::log2(rootMeanSquare(before[i].growth) / rootMeanSquare(after[i].growth));
    print("f = %g: orders %.2f, growth %.2f\n", frictions[i], frequency, growth);
    EXPECT_GT(frequency, least);
    EXPECT_GT(growth, least);
  }
}

// Cells 2:3 and 5:7, either side finer.
TEST(NonMatchingLayers, SecondOrderWithQuad4) {
  expectOrder(1.9, "nx=24,nx_pad=36,ny_disc=8,ny_pad=7", "nx=48,nx_pad=72,ny_disc=16,ny_pad=14");
  expectOrder(1.9, "nx=35,nx_pad=25,ny_disc=12,ny_pad=5", "nx=70,nx_pad=50,ny_disc=24,ny_pad=10");
}

TEST(NonMatchingLayers, FourthOrderWithQuad9) {
  expectOrder(3.5, "order=2,nx=16,nx_pad=24,ny_disc=6,ny_pad=5",
              "order=2,nx=32,nx_pad=48,ny_disc=12,ny_pad=10");
  expectOrder(3.5, "order=2,nx=28,nx_pad=20,ny_disc=10,ny_pad=4",
              "order=2,nx=56,nx_pad=40,ny_disc=20,ny_pad=8");
}

}  // namespace
}  // namespace squeal::test
