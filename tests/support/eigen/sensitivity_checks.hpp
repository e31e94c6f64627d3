// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Sensitivities of eigenvalues judged by whole runs: finite differences, and the balance of
/// friction work.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "base/system/text.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "steady/steady/prestress.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal::test::sensitivities {

/// Young's modulus, or the nine constants of -material_<group>_engineering_constants, and the
/// density.
struct Material {
  std::vector<double> elastic;
  double density;
};

/// A case or only options, and the values of its parameters without factors.
struct Configuration {
  std::string name = {}, options = {};  ///< no name: only options
  double friction = 0.4;
  std::map<std::string, Material> materials{{"disc", {{1.0}, 1.0}}, {"pad", {{0.4}, 0.6}}};
  /// [parameter] the options of damping, springs, bushings and masses that it multiplies, and their
  /// values
  std::map<std::string, std::vector<std::pair<std::string, std::vector<double>>>> attached = {};
};

/// Options of a body with a factor on all its moduli and another on its density.
inline std::string materialOptions(const std::string& body, const Material& material, double moduli,
                                   double density) {
  const std::string head = " -material_" + body;
  std::vector<double> values = material.elastic;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (i < 3 || i > 5) values[i] *= moduli;  // Poisson's ratios stand between
  std::string list;
  for (double value : values) list += formatted("%s%.17g", list.empty() ? "" : ",", value);
  return head + (values.size() == 1 ? "_young " : "_engineering_constants ") + list + head +
         formatted("_density %.17g", density * material.density);
}

/// Collective. The run with one parameter changed to `value`, a factor except for friction; without
/// a parameter, with sensitivities.
inline analysis::Analysis run(const Configuration& model, const std::string& parameter,
                              double value) {
  std::string options = model.options + formatted(" -flutter_friction %.17g",
                                                  parameter == "friction" ? value : model.friction);
  if (parameter.empty()) options += " -flutter_sensitivities";
  for (const auto* factor : {"speed", "pressure", "damping"})
    if (parameter == factor) options += formatted(" -flutter_%s %.17g", factor, value);
  for (const auto& [body, material] : model.materials)
    options += materialOptions(body, material, parameter == "young_" + body ? value : 1,
                               parameter == "density_" + body ? value : 1);
  for (const auto& [name, list] : model.attached)
    for (const auto& [option, values] : list) {
      options += " -" + option + " ";
      for (std::size_t i = 0; i < values.size(); ++i)
        options +=
            formatted("%s%.17g", i == 0 ? "" : ",", values[i] * (parameter == name ? value : 1));
    }
  return model.name.empty() ? runOptions(options) : runCase(model.name, options);
}

inline Complex nearest(const analysis::Analysis& analysis, Complex s) {
  return matched({s}, eigenvaluesOf(analysis.flutter.segments.at(0).points.at(0)))[0];
}

/// uᴴ A u of a symmetric A; zero for none.
inline double hermitian(Mat a, const pencil::Shape& shape) {
  return a ? form(shape.real, a, shape.real) + form(shape.imaginary, a, shape.imaginary) : 0;
}

/// The energy that friction feeds goes into growth and dissipation:
///   Σ_k work_k = σ + |s|² uᴴCu / (|s|² uᴴMu + uᴴ(K + v² K^R + K_σ)u).
/// Exact for an eigenpair: errors are those of the eigenvector, backward errors of 1e-9 and less
/// times a power of the condition.
inline void expectBalance(const analysis::Analysis& analysis, const pencil::ComplexModes& point) {
  const auto& bodies = analysis.model.bodies;
  const OwnedMat prestress =
      steady::prestressOf(*analysis.model.mesh, bodies, analysis.steady.solutions.at(0));
  for (const auto& shape : point.shapes) {
    const Complex s = point.eigenvalues[shape.index].s;
    const double energy =
        std::norm(s) * hermitian(bodies.mass, shape) + hermitian(bodies.stiffness, shape) +
        point.at.speed * point.at.speed * hermitian(bodies.rotationStiffness, shape) +
        hermitian(prestress, shape);
    const double wanted =
        s.real() + std::norm(s) * point.at.damping * hermitian(bodies.damping, shape) / energy;
    double sums[2] = {0, 0};
    for (double work : shape.frictionWork) sums[0] += work, sums[1] += std::abs(work);
    check(MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
    print(
        "friction adds %.12g to the growth rate, growth and damping take %.12g, magnitudes %.4g\n",
        sums[0], wanted, sums[1]);
    EXPECT_NEAR(sums[0], wanted, 1e-8 * std::abs(s));
    // The work on a neutral mode is round-off, of either sign.
    if (wanted > 1e-8 * std::abs(s)) {
      EXPECT_GT(sums[0], 0);
    }
    // All contributions to the growth rate add up to it [M.87], the shares to 1.
    double growth = 0, strain = 0, kinetic = 0;
    for (const auto& one : shape.components)
      growth += one.growth.sum(), strain += one.strain, kinetic += one.kinetic;
    EXPECT_NEAR(growth, s.real(), 1e-8 * std::abs(s));
    EXPECT_NEAR(strain, 1, 1e-12);
    EXPECT_NEAR(kinetic, 1, 1e-12);
  }
}

/// Central differences with a relative step h of 4e-5: truncation of h²/6 times a third derivative,
/// which for eigenvalues of condition numbers up to 3, the next ones some per cent away, is of the
/// order of 10 to 100 |s|; rounding of the eigenvalues, 1e-13 |s|, over the step. The active set
/// must not change meanwhile.
inline void expectDifferences(const Configuration& model, const analysis::Analysis& analysis) {
  const auto& segment = analysis.flutter.segments.at(0);
  const auto& point = segment.points.at(0);
  EXPECT_GE(point.shapes.size(), 1u);
  EXPECT_EQ(point.sensitivities.size(), point.shapes.size());
  if (point.sensitivities.empty()) return;
  const auto& first = point.sensitivities[0].derivatives;
  EXPECT_EQ(first.size(), analysis.model.mesh
                              ? 4 + 2 * model.materials.size() + model.attached.size()
                              : 3);  // no pressure on matrices from files
  for (std::size_t p = 0; p < first.size(); ++p) {
    const std::string name = first[p].parameter;
    const bool idle = name == "damping" && analysis.model.mesh && !analysis.model.bodies.damping;
    const double value = name == "friction" ? model.friction : 1, h = 4e-5 * value;
    std::vector<analysis::Analysis> runs;
    for (const double sign : {-1.0, 1.0})
      if (!idle) runs.push_back(run(model, name, value + sign * h));
    for (const auto& moved : runs)
      EXPECT_EQ(moved.flutter.segments.at(0).openNodes, segment.openNodes) << name;
    for (std::size_t i = 0; i < point.shapes.size(); ++i) {
      const Complex s = point.eigenvalues[point.shapes[i].index].s,
                    found = point.sensitivities[i].derivatives.at(p).value;
      const Complex wanted = idle ? 0 : (nearest(runs[1], s) - nearest(runs[0], s)) / (2 * h);
      print(
          "s = %.4f%+.4fi, condition %.1f, left backward error %.0e, %s: %.8g%+.8gi, differences "
          "less this %.0e |s|\n",
          s.real(), s.imag(), point.sensitivities[i].condition,
          point.sensitivities[i].leftBackwardError, name.c_str(), found.real(), found.imag(),
          std::abs(wanted - found) / std::abs(s));
      EXPECT_LT(std::abs(found - wanted), 1e-7 * std::abs(s)) << name;
    }
  }
}

}  // namespace squeal::test::sensitivities
