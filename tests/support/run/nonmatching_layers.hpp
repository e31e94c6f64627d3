// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Layers whose meshes do not match on the sliding surface: errors of the program's eigenvalues and
/// the order at which they fall.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "exact/antiplane.hpp"
#include "exact/moving_layers.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/run/case.hpp"

namespace squeal::test {

/// Root mean squares of the errors of one mesh: single errors change sign between two meshes.
struct MeshErrors {
  double frequency = 0, growth = 0;
};

inline MeshErrors nonMatchingErrors(const std::string& name, const std::string& options,
                                    const std::vector<Complex>& exact) {
  const analysis::Analysis analysis = runCase(name, options);
  EXPECT_FALSE(analysis.model.contact.interfaces.reports.at(0).matching);
  EXPECT_TRUE(analysis.converged());
  const Errors found = errors(exact, eigenvaluesOf(analysis.flutter.segments.at(0).points.at(0)));
  const MeshErrors means{rootMeanSquare(found.frequency), rootMeanSquare(found.growth)};
  print("%s %s: frequency %.2e, growth rate %.2e\n", name.c_str(), options.c_str(), means.frequency,
        means.growth);
  return means;
}

/// Cells of the fine mesh are smaller by `ratio`.
inline void expectOrder(double least, double ratio, const MeshErrors& coarse,
                        const MeshErrors& fine) {
  const double frequency = std::log(coarse.frequency / fine.frequency) / std::log(ratio),
               growth = std::log(coarse.growth / fine.growth) / std::log(ratio);
  print("orders: frequency %.2f, growth rate %.2f\n", frequency, growth);
  EXPECT_GT(frequency, least);
  EXPECT_GT(growth, least);
}

/// The lowest waves of the slabs at f = 0.3, as many across the sliding direction as in the plane.
inline std::vector<Complex> slabWaves(bool convective) {
  const std::size_t count = 6;
  auto all = convective ? exactValues(exact::antiplane::moving03, count)
                        : exactValues(exact::antiplane::friction03, count);
  const auto plane = convective ? exactValues(exact::moving_layers::friction03, count)
                                : exactValues(exact::two_layers::friction03, count);
  all.insert(all.end(), plane.begin(), plane.end());
  return all;
}

/// These waves on slabs that are periodic along x and z. Their meshes differ along both, and nodes
/// at the ends have images. Cells of the fine mesh are smaller by 1.5.
inline void expectSlabOrder(double least, const std::string& slave, bool convective,
                            const std::string& coarse, const std::string& fine) {
  const auto found = [&](const std::string& mesh) {
    return nonMatchingErrors(
        "two_layers_antiplane",
        "-mesh_set depth=0.2," + mesh + " -motion_convective " + (convective ? "on" : "off") +
            " -contact_interface_slave " + slave +
            " -elasticity_mass consistent -flutter_friction 0.3 -steady_uniqueness off"
            " -flutter_method direct -flutter_direct_count 30",
        slabWaves(convective));
  };
  expectOrder(least, 1.5, found(coarse), found(fine));
}

/// Quadratic cells, 2:3 along x and 1:2 along z.
inline void expectFourthOrderOnSlabs(const std::string& slave, bool convective,
                                     const std::string& cells) {
  expectSlabOrder(3.5, slave, convective,
                  cells + ",order=2,nx=8,nx_pad=12,ny_disc=4,ny_pad=2,nz=1,nz_pad=2",
                  cells + ",order=2,nx=12,nx_pad=18,ny_disc=6,ny_pad=3,nz=1,nz_pad=2");
}

}  // namespace squeal::test
