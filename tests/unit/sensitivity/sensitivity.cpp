// Derivatives of eigenvalues against finite differences of whole runs, and the balance of friction
// work.
#include "sensitivity/sensitivity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "pencil/complex_modes.hpp"
#include "petsc/text.hpp"
#include "report/sensitivities.hpp"
#include "sensitivity/left.hpp"
#include "support/case.hpp"
#include "support/model.hpp"
#include "support/spectrum.hpp"

namespace squeal {
namespace {

using test::Complex;

/// Young's modulus, or the nine constants of -material_<group>_engineering_constants, and the
/// density.
struct Material {
  std::vector<double> elastic;
  double density;
};

/// A case, or options alone, and what its parameters are without factors.
struct Configuration {
  std::string name, options;  ///< no name: options alone
  double friction = 0.4;
  std::map<std::string, Material> materials{{"disc", {{1.0}, 1.0}}, {"pad", {{0.4}, 0.6}}};
};

/// Options of a body with a factor on all its moduli and another on its density.
std::string materialOptions(const std::string& body, const Material& material, double moduli,
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
analysis::Analysis run(const Configuration& model, const std::string& parameter, double value) {
  std::string options = model.options + formatted(" -flutter_friction %.17g",
                                                  parameter == "friction" ? value : model.friction);
  if (parameter.empty()) options += " -flutter_sensitivities";
  for (const auto* factor : {"speed", "pressure", "damping"})
    if (parameter == factor) options += formatted(" -flutter_%s %.17g", factor, value);
  for (const auto& [body, material] : model.materials)
    options += materialOptions(body, material, parameter == "young_" + body ? value : 1,
                               parameter == "density_" + body ? value : 1);
  return model.name.empty() ? test::runOptions(options) : test::runCase(model.name, options);
}

Complex nearest(const analysis::Analysis& analysis, Complex s) {
  return test::matched({s}, test::eigenvaluesOf(analysis.segments.at(0).points.at(0)))[0];
}

/// uᴴ A u of a symmetric A; zero for none.
double hermitian(Mat a, const pencil::Shape& shape) {
  return a ? test::form(shape.real, a, shape.real) + test::form(shape.imaginary, a, shape.imaginary)
           : 0;
}

/// The energy that friction feeds goes into growth and dissipation:
///   Σ_k work_k = σ + |s|² uᴴCu / (|s|² uᴴMu + uᴴ(K + v² K^R + K_σ)u).
/// Exact for an eigenpair: errors are those of the eigenvector, backward errors of 1e-9 and less
/// times a power of the condition.
void expectBalance(const analysis::Analysis& analysis, const pencil::ComplexModes& point) {
  const auto& bodies = analysis.bodies;
  OwnedMat prestress;
  if (elasticity::prestressWanted())
    prestress = elasticity::geometricStiffness(*analysis.mesh, analysis.steady.at(0).displacement);
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
    test::print(
        "friction adds %.12g to the growth rate, growth and damping take %.12g, magnitudes %.4g\n",
        sums[0], wanted, sums[1]);
    EXPECT_NEAR(sums[0], wanted, 1e-8 * std::abs(s));
    EXPECT_GT(sums[0], 0);
  }
}

/// Central differences with a relative step h of 4e-5: truncation of h²/6 times a third derivative,
/// which for eigenvalues of condition numbers up to 3, the next ones some per cent away, is of the
/// order of 10 to 100 |s|; rounding of the eigenvalues, 1e-13 |s|, over the step. The active set
/// must not change meanwhile.
void expectDifferences(const Configuration& model, const analysis::Analysis& analysis) {
  const auto& segment = analysis.segments.at(0);
  const auto& point = segment.points.at(0);
  EXPECT_GE(point.shapes.size(), 1u);
  EXPECT_EQ(point.sensitivities.size(), point.shapes.size());
  if (point.sensitivities.empty()) return;
  const auto& first = point.sensitivities[0].derivatives;
  EXPECT_EQ(first.size(), analysis.mesh ? 4 + 2 * model.materials.size()
                                        : 3);  // no pressure on matrices from files
  for (std::size_t p = 0; p < first.size(); ++p) {
    const std::string name = first[p].parameter;
    const bool idle = name == "damping" && analysis.mesh && !analysis.bodies.damping;
    const double value = name == "friction" ? model.friction : 1, h = 4e-5 * value;
    std::vector<analysis::Analysis> runs;
    for (const double sign : {-1.0, 1.0})
      if (!idle) runs.push_back(run(model, name, value + sign * h));
    for (const auto& moved : runs)
      EXPECT_EQ(moved.segments.at(0).openNodes, segment.openNodes) << name;
    for (std::size_t i = 0; i < point.shapes.size(); ++i) {
      const Complex s = point.eigenvalues[point.shapes[i].index].s,
                    found = point.sensitivities[i].derivatives.at(p).value;
      const Complex wanted = idle ? 0 : (nearest(runs[1], s) - nearest(runs[0], s)) / (2 * h);
      test::print(
          "s = %.4f%+.4fi, condition %.1f, left backward error %.0e, %s: %.8g%+.8gi, differences "
          "less this %.0e |s|\n",
          s.real(), s.imag(), point.sensitivities[i].condition,
          point.sensitivities[i].leftBackwardError, name.c_str(), found.real(), found.imag(),
          std::abs(wanted - found) / std::abs(s));
      EXPECT_LT(std::abs(found - wanted), 1e-7 * std::abs(s)) << name;
    }
  }
}

void expectDerivatives(const Configuration& model) {
  const analysis::Analysis analysis = run(model, "", 1);
  expectBalance(analysis, analysis.segments.at(0).points.at(0));
  expectDifferences(model, analysis);
}

TEST(Sensitivity, OfApproximationAWithDampedBodies) {
  expectDerivatives({"two_layers",
                     "-mesh_set nx=8,ny_disc=3,ny_pad=2 -modes_count 40 -flutter_method direct "
                     "-flutter_direct_count 400 "
                     "-material_disc_rayleigh_mass 0.01 -material_pad_rayleigh_stiffness 0.002"});
}

// The full terms of moving matter, a friction law that falls with speed, and prestress: every term
// of the point follows the steady state.
TEST(Sensitivity, OfMovingMatterWithAFrictionLaw) {
  expectDerivatives({"two_layers_moving",
                     "-mesh_set nx=4,ny_disc=2,ny_pad=2,order=2 -modes_count 80 -flutter_method "
                     "direct -flutter_direct_count 400 "
                     "-friction_law exponential -friction_static_ratio 1.5 -friction_decay_speed "
                     "0.05 -elasticity_prestress on "
                     "-flutter_shapes_below 2.4 "
                     "-flutter_shapes_below 2.2"});
}

// Friction damping in a solid that slides at an angle to its waves: it grows with the pressure and
// falls with speed.
TEST(Sensitivity, OfFrictionDamping) {
  expectDerivatives(
      {"two_layers_antiplane",
       "-mesh_set nx=6,ny_disc=2,ny_pad=1,order=1 -modes_count 40 -motion_convective on "
       "-motion_disc_velocity 0.05,0,0.03"});
}

// Equivalent viscous damping follows the moduli, and not the density.
TEST(Sensitivity, OfLossFactors) {
  expectDerivatives({"two_layers",
                     "-mesh_set nx=8,ny_disc=3,ny_pad=2 -modes_count 40 -flutter_method direct "
                     "-flutter_direct_count 400 "
                     "-material_disc_loss_factor 0.004 -material_disc_loss_frequency 0.3 "
                     "-material_pad_loss_factor 0.02 "
                     "-material_pad_loss_frequency 0.5"});
}

// Axes turned in the disc, and with the place in the pad; the steady stress of both joins the
// stiffness.
TEST(Sensitivity, OfOrthotropicBodies) {
  const Configuration model{
      "",
      "-mesh_file meshes/two_layers.geo -mesh_set nx=8,ny_disc=3,ny_pad=2 -motion_disc_velocity "
      "1,0,0 "
      "-constraint_disc_bottom_clamped xy -constraint_pad_top_clamped xy "
      "-constraint_pad_top_displacement 0,-0.01,0 "
      "-constraint_disc_right_image_of disc_left -constraint_pad_right_image_of pad_left "
      "-contact_interface_pad pad_face "
      "-contact_interface_disc disc_face -material_disc_orientation 0.8,0.6,0,-0.6,0.8,0 "
      "-material_pad_cylindrical 1,-4,0,0,0,1 -elasticity_prestress on "
      "-modes_count 40 -flutter_method direct -flutter_direct_count 400",
      0.4,
      {{"disc", {{1.2, 0.9, 1.0, 0.3, 0.25, 0.28, 0.45, 0.4, 0.4}, 1.0}},
       {"pad", {{0.5, 0.3, 0.4, 0.25, 0.2, 0.3, 0.14, 0.15, 0.15}, 0.6}}}};
  expectDerivatives(model);
}

void expectDerivativesOfOpenContact(const Configuration& model) {
  const analysis::Analysis analysis = run(model, "", 1);
  const auto open = analysis.segments.at(0).openNodes;
  EXPECT_GT(open, 0);
  EXPECT_LT(open, analysis.contact.totalNodes);
  expectBalance(analysis, analysis.segments[0].points.at(0));
  expectDifferences(model, analysis);
}

// Blocks that friction lifts off at the leading edge: prestress moves with the gaps of the open
// nodes, what friction does with relative velocities with the forces of the closed ones. First
// across the sliding direction, on a rigid plate,
TEST(Sensitivity, OfOpenContactWithFrictionDamping) {
  expectDerivativesOfOpenContact(
      {"",
       "-mesh_file meshes/layer_slab.geo -mesh_set Lx=0.5,nx=4,ny=4,nz=1,depth=0.3 "
       "-material_layer_poisson 0.3 "
       "-constraint_bottom_clamped xyz -contact_plate_pad top -contact_plate_obstacle_velocity "
       "1,0,0.2 "
       "-contact_plate_obstacle_displacement 0,-0.01,0 -elasticity_prestress on "
       "-modes_count 40 -flutter_method direct -flutter_direct_count 400",
       0.4,
       {{"layer", {{1.0}, 1.0}}}});
}

// then along it, by a law that falls with speed, on a deformable body.
TEST(Sensitivity, OfOpenContactWithAFrictionLaw) {
  expectDerivativesOfOpenContact(
      {"",
       "-mesh_file meshes/two_layers.geo -mesh_set nx=6,ny_disc=3,ny_pad=6,Lx=0.6,h_pad=1 "
       "-material_disc_poisson 0.3 "
       "-material_pad_poisson 0.25 -motion_disc_velocity 0.05,0,0 -constraint_disc_bottom_clamped "
       "xy -constraint_pad_top_clamped "
       "xy "
       "-constraint_pad_top_displacement 0,-0.02,0 -contact_interface_pad pad_face "
       "-contact_interface_disc disc_face "
       "-friction_law exponential -friction_static_ratio 1.5 -friction_decay_speed 0.05 "
       "-elasticity_prestress on "
       "-flutter_shapes_below 2.4 "
       "-modes_count 40 -flutter_method direct -flutter_direct_count 400",
       0.5});
}

// Mass on a belt: s² = −2 ± √(1 − 4f/3), so that 2 s ds/df = ∓ (2/3) / √(…). Beyond the merger at
// 3/4 one of both grows, and is kept.
TEST(Sensitivity, OfTheBeltInClosedForm) {
  for (const double f : {0.8, 1.0, 2.0}) {
    const analysis::Analysis analysis = run({"external", "", f, {}}, "", 1);
    const auto& point = analysis.segments.at(0).points.at(0);
    EXPECT_EQ(point.sensitivities.size(), 1u);
    for (std::size_t i = 0; i < point.sensitivities.size(); ++i) {
      const auto& [condition, separation, error, derivatives] = point.sensitivities[i];
      const Complex root(0, std::sqrt(4 * f / 3 - 1)), s = std::sqrt(root - 2.0),
                                                       wanted = -(2. / 3) / root / (2.0 * s);
      EXPECT_EQ(derivatives.size(), 3u);
      for (const auto& [name, found] : derivatives) {
        test::print("belt at friction %g, condition %.2f, %s: %.12g%+.12gi\n", f, condition,
                    name.c_str(), found.real(), found.imag());
        // Rounding of s and of the vectors, times the square of the condition number at most.
        EXPECT_LT(std::abs(found - (name == "friction" ? wanted : 0)),
                  1e-14 * condition * condition)
            << name;
      }
    }
  }
}

// The damped chain beyond its critical friction, which here counts as much less at higher speed.
TEST(Sensitivity, OfMatricesFromFiles) {
  const Configuration model{"external_chain", "-matrices_friction_speed_exponent 1", 1.2, {}};
  expectDifferences(model, run(model, "", 1));
}

// All moduli by a factor and all densities by another multiply all eigenvalues of undamped bodies
// under approximation A by the root of their quotient: Σ ds/d ln E = s/2, Σ ds/d ln ρ = −s/2. Any
// left vector would say so: this is a test of the matrices of the bodies.
TEST(Sensitivity, OfAllBodiesTogether) {
  const analysis::Analysis analysis =
      run({"two_layers", "-mesh_set nx=12,ny_disc=4,ny_pad=3 -modes_count 60"}, "", 1);
  const auto& point = analysis.segments.at(0).points.at(0);
  EXPECT_EQ(point.sensitivities.size(), 3u);
  expectBalance(analysis, point);
  for (std::size_t i = 0; i < point.sensitivities.size(); ++i) {
    const Complex s = point.eigenvalues[point.shapes[i].index].s;
    Complex moduli = 0, densities = 0;
    for (const auto& [name, value] : point.sensitivities[i].derivatives) {
      if (name.starts_with("young_")) moduli += value;
      if (name.starts_with("density_")) densities += value;
    }
    test::print("reduced: left backward error %.0e, errors of the sums %.0e and %.0e\n",
                point.sensitivities[i].leftBackwardError, std::abs(moduli - 0.5 * s) / std::abs(s),
                std::abs(densities + 0.5 * s) / std::abs(s));
    EXPECT_LT(std::abs(moduli - 0.5 * s), 1e-7 * std::abs(s));
    EXPECT_LT(std::abs(densities + 0.5 * s), 1e-7 * std::abs(s));
  }
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> list;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) list.push_back(line);
  return list;
}

// A row for each mode and parameter, and one without numbers for a mode without derivatives.
TEST(Sensitivity, InTables) {
  analysis::Analysis analysis =
      run({"two_layers", "-mesh_set nx=12,ny_disc=4,ny_pad=3 -modes_count 60"}, "", 1);
  auto& point = analysis.segments.at(0).points.at(0);
  EXPECT_EQ(point.sensitivities.size(), 3u);
  auto& first = point.sensitivities.at(0);
  const auto full = lines(report::sensitivityTable(analysis)),
             work = lines(report::frictionWorkTable(analysis));
  EXPECT_EQ(full.size(), 1 + 3 * first.derivatives.size());
  EXPECT_EQ(work.size(), 1 + 3 * analysis.contact.interfaces.size());
  for (const auto* table : {&full, &work})
    for (const auto& line : *table)
      EXPECT_EQ(std::count(line.begin(), line.end(), ','),
                std::count(table->front().begin(), table->front().end(), ','))
          << line;
  EXPECT_TRUE(first.regular());
  first.condition = 1e6;
  EXPECT_FALSE(first.regular());
  const auto count = first.derivatives.size();
  first.derivatives.clear();
  const auto rest = lines(report::sensitivityTable(analysis));
  EXPECT_EQ(rest.size(), full.size() - count + 1);
  EXPECT_TRUE(rest.at(1).ends_with(",none,,"));
}

}  // namespace
}  // namespace squeal
