// SPDX-License-Identifier: BSD-2-Clause
// Derivatives of critical frictions of two elastic layers and of a brake, against differences of
// two solutions and by their sums.
#include <gtest/gtest.h>
#include <petsclog.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "base/system/text.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

using Runner = std::function<analysis::Analysis(const std::string& changes)>;

/// The damped layers with critical frictions known to 1e-12, so that differences over 2e-4 of a
/// parameter have an error of 1e-8 by round-off, and of as much by the step.
analysis::Analysis layers(const std::string& changes) {
  return runCase("two_layers",
                 "-mesh_set nx=12,ny_disc=4,ny_pad=3 -flutter_friction 0,0.05,0.1 -flutter_band "
                 "0.7 -modes_count 60 -material_disc_rayleigh_mass 0.02 "
                 "-material_pad_rayleigh_mass 0.02 -flutter_critical_tolerance 1e-12 " +
                     changes);
}

/// The disc brake on a very coarse mesh, with terms that follow the steady state: friction turns
/// with the relative velocity, whose size depends on the speed.
analysis::Analysis brake(const std::string& changes) {
  return runCase("disc_brake",
                 "-mesh_set n_pad_theta=2,n_free_theta=6,n_mount=1,n_plate=1,n_inside=1,n_pad_r=2,"
                 "n_hat=1,n_h_ring=1 -modes_count 30 -flutter_friction 0,0.1 -flutter_track on "
                 "-flutter_friction_damping on -material_lining_rayleigh_stiffness 2e-8 "
                 "-flutter_critical_tolerance 1e-12 " +
                     changes);
}

const stability::TrackedLine& lineOf(const analysis::Analysis& analysis) {
  return analysis.flutter.segments.at(0).trackedLines.at(0);
}

/// Compares the derivatives by some parameters with differences.
void expectDifferences(const Runner& run, std::size_t least,
                       const std::map<std::string, std::pair<std::string, double>>& parameters) {
  constexpr double step = 1e-4;
  const analysis::Analysis middle = run("-flutter_sensitivities");
  const auto& line = lineOf(middle);
  std::size_t compared = 0;
  for (const auto& [name, option] : parameters) {
    const auto frictions = [&](double factor) {
      std::vector<double> found;
      const analysis::Analysis changed =
          run(formatted("-%s %.17g", option.first.c_str(), factor * option.second));
      for (const auto& critical : lineOf(changed).criticals) found.push_back(critical.friction);
      return found;
    };
    const auto more = frictions(1 + step), less = frictions(1 - step);
    ASSERT_EQ(more.size(), line.criticals.size());
    ASSERT_EQ(less.size(), line.criticals.size());
    for (std::size_t i = 0; i < more.size(); ++i) {
      const auto& derivatives = line.criticalModes[i].derivatives;
      const auto found =
          std::ranges::find(derivatives, name, &pencil::CriticalDerivative::parameter);
      if (line.criticals[i].slope == 0) {
        EXPECT_TRUE(derivatives.empty());
        continue;
      }
      ASSERT_NE(found, derivatives.end()) << name << " at " << line.criticals[i].friction;
      const double wanted = (more[i] - less[i]) / (2 * step);
      print("%s at friction %.8f: %.9g, by differences %.9g\n", name.c_str(),
            line.criticals[i].friction, found->value, wanted);
      EXPECT_NEAR(found->value, wanted, 1e-5 * std::max(std::abs(wanted), 1e-2));
      ++compared;
    }
  }
  EXPECT_GE(compared, least * parameters.size());
}

// Hopf points: the layers are damped.
TEST(CriticalSensitivity, OfDampedLayers) {
  expectDifferences(layers, 2,
                    {{"young_disc", {"material_disc_young", 1.0}},
                     {"density_pad", {"material_pad_density", 0.6}},
                     {"damping_pad", {"material_pad_rayleigh_mass", 0.02}}});
}

TEST(CriticalSensitivity, OfTermsThatFollowTheSteadyState) {
  expectDifferences(brake, 1,
                    {{"young_lining", {"material_lining_young", 1.5e9}},
                     {"speed", {"flutter_speed", 1}},
                     {"pressure", {"flutter_pressure", 1}}});
}

/// Returns the number of nonlinear solutions since the start of PETSc's log.
int solutionsSoFar() {
  PetscLogEvent event = -1;
  PetscStageLog log = nullptr;
  check(PetscLogEventGetId("SNESSolve", &event));
  check(PetscLogGetStageLog(&log));
  int count = 0;
  for (int stage = 0; stage < log->numStages && event >= 0; ++stage) {
    PetscEventPerfInfo info;
    check(PetscLogEventGetPerfInfo(stage, event, &info));
    count += info.count;
  }
  return count;
}

// The derivatives of a critical friction take the steady state that its mode needs.
TEST(CriticalSensitivity, TakesNoSteadyStateOfItsOwn) {
  check(PetscLogDefaultBegin());
  const auto solutions = [](const std::string& changes) {
    const int before = solutionsSoFar();
    brake(changes);
    return solutionsSoFar() - before;
  };
  const int without = solutions("");
  EXPECT_GT(without, 2);  // those of the points of the sweep
  EXPECT_EQ(solutions("-flutter_sensitivities"), without);
}

// All moduli and all densities by one factor change no eigenvalue of damping that is proportional
// to the mass: the derivatives add up to zero.
TEST(CriticalSensitivity, OfAllBodiesTogether) {
  const analysis::Analysis analysis = layers("-flutter_sensitivities");
  int count = 0;
  for (const auto& mode : lineOf(analysis).criticalModes) {
    double sum = 0, size = 0;
    for (const auto& [parameter, value] : mode.derivatives)
      if (parameter.starts_with("young_") || parameter.starts_with("density_"))
        sum += value, size += std::abs(value);
    if (mode.derivatives.empty()) continue;
    ++count;
    EXPECT_LT(std::abs(sum), 1e-8 * size);
    // The free modes of the band are most of the mode, and no share exceeds the whole.
    double shares = 0;
    for (const auto& part : mode.participations) shares += part.energy;
    EXPECT_GT(shares, 0.9);
    EXPECT_LT(shares, 1 + 1e-9);
  }
  EXPECT_GE(count, 2);
}

}  // namespace
}  // namespace squeal::test
