// Derivatives of eigenvalues against finite differences of whole runs, and the balance of friction work.
#include "flutter/sensitivity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "flutter/left.hpp"
#include "petsc/text.hpp"
#include "support/case.hpp"
#include "support/model.hpp"
#include "support/spectrum.hpp"

namespace squeal {
namespace {

using test::Complex;

/// A case and what its parameters are without factors.
struct Configuration {
  std::string name, options;
  double friction = 0.4, speed = 1;
  std::map<std::string, std::array<double, 2>> materials;  // [body] modulus, density
  double pressed = 0;                                      // displacement that presses the pad
  std::string pressedComponents;                           // with %.17g in its place
};

/// Collective. The run with one parameter changed to `value`, a factor except for friction and speed.
Analysis run(const Configuration& model, const std::string& parameter, double value) {
  const auto factor = [&](const std::string& name) { return parameter == name ? value : 1.0; };
  std::string options = model.options;
  options += formatted(" -flutter_friction %.17g -flutter_speed %.17g", parameter == "friction" ? value : model.friction,
                             parameter == "speed" ? value : model.speed);
  for (const auto& [body, constants] : model.materials)
    options += formatted(" -material_%s_young %.17g -material_%s_density %.17g", body.c_str(),
                               factor("young_" + body) * constants[0], body.c_str(), factor("density_" + body) * constants[1]);
  options += " -constraint_pad_top_displacement " + formatted(model.pressedComponents.c_str(), factor("pressure") * model.pressed);
  test::setCase(model.name, options);
  return analyse(PETSC_COMM_WORLD);
}

double valueOf(const Configuration& model, const std::string& parameter) {
  return parameter == "friction" ? model.friction : parameter == "speed" ? model.speed : 1;
}

Complex nearest(const Analysis& analysis, Complex s) {
  return test::matched({s}, test::eigenvaluesOf(analysis.segments.at(0).points.at(0)))[0];
}

/// uᴴ A u of a symmetric A; zero for none.
double hermitian(Mat a, const flutter::Shape& shape) {
  return a ? test::form(shape.real, a, shape.real) + test::form(shape.imaginary, a, shape.imaginary) : 0;
}

/// The energy that friction feeds goes into growth and dissipation:
///   Σ_k work_k = σ + |s|² uᴴCu / (|s|² uᴴMu + uᴴ(K + v² K^R + K_σ)u).
/// Exact for an eigenpair: errors are those of the eigenvector, backward errors of 1e-9 and less times a power of the condition.
void expectBalance(const Analysis& analysis, const flutter::FrictionPoint& point) {
  const auto& bodies = analysis.bodies;
  OwnedMat prestress;
  if (elasticity::prestressWanted())
    prestress = elasticity::geometricStiffness(*analysis.mesh, analysis.steady.at(0).displacement);
  for (const auto& shape : point.shapes) {
    const Complex s = point.eigenvalues[shape.index].s;
    const double energy = std::norm(s) * hermitian(bodies.mass, shape) + hermitian(bodies.stiffness, shape) +
                          point.at.speed * point.at.speed * hermitian(bodies.rotationStiffness, shape) + hermitian(prestress, shape);
    const double wanted = s.real() + std::norm(s) * hermitian(bodies.damping, shape) / energy;
    double sums[2] = {0, 0};
    for (double work : shape.frictionWork) sums[0] += work, sums[1] += std::abs(work);
    check(MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
    test::print("friction adds %.12g to the growth rate, growth and damping take %.12g, magnitudes %.4g\n", sums[0], wanted, sums[1]);
    EXPECT_NEAR(sums[0], wanted, 1e-8 * std::abs(s));
    EXPECT_GT(sums[0], 0);
  }
}

/// Five-point differences with a step of 1e-3: truncation of fourth order, some 1e-12 times a power of the condition number of the
/// eigenvalue; rounding of the eigenvalues, 1e-13 |s|, over the step.
void expectDerivatives(const Configuration& model, double tolerance) {
  const Analysis analysis = run(model, "", 1);
  const auto& point = analysis.segments.at(0).points.at(0);
  EXPECT_GE(point.shapes.size(), 1u);
  expectBalance(analysis, point);
  EXPECT_EQ(point.sensitivities.size(), point.shapes.size());
  if (point.sensitivities.empty()) return;
  for (const auto& derivative : point.sensitivities[0].derivatives) {
    const double value = valueOf(model, derivative.parameter), h = 1e-3 * value;
    std::vector<Analysis> runs;
    for (const double steps : {-2.0, -1.0, 1.0, 2.0}) runs.push_back(run(model, derivative.parameter, value + steps * h));
    for (std::size_t i = 0; i < point.shapes.size(); ++i) {
      const Complex s = point.eigenvalues[point.shapes[i].index].s;
      const auto& sensitivity = point.sensitivities[i];
      Complex found = 0;
      for (const auto& candidate : sensitivity.derivatives)
        if (candidate.parameter == derivative.parameter) found = candidate.value;
      const Complex wanted = (nearest(runs[0], s) - 8.0 * nearest(runs[1], s) + 8.0 * nearest(runs[2], s) - nearest(runs[3], s)) / (12 * h);
      test::print("%s, s = %.4f%+.4fi, condition %.1f, left backward error %.0e, %s: %.8g%+.8gi, by differences %.8g%+.8gi\n",
                  model.name.c_str(), s.real(), s.imag(), sensitivity.condition, sensitivity.leftBackwardError,
                  derivative.parameter.c_str(), found.real(), found.imag(), wanted.real(), wanted.imag());
      EXPECT_LT(std::abs(found - wanted), tolerance * std::abs(s)) << derivative.parameter;
    }
  }
}

Configuration layers(const std::string& name, const std::string& options) {
  Configuration model{name, options + " -flutter_sensitivities", 0.4, 1, {{"disc", {1.0, 1.0}}, {"pad", {0.4, 0.6}}}, -0.01, "0,%.17g"};
  return model;
}

const char* const coarse = "-mesh_set nx=12,ny_disc=4,ny_pad=3 -modes_count 60";

TEST(Sensitivity, OfApproximationAWithDampedBodies) {
  expectDerivatives(layers("two_layers", std::string(coarse) +
                                             " -flutter_method direct -flutter_direct_count 400 -material_disc_rayleigh_mass 0.01 "
                                             "-material_pad_rayleigh_stiffness 0.002"),
                    1e-7);
}

// The full terms of moving matter, a friction law that falls with speed, and prestress: every term of the point follows the steady state.
TEST(Sensitivity, OfMovingMatterWithAFrictionLaw) {
  expectDerivatives(layers("two_layers_moving",
                           "-mesh_set nx=6,ny_disc=2,ny_pad=2,order=2 -flutter_method direct -flutter_direct_count 400 "
                           "-modes_count 40 -friction_law exponential -friction_static_ratio 1.5 -friction_decay_speed 0.05 "
                           "-elasticity_prestress on -flutter_shapes_below 2.2"),
                    1e-7);
}

// Friction damping in a solid that slides at an angle to its waves: it grows with the pressure and falls with speed.
TEST(Sensitivity, OfFrictionDamping) {
  Configuration model = layers("two_layers_antiplane", "-mesh_set nx=6,ny_disc=2,ny_pad=1,order=1 -modes_count 40 -motion_convective on "
 "-motion_disc_velocity 0.05,0,0.03");
  model.pressed = -0.02, model.pressedComponents = "0,%.17g,0";
  expectDerivatives(model, 1e-7);
}

}  // namespace
}  // namespace squeal
