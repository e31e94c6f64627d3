// SPDX-License-Identifier: BSD-2-Clause
#include "run/audit/units.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/linalg/lu.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/interfaces/algebra.hpp"
#include "model/mortar/face.hpp"

namespace squeal::audit {
namespace {

// Solids have densities from 50 (foam) to 25,000 kg/m³ and wave speeds from 10 (soft rubber) to
// 20,000 m/s (diamond). Their moduli are at most 2e6 MPa, so a larger number is not in MPa.
struct Range {
  double low, high;
  bool contains(double x) const { return x >= low && x <= high; }
};
constexpr Range densityKg{50, 25'000};                  // kg/m³
constexpr Range densityGram{0.05, 25};                  // g/cm³
constexpr Range densityKgMm{5e-8, 2.5e-5};              // kg/mm³
constexpr Range densityTonne{5e-11, 2.5e-8};            // t/mm³
constexpr Range waveSpeed{10, 20'000};                  // m/s
constexpr double largestMpa = 2e6;                      // MPa
constexpr double largestSize = 5, smallestSize = 1e-3;  // of a brake, m
constexpr double smallestPressure = 100;                // Pa, a thousandth of the atmosphere's
constexpr double largestGravity = 1000;                 // m/s², a hundred times that of the Earth
constexpr double largestStrain = 0.1;                   // p/E

/// The numbers of a material that the rules judge.
struct Elastic {
  std::string group, name;  ///< the volume group, and its name in messages
  double young, density, speed;

  bool isSi() const {
    return young > largestMpa && densityKg.contains(density) && waveSpeed.contains(speed);
  }
  bool isTonneMm() const { return young <= largestMpa && densityTonne.contains(density); }
};

/// Returns the Young's moduli along the axes of the material: 1/S_ii with S = D⁻¹.
Moduli moduliAlongAxes(const material::Hooke& law) {
  linalg::DenseMatrix matrix(6, 6);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) matrix(i, j) = law(i, j);
  const linalg::Lu<double> factors(std::move(matrix));
  Moduli moduli{INFINITY, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<double> compliance(6, 0.0);
    compliance[i] = 1;
    factors.solve(compliance);
    moduli.least = std::min(moduli.least, 1 / compliance[i]);
    moduli.largest = std::max(moduli.largest, 1 / compliance[i]);
  }
  return moduli;
}

/// Adds a finding if √(E/ρ) is a speed that no solid has.
void judgeSpeed(const Elastic& body, Findings& findings) {
  const std::string head = formatted(
      "%s: a modulus of %.4g Pa and a density of %.4g kg/m3 give a wave speed "
      "sqrt(E/rho) of %.3g m/s, ",
      body.name.c_str(), body.young, body.density, body.speed);
  const std::string option = "-material_" + body.group;
  const auto add = [&](const std::string& text, const std::string& remedy) {
    findings.push_back({Kind::units, Severity::warning, head + text, remedy});
  };
  if (densityKg.contains(body.density) && body.speed < waveSpeed.low)
    return add("below that of all solids; the modulus looks like MPa or GPa",
               "give " + option + "_young (or its engineering constants) in Pa");
  if (body.young <= largestMpa || body.speed <= waveSpeed.high) return;
  const char* unit = densityGram.contains(body.density)    ? "; the density looks like g/cm3"
                     : densityKgMm.contains(body.density)  ? "; the density looks like kg/mm3"
                     : densityTonne.contains(body.density) ? "; the density looks like t/mm3"
                                                           : "";
  add(std::string("above that of all solids") + unit,
      "give " + option + "_density in kg/m3, or all values in mm, t, s, N and MPa");
}

std::string sizeText(const BodyMass& total, double size, int dimension) {
  return formatted("%.4g m from %s to %s, with a mass of %.4g %s", size,
                   interfaces::text(total.low).c_str(), interfaces::text(total.high).c_str(),
                   total.mass, dimension == 2 ? "kg/m" : "kg");
}

/// Adds a finding if the lengths do not belong to the moduli and densities of all bodies.
void judgeSize(const Subject& model, const std::vector<Elastic>& bodies, const BodyMass& total,
               Findings& findings) {
  double size = 0;
  for (std::size_t d = 0; d < 3; ++d) size = std::max(size, total.high[d] - total.low[d]);
  const auto add = [&](const std::string& text, const std::string& remedy) {
    findings.push_back(
        {Kind::units, Severity::warning,
         "the model extends over " + sizeText(total, size, model.mesh.dimension) + text, remedy});
  };
  if (std::ranges::all_of(bodies, &Elastic::isSi)) {
    if (size > largestSize)
      add("; its moduli are in Pa and its densities in kg/m3, but its lengths look like mm",
          "give -mesh_scale 0.001, or all values in mm, t, s, N and MPa");
    else if (size < smallestSize)
      add("; its moduli are in Pa and its densities in kg/m3, so it is smaller than a brake",
          "check -mesh_scale and the unit of the mesh file: lengths are in m");
  } else if (std::ranges::all_of(bodies, &Elastic::isTonneMm) && size < 1) {
    add("; its moduli are in MPa and its densities in t/mm3, but its lengths look like m",
        "give -mesh_scale 1000, or all values in SI units");
  }
}

/// Collective. Adds a finding for a pressure that does not belong to the moduli of its bodies.
void judgePressure(const Subject& model, const std::vector<Elastic>& bodies,
                   const std::vector<Moduli>& moduli, Findings& findings) {
  for (const auto& [surface, pressure] : model.bodies.settings.pressure) {
    if (pressure == 0 ||
        std::ranges::find(model.mesh.surfaces, surface) == model.mesh.surfaces.end())
      continue;
    std::vector<int> loaded(bodies.size(), 0);
    for (const auto& face : mortar::facesOf(model.mesh, surface)) loaded.at(face.material) = 1;
    mpi::reduce<int>(model.mesh.comm, loaded, MPI_MAX);
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (!loaded[b]) continue;
      const std::string head = formatted("the pressure of %.4g Pa on '%s' of %s", pressure,
                                         surface.c_str(), bodies[b].name.c_str());
      const std::string option = elasticity::pressureName(surface);
      if (std::abs(pressure) > largestStrain * moduli[b].least)
        findings.push_back({Kind::units, Severity::warning,
                            head + formatted(" is %.3g times its modulus of %.4g Pa",
                                             std::abs(pressure) / moduli[b].least, moduli[b].least),
                            "give " + option + " in the unit of the moduli"});
      else if (bodies[b].isSi() && std::abs(pressure) < smallestPressure)
        findings.push_back({Kind::units, Severity::warning,
                            head + formatted(" is small for its modulus of %.4g Pa; it looks like "
                                             "MPa or bar",
                                             moduli[b].least),
                            "give " + option + " in Pa"});
    }
  }
}

/// Adds a finding for a gravity that does not belong to the moduli and densities of all bodies.
void judgeGravity(const Subject& model, const std::vector<Elastic>& bodies, Findings& findings) {
  const double gravity = mesh::length(model.bodies.settings.gravity.in(model.mesh.dimension));
  const auto add = [&](const char* text, const char* remedy) {
    findings.push_back({Kind::units, Severity::warning,
                        formatted("the gravity of %.4g m/s2 looks like %s", gravity, text),
                        remedy});
  };
  if (std::ranges::all_of(bodies, &Elastic::isSi) && gravity > largestGravity)
    add("mm/s2, while the moduli are in Pa and the densities in kg/m3",
        "give -load_gravity in m/s2");
  if (std::ranges::all_of(bodies, &Elastic::isTonneMm) && gravity > 0 && gravity < largestGravity)
    add("m/s2, while the moduli are in MPa and the densities in t/mm3",
        "give -load_gravity in mm/s2");
}

}  // namespace

std::vector<Moduli> moduliOf(const Subject& model) {
  std::vector<Moduli> moduli;
  for (const auto& group : model.mesh.materialGroups) {
    const auto& material = model.materials.bodies.at(group.name);
    moduli.push_back({material.young, material.young});
    if (material.anisotropy) moduli.back() = moduliAlongAxes(material.anisotropy->stiffness);
  }
  return moduli;
}

std::vector<double> waveSpeeds(const Subject& model) {
  const auto moduli = moduliOf(model);
  std::vector<double> speeds(model.mesh.bodies.size(), 0.0);
  for (std::size_t m = 0; m < moduli.size(); ++m) {
    double& speed = speeds[model.mesh.materialGroups[m].body];
    speed = std::max(speed, std::sqrt(moduli[m].largest / model.bodies.materials[m].density));
  }
  return speeds;
}

Findings unitFindings(const Subject& model, const std::vector<BodyMass>& masses) {
  const auto moduli = moduliOf(model);
  std::vector<Elastic> bodies;
  for (std::size_t m = 0; m < moduli.size(); ++m) {
    const double density = model.bodies.materials[m].density;
    bodies.push_back({model.mesh.materialGroups[m].name, model.mesh.materialText(m),
                      moduli[m].largest, density, std::sqrt(moduli[m].largest / density)});
  }
  Findings findings;
  for (const auto& body : bodies) judgeSpeed(body, findings);
  judgeSize(model, bodies, totalOf(masses), findings);
  judgePressure(model, bodies, moduli, findings);
  judgeGravity(model, bodies, findings);
  return findings;
}

}  // namespace squeal::audit
