// SPDX-License-Identifier: BSD-2-Clause
#include "model/material/settings.hpp"

#include <cmath>
#include <set>

#include "base/options/options.hpp"
#include "base/petsc/check.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::material {

using mesh::cross;
using mesh::length;
using mesh::unit;

namespace {

const RealOption youngOption("material", "material_<group>_young", std::nullopt, "Pa", positive,
                             "Young's modulus of the body");
const RealOption poissonOption("material", "material_<group>_poisson", std::nullopt, "",
                               {-1, 0.5, true, true}, "Poisson's ratio of the body");
const RealListOption engineeringOption(
    "material", "material_<group>_engineering_constants", "", "Pa", anyReal,
    "constants of an orthotropic body, instead of _young and _poisson: "
    "E1,E2,E3,nu12,nu13,nu23,G12,G13,G23; nu_ij is the contraction along j per stretch along i, "
    "nu_ij/Ei = nu_ji/Ej");
const RealListOption transverseOption(
    "material", "material_<group>_transverse", "", "Pa", anyReal,
    "constants of a transversely isotropic body, instead of _young and _poisson: "
    "Ep,Et,nup,nupt,Gt; Ep and nup in the isotropic plane 1-2, Et along axis 3, nupt the "
    "contraction along 3 per stretch in the plane, Gt the shear modulus between 3 and the plane");
const RealListOption orthotropicOption(
    "material", "material_<group>_orthotropic", "", "Pa", anyReal,
    "stiffness matrix of an orthotropic body, instead of _young and _poisson, in the order of "
    "Abaqus: D1111, D1122, D2222, D1133, D2233, D3333, D1212, D1313, D2323; the last three are "
    "shear moduli");
const RealListOption anisotropicOption(
    "material", "material_<group>_anisotropic", "", "Pa", anyReal,
    "stiffness matrix of an anisotropic body, instead of _young and _poisson, in the order of "
    "Abaqus: D1111, D1122, D2222, D1133, D2233, D3333, D1112, D2212, D3312, D1212, D1113, D2213, "
    "D3313, D1213, D1313, D1123, D2223, D3323, D1223, D1323, D2323; for engineering shear strains");
const RealListOption orientationOption(
    "material", "material_<group>_orientation", "1,0,0,0,1,0", "", anyReal,
    "axes of an orthotropic or anisotropic body: a1,a2,a3,b1,b2,b3 with axis 1 along a and b in "
    "the plane 1-2");
const RealListOption cylindricalOption(
    "material", "material_<group>_cylindrical", "", "m", anyReal,
    "axis of a body with cylindrical axes, instead of _orientation: ox,oy,oz,kx,ky,kz, a "
    "point and a direction; axis 1 radial, 2 tangential, 3 along k");
const RealOption densityOption("material", "material_<group>_density", std::nullopt, "kg/m3",
                               positive, "mass density of the body");
const RealOption rayleighMassOption("material", "material_<group>_rayleigh_mass", 0.0, "1/s",
                                    nonNegative,
                                    "alpha of the damping matrix C = alpha M + beta K of the body");
const RealOption rayleighStiffnessOption(
    "material", "material_<group>_rayleigh_stiffness", 0.0, "s", nonNegative,
    "beta of the damping matrix C = alpha M + beta K of the body");
const RealOption lossFactorOption(
    "material", "material_<group>_loss_factor", 0.0, "", nonNegative,
    "loss factor eta, as equivalent viscous damping C = eta / (2 pi f) K; exact only at the "
    "frequency f = _loss_frequency, larger above it and smaller below");
const RealOption lossFrequencyOption("material", "material_<group>_loss_frequency", std::nullopt,
                                     "Hz", positive, "frequency at which _loss_factor applies");
const ChoiceOption integrationOption(
    "material", "material_<group>_integration", {"full", "reduced"}, "full",
    "quadrature of the stiffness; reduced: 2x2x2 points (C3D20R), only for hex20 cells; mass and "
    "loads always have full integration");
const ChoiceOption planeOption("elasticity", "elasticity_plane", {"strain", "stress"}, "strain",
                               "assumption of plane problems: plane strain or plane stress");

/// Returns β + η / (2π f), s [M.5].
double stiffnessDamping(const std::string& body) {
  const double beta = rayleighStiffnessOption.get(body);
  if (lossFactorOption.given(body))
    return beta + lossFactorOption.get(body) / (2 * M_PI * lossFrequencyOption.get(body));
  if (lossFrequencyOption.given(body))
    throw Error("option -" + lossFrequencyOption.fullName(body) + " needs -" +
                lossFactorOption.fullName(body));
  return beta;
}

/// Returns the numbers of the option. Throws Error unless there are `count`.
std::vector<double> numbers(const RealListOption& option, const std::string& body,
                            std::size_t count) {
  auto values = option.get(body);
  if (values.size() != count)
    throw Error("option -" + option.fullName(body) + ": " + std::to_string(count) +
                " numbers are required, " + std::to_string(values.size()) + " are given");
  return values;
}

/// Returns the constants of an orthotropic or transversely isotropic body.
EngineeringConstants constants(const std::string& body) {
  const bool transverse = transverseOption.given(body);
  const auto& option = transverse ? transverseOption : engineeringOption;
  const auto v = numbers(option, body, transverse ? 5 : 9);
  EngineeringConstants c{};
  if (transverse)
    c = {v[0], v[0], v[1], v[2], v[3], v[3], v[0] / (2 * (1 + v[2])), v[4], v[4]};
  else
    c = {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7], v[8]};
  const std::string rule = violatedRule(c);
  if (!rule.empty())
    throw Error("option -" + option.fullName(body) +
                ": the strain energy is not positive for every strain: " + rule +
                (transverse ? " (E1 = E2 = Ep, E3 = Et, nu12 = nup, nu13 = nu23 = nupt, G12 = Ep / "
                              "2(1 + nup), G13 = G23 = Gt)"
                            : ""));
  return c;
}

/// The options of anisotropic laws.
std::vector<const RealListOption*> anisotropicLaws() {
  return {&engineeringOption, &transverseOption, &orthotropicOption, &anisotropicOption};
}

/// Returns the stiffness of an orthotropic or anisotropic body from its matrix.
Hooke stiffnessMatrix(const std::string& body, const RealListOption& option, std::size_t count) {
  const Hooke stiffness = anisotropic(numbers(option, body, count));
  const std::string rule = violatedRule(stiffness);
  if (!rule.empty())
    throw Error("option -" + option.fullName(body) +
                ": the strain energy is not positive for every strain: " + rule);
  return stiffness;
}

/// Returns the anisotropic law that the option gives, without axes.
Anisotropy anisotropy(const std::string& body, const RealListOption& option) {
  const bool general = &option == &anisotropicOption;
  Anisotropy law{{}, {}, general, "-" + option.fullName(body)};
  if (general || &option == &orthotropicOption)
    law.stiffness = stiffnessMatrix(body, option, general ? 21 : 9);
  else
    law.stiffness = orthotropic(constants(body));
  return law;
}

/// Returns axes with axis 1 along a and with b in the plane 1-2.
Axes axesOf(const Point& a, const Point& b) {
  const Point one = unit(a), three = unit(cross(a, b));
  return {one, cross(three, one), three};
}

Axes orientation(const std::string& body) {
  const auto v = numbers(orientationOption, body, 6);
  const Point a{v[0], v[1], v[2]}, b{v[3], v[4], v[5]};
  if (!(length(cross(a, b)) > 1e-9 * length(a) * length(b)))
    throw Error("option " + orientationName(body) +
                ": the two directions must be neither parallel nor zero");
  return axesOf(a, b);
}

CylinderAxis cylinderAxis(const std::string& body) {
  const auto v = numbers(cylindricalOption, body, 6);
  const Point origin{v[0], v[1], v[2]}, direction{v[3], v[4], v[5]};
  if (!(length(direction) > 0))
    throw Error("option " + cylindricalName(body) + ": the axis has no length");
  return {origin, unit(direction)};
}

/// Throws Error if both options are given.
void exclude(const std::string& body, const Option& one, const Option& other) {
  if (one.given(body) && other.given(body))
    throw Error("options -" + one.fullName(body) + " and -" + other.fullName(body) +
                " exclude each other");
}

/// Throws Error if options of different laws are given.
void rejectSecondLaw(const std::string& body) {
  const auto laws = anisotropicLaws();
  for (std::size_t i = 0; i < laws.size(); ++i) {
    exclude(body, *laws[i], youngOption);
    exclude(body, *laws[i], poissonOption);
    for (std::size_t j = i + 1; j < laws.size(); ++j) exclude(body, *laws[i], *laws[j]);
  }
  exclude(body, orientationOption, cylindricalOption);
}

/// Reads the elastic law of a body.
void readLaw(const std::string& body, BodySettings& settings) {
  rejectSecondLaw(body);
  for (const auto* law : anisotropicLaws()) {
    if (!law->given(body)) continue;
    settings.anisotropy = anisotropy(body, *law);
    if (cylindricalOption.given(body))
      settings.anisotropy->axes = cylinderAxis(body);
    else
      settings.anisotropy->axes = orientation(body);
    return;
  }
  for (const auto* option : {&orientationOption, &cylindricalOption})
    if (option->given(body))
      throw Error("option -" + option->fullName(body) + " needs -" +
                  engineeringOption.fullName(body) + ", _transverse, _orthotropic or _anisotropic");
  settings.poisson = poissonOption.get(body);
  settings.young = youngOption.get(body);
}

BodySettings bodyGiven(const std::string& body) {
  BodySettings settings;
  readLaw(body, settings);
  settings.density = densityOption.get(body);
  settings.massDamping = rayleighMassOption.get(body);
  settings.stiffnessDamping = stiffnessDamping(body);
  settings.reducedIntegration = integrationOption.get(body) == "reduced";
  return settings;
}

/// Returns the groups with an elastic law. Throws Error if there is none, and for a group with
/// other options but no law.
std::set<std::string> groupsGiven() {
  std::set<std::string> groups;
  for (const auto& group : youngOption.subjects()) groups.insert(group);
  for (const auto* law : anisotropicLaws())
    for (const auto& group : law->subjects()) groups.insert(group);
  for (const Option* option :
       std::vector<const Option*>{&poissonOption, &densityOption, &rayleighMassOption,
                                  &rayleighStiffnessOption, &lossFactorOption, &lossFrequencyOption,
                                  &orientationOption, &cylindricalOption, &integrationOption})
    for (const auto& group : option->subjects())
      if (!groups.count(group))
        throw Error("option -" + youngOption.fullName(group) +
                    " (or _engineering_constants, _transverse, _orthotropic, _anisotropic) is "
                    "missing, but -" +
                    option->fullName(group) + " is given");
  if (groups.empty())
    throw Error("no body: " + howToGiveMaterials() + " for each volume group of the mesh");
  return groups;
}

}  // namespace

Settings Settings::given() {
  Settings settings;
  for (const auto& group : groupsGiven()) settings.bodies[group] = bodyGiven(group);
  settings.planeStress = planeOption.get() == "stress";
  return settings;
}

std::vector<mesh::GroupRequest> groupRequests(const Settings& settings) {
  std::vector<mesh::GroupRequest> requests;
  for (const auto& [group, body] : settings.bodies)
    requests.push_back({group, "-" + youngOption.fullName(group)});
  return requests;
}

std::string howToGiveMaterials() { return "give -material_<group>_young, _poisson and _density"; }

std::string orientationName(const std::string& body) {
  return "-" + orientationOption.fullName(body);
}

std::string cylindricalName(const std::string& body) {
  return "-" + cylindricalOption.fullName(body);
}

std::string integrationName(const std::string& body) {
  return "-" + integrationOption.fullName(body);
}

}  // namespace squeal::material
