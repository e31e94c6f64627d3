// SPDX-License-Identifier: BSD-2-Clause
// Problems of matrices from files: what they mean, and what cannot be a problem of vibration is
// said. The formats: matrices_*.cpp.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "base/system/text.hpp"
#include "problem/matrixfile/matrix_market.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/model/model.hpp"
#include "support/problem/matrix_files.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

/// A matrix given by its rows.
using Rows = std::vector<std::vector<double>>;

std::string writeRows(const std::string& name, const Rows& rows) {
  matrixfile::Entries entries(static_cast<long long>(rows.size()),
                              static_cast<long long>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows.size(); ++j)
      entries.add(static_cast<long long>(i), static_cast<long long>(j), rows[i][j]);
  return written(name, [&](const auto& path) { matrixfile::writeMatrixMarket(path, entries); });
}

/// Options for M, K and f K_f.
std::string problem(const std::string& name, const Rows& mass, const Rows& stiffness,
                    const Rows& friction) {
  return "-matrices_m_role mass -matrices_m_file " + writeRows(name + "_m.mtx", mass) +
         " -matrices_k_role stiffness -matrices_k_file " + writeRows(name + "_k.mtx", stiffness) +
         " -matrices_kf_role stiffness -matrices_kf_friction_exponent 1 -matrices_kf_file " +
         writeRows(name + "_kf.mtx", friction) + " ";
}

const Rows unit{{1, 0}, {0, 1}}, belt{{2, 1}, {1, 2}}, drag{{0, -4. / 3}, {0, 0}};

// Hoffmann et al. 2002: s² = −2 ± √(1 − 4f/3).
TEST(Matrices, BeltMergesAtItsCriticalFriction) {
  const std::string options = problem("belt", unit, belt, drag);
  for (const double f : {0.0, 0.3, 0.75 * (1 - 1e-6), 0.75 * (1 + 1e-6), 2.0}) {
    const analysis::Analysis analysis =
        runOptions(options + "-flutter_friction " + formatted("%.17g", f));
    std::vector<Complex> exact;
    for (const double sign : {-1.0, 1.0}) {
      const Complex s = std::sqrt(-2.0 + sign * std::sqrt(Complex(1 - 4 * f / 3)));
      exact.push_back(s.imag() < 0 ? -s : s);
    }
    const auto& point = analysis.flutter.segments.at(0).points.at(0);
    // At 1e-6 from the merger rounding of 1e-16 grows by 1e3.
    EXPECT_LT(worst(errors(exact, eigenvaluesOf(point)).relative), 1e-12) << f;
    EXPECT_EQ(point.unstableCount(), f > 0.75 ? 1 : 0) << f;
    EXPECT_EQ(analysis.flutter.segments.at(0).modes.angularFrequency.size(),
              2U);  // of -modes_count 200
  }
}

TEST(Matrices, FactorsAndExponents) {
  // 3 · (M/3) and the friction entered as f² v / 10 at f = 0.5, v = 20: f K_f.
  const std::string third = writeRows("third.mtx", {{1. / 3, 0}, {0, 1. / 3}});
  const std::string options = problem("factors", unit, belt, drag) + "-flutter_friction 0.5 ";
  const auto plain = eigenvaluesOf(runOptions(options).flutter.segments.at(0).points.at(0));
  const auto scaled =
      eigenvaluesOf(runOptions(options + "-matrices_m_factor 3 -matrices_m_file " + third +
                               " -matrices_kf_friction_exponent 2 -matrices_kf_speed_exponent 1 "
                               "-matrices_kf_factor 0.1 -flutter_speed 20")
                        .flutter.segments.at(0)
                        .points.at(0));
  EXPECT_LT(worst(errors(plain, scaled).relative), 1e-14);
}

// Friction inside the stiffness, as a program exports it: the same problem, on the modes of the
// symmetric part.
TEST(Matrices, FrictionInsideTheStiffness) {
  const auto apart = runOptions(problem("apart", unit, belt, drag) + "-flutter_friction 1")
                         .flutter.segments.at(0)
                         .points.at(0)
                         .eigenvalues;
  const std::string inside = problem("inside", unit, {{2, 1 - 4. / 3}, {1, 2}}, {{0, 0}, {0, 0}});
  const analysis::Analysis analysis = runOptions(inside + "-flutter_friction 1");
  const auto& point = analysis.flutter.segments.at(0).points.at(0);
  ASSERT_EQ(point.eigenvalues.size(), apart.size());
  for (std::size_t i = 0; i < apart.size(); ++i)
    EXPECT_LT(std::abs(point.eigenvalues[i].s - apart[i].s), 1e-14);
}

// A massless point between two springs k1 = 2 and k2 = 3 that carry a mass of 1.2 kg, with friction
// f in the row of the mass: s² = −(k1 k2/(k1 + k2) − f)/m. The massless unknown has no mode.
TEST(Matrices, UnknownsWithoutMassFollow) {
  const Rows mass{{0, 0}, {0, 1.2}}, springs{{5, -3}, {-3, 3}}, friction{{0, 0}, {0, -1}};
  const std::string options = problem("massless", mass, springs, friction);
  for (const double f : {0.0, 0.3}) {
    const auto analysis = runOptions(options + "-flutter_friction " + formatted("%.17g", f));
    const auto found = eigenvaluesOf(analysis.flutter.segments.at(0).points.at(0));
    ASSERT_EQ(found.size(), 1U);
    EXPECT_LT(std::abs(found[0] - Complex(0, std::sqrt((1.2 - f) / 1.2))), 1e-14) << f;
  }
  EXPECT_TRUE(contains(errorOf([&] { runOptions(options + "-modes_count 2"); }),
                       "the problem has only 1 unknowns with mass"));
}

// Written matrices of a mesh are read again with the same eigenvalues, also if a reference node
// between two bushings, and the layer nodes of open contact, have no mass.
TEST(Matrices, ExportsWithMasslessNodesAreRead) {
  const std::string bar =
      "-mesh_file meshes/beam.geo -mesh_set nx=3,ny=1,nz=1 " +
      material("beam", "2e11", "0.3", "8000") +
      "-reference_end_centre_of tip -coupling_end_reference end -coupling_end_nodes tip "
      "-reference_mid_position 2,0,0 -bushing_a_from end -bushing_a_to mid "
      "-bushing_a_stiffness 1e7,1e7,1e7,1e7,1e7,1e7 -bushing_b_from mid "
      "-bushing_b_stiffness 1e7,1e7,1e7,1e7,1e7,1e7 -flutter_friction 0 -modes_count 8 ";
  const std::string lifted =
      "-mesh_file meshes/layer.geo -mesh_set nx=4,ny=2 " + material("layer", "1", "0.3", "1") +
      "-constraint_bottom_clamped xy -contact_plate_pad top "
      "-contact_plate_obstacle_velocity 1,0,0 -contact_plate_stiffness 10 "
      "-contact_plate_obstacle_displacement 0,-0.001,0 -load_left_pressure 0.1 "
      "-flutter_friction 0.2 -flutter_friction_damping off -modes_count 8 ";
  int number = 0;
  for (const std::string& options : {bar, lifted}) {
    const std::string folder = SQUEAL_OUTPUT_DIR "/massless_" + std::to_string(number++);
    const auto written = runOptions(options + "-report_matrices " + folder);
    EXPECT_EQ(written.steady.solutions.at(0).openNodes > 0, options == lifted);
    clearOptions();
    insertFile(PETSC_COMM_WORLD, folder + "/options.txt");
    insert(settingsOfText("-quiet"));
    const auto read = analysis::analyse(PETSC_COMM_WORLD, analysis::Settings::given());
    const auto one = eigenvaluesOf(written.flutter.segments.at(0).points.at(0)),
               other = eigenvaluesOf(read.flutter.segments.at(0).points.at(0));
    ASSERT_EQ(one.size(), other.size()) << options;
    EXPECT_LT(worst(errors(one, other).relative), 1e-9) << options;  // tolerance of the corrections
  }
}

TEST(Matrices, WhatIsNoVibrationIsSaid) {
  const Rows zero{{0, 0}, {0, 0}};
  const std::vector<std::tuple<std::string, Rows, Rows, std::string>> cases{
      {"loose",
       unit,
       {{1, -1}, {-1, 1}},
       "the stiffness 'k' is not positive definite: 0 negative and 1 zero"},
      {"indefinite",
       unit,
       {{1, 2}, {2, 1}},
       "the stiffness 'k' is not positive definite: 1 negative and 0 zero"},
      {"none", unit, zero, "the stiffness 'k' is zero"},
      {"singular",
       {{1, 1}, {1, 1}},
       belt,
       "the mass 'm' is not positive definite: 0 negative and 1 zero"},
      {"massless_loose",
       {{1, 0}, {0, 0}},
       {{1, 0}, {0, 0}},
       "the stiffness 'k' is not positive definite: 0 negative and 1 zero"},
      {"negative",
       {{1, 0}, {0, -1}},
       belt,
       "the mass 'm' is not positive definite: 1 negative and 0 zero"},
      {"unsymmetric", {{1, 0.1}, {0, 1}}, belt, "the mass 'm' is not symmetric"},
      {"sizes", {{1}}, belt, "1 rows, but matrix"},
  };
  for (const auto& [name, mass, stiffness, message] : cases) {
    const std::string options = problem(name, mass, stiffness, zero);
    const std::string error = errorOf([&] { runOptions(options); });
    EXPECT_TRUE(contains(error, message)) << name << ": " << error;
  }
}

TEST(Matrices, OptionsThatMakeNoProblem) {
  const std::string options = problem("options", unit, belt, drag),
                    mass = writeRows("single.mtx", unit);
  const std::vector<std::pair<std::string, std::string>> cases{
      {options + "-matrices_m_role weight", "option -matrices_m_role weight"},
      {"-matrices_m_file " + mass, "option -matrices_m_role"},
      {"-matrices_m_role mass -matrices_m_file " + mass, "there is no stiffness matrix"},
      {"-matrices_m_role stiffness -matrices_m_file " + mass, "there is no mass matrix"},
      {options + "-matrices_other_factor 2", "there is no -matrices_other_file"},
      {options + "-mesh_file meshes/layer.geo", "not both"},
      {options + "-steady_uniqueness on", "not both"},
      {options + "-flutter_speed 1,2", "no matrix has -matrices_<name>_speed_exponent"},
      {options + "-flutter_pressure 2", "-flutter_pressure"},
  };
  for (const auto& [given, message] : cases) {
    const std::string error = errorOf([&, &given = given] { runOptions(given); });
    EXPECT_TRUE(contains(error, message)) << given << ": " << error;
  }
}

/// Masses in a row, each free to move along and across a belt and held by springs of its own,
/// joined to the next in both directions. The spring behind mass `at` along the belt has the
/// stiffness `stiff`, those to the ground are `ground` times the usual.
struct Chain {
  std::size_t masses = 80;
  double ground = 1, stiff = 1;
  std::size_t at = 35;

  std::string options(const std::string& name) const {
    const std::size_t n = 2 * masses;
    Rows mass(n, std::vector<double>(n, 0)), stiffness = mass, friction = mass;
    const auto spring = [&](std::size_t i, std::size_t j, double k) {
      stiffness[i][i] += k, stiffness[j][j] += k, stiffness[i][j] -= k, stiffness[j][i] -= k;
    };
    for (std::size_t x = 0, y = 1; x < n; x += 2, y += 2) {
      mass[x][x] = mass[y][y] = 1 + 0.3 * std::sin(static_cast<double>(x));
      stiffness[x][x] += ground;
      stiffness[y][y] += 1.1 * ground;
      spring(x, y, 1. / 7);
      friction[x][y] = -0.4;
      if (x + 2 == n) break;
      spring(x, x + 2, (x / 2 == at ? stiff : 1) / 3);
      spring(y, y + 2, 1. / 3);
    }
    return problem(name, mass, stiffness, friction) + "-flutter_friction 0.3 ";
  }
};

// A spring 1e6 times the others leaves the low eigenvalues right. LAPACK on all unknowns errs by ε
// ‖M⁻¹K‖ = 1e-10 of eigenvalues of size one; so far may the two be apart.
TEST(Matrices, AStiffSpringDoesNotSpoilTheOthers) {
  Chain chain;
  chain.stiff = 1e6;
  chain.ground = 0.1;  // frequencies apart from each other
  const std::string options = chain.options("stiff");
  const analysis::Analysis reduced = runOptions(options + "-modes_count 20");
  const analysis::Analysis direct =
      runOptions(options + "-flutter_method direct -flutter_direct_count 160");
  const auto& found = reduced.flutter.segments.at(0).points.at(0).eigenvalues;
  const auto exact = matched(eigenvaluesOf(reduced.flutter.segments.at(0).points.at(0)),
                             eigenvaluesOf(direct.flutter.segments.at(0).points.at(0)));
  EXPECT_GE(found.size(), 8U);
  for (std::size_t i = 0; i < found.size(); ++i) {
    // The backward error, one of ‖K‖ and so of the spring, would say 1e-12; the estimate says how
    // much of s is right.
    EXPECT_TRUE(found[i].certified);
    EXPECT_LT(std::abs(found[i].s - exact[i]),
              std::max(found[i].errorEstimate(), 1e-9) * std::abs(exact[i]))
        << i;
  }
  // All modes of a smaller one at once, by LAPACK, against block Lanczos or SLEPc.
  chain.masses = 30, chain.at = 15;
  const std::string smaller = chain.options("stiff_small") + "-flutter_friction 0 ";
  const auto all =
      runOptions(smaller + "-modes_count 60").flutter.segments.at(0).modes.angularFrequency;
  const auto some = runOptions(smaller + "-modes_count 10 -modes_solver eps -modes_tolerance 1e-12")
                        .flutter.segments.at(0)
                        .modes.angularFrequency;
  for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(all[i], some[i], 1e-10 * some[i]) << i;
}

// Loose to rounding, and nearly so: a third of each spring cannot be written without rounding, so
// that K has no exact zero pivot.
TEST(Matrices, ALooseChainIsFound) {
  Chain chain;
  chain.ground = 0;
  const std::string loose = errorOf([&] { runOptions(chain.options("chain_loose")); });
  EXPECT_TRUE(contains(loose, "not positive definite: 0 negative and 1 zero")) << loose;
  chain.ground = 2e-14;  // no zero pivot, but an eigenvalue of which rounding leaves one digit
  const std::string nearly = errorOf([&] { runOptions(chain.options("chain_nearly")); });
  EXPECT_TRUE(contains(nearly, "not positive within round-off")) << nearly;
}

TEST(Matrices, ExportOfTheLayerComesBack) {
  const std::string changes = "-modes_count 60 -mesh_set nx=18,ny=6 -flutter_friction 0,0.4 ",
                    folder = SQUEAL_OUTPUT_DIR "/layer_";
  for (const std::string format : {"petsc", "matrix_market"}) {
    const analysis::Analysis mesh =
        runCase("layer", changes + "-report_matrices " + folder + format +
                             " -report_matrices_format " + format);
    const analysis::Analysis files =
        runOptions("-options_file " + folder + format + "/options.txt");
    for (std::size_t p = 0; p < 2; ++p) {
      const auto wanted = eigenvaluesOf(mesh.flutter.segments.at(0).points.at(p)),
                 found = eigenvaluesOf(files.flutter.segments.at(0).points.at(p));
      ASSERT_EQ(wanted.size(), found.size());
      EXPECT_GT(wanted.size(), 20U);
      // Both to a backward error of 1e-9 in the band; the sums of the pencil are the same to
      // rounding.
      EXPECT_LT(worst(errors(wanted, found).relative), 1e-10) << format << " " << p;
    }
  }
}

TEST(Matrices, ExportOfAPointAlone) {
  // Friction damping belongs to the steady state of one point.
  const std::string changes =
      "-mesh_set nx=4,ny_disc=2,ny_pad=2 -modes_count 20 -flutter_band 0.3 "
      "-report_matrices " SQUEAL_OUTPUT_DIR "/antiplane ";
  for (const std::string frictions : {"0.2,0.4", "0,0.4"}) {  // at friction 0 there is none of it
    const std::string error = errorOf(
        [&] { runCase("two_layers_antiplane", changes + "-flutter_friction " + frictions); });
    EXPECT_TRUE(contains(error, "-report_matrices") && contains(error, "one -flutter_friction"))
        << error;
  }
  const analysis::Analysis mesh =
      runCase("two_layers_antiplane", changes + "-flutter_friction 0.4");
  const analysis::Analysis files =
      runOptions("-options_file " SQUEAL_OUTPUT_DIR "/antiplane/options.txt");
  const auto wanted = eigenvaluesOf(mesh.flutter.segments.at(0).points.at(0)),
             found = eigenvaluesOf(files.flutter.segments.at(0).points.at(0));
  ASSERT_EQ(wanted.size(), found.size());
  EXPECT_GT(wanted.size(), 4U);
  EXPECT_LT(worst(errors(wanted, found).relative), 1e-10);
}

}  // namespace
}  // namespace squeal::test
