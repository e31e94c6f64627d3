#include "model/material/material.hpp"

#include <cmath>
#include <set>

#include "base/options/options.hpp"
#include "base/petsc/check.hpp"
#include "base/system/text.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::material {

using mesh::cross;
using mesh::length;
using mesh::unit;

namespace {

const RealOption youngOption("elasticity", "material_<group>_young", std::nullopt, "Pa", positive,
                             "Young's modulus of the body");
const RealOption poissonOption("elasticity", "material_<group>_poisson", std::nullopt, "",
                               {-1, 0.5, true, true}, "Poisson's ratio of the body");
const RealListOption engineeringOption(
    "elasticity", "material_<group>_engineering_constants", "", "Pa", anyReal,
    "orthotropic body, instead of _young and _poisson: E1,E2,E3,nu12,nu13,nu23,G12,G13,G23 with "
    "nu_ij the contraction along j per "
    "stretch along i, nu_ij/Ei = nu_ji/Ej");
const RealListOption transverseOption(
    "elasticity", "material_<group>_transverse", "", "Pa", anyReal,
    "transversely isotropic body, instead of _young and _poisson: Ep,Et,nup,nupt,Gt; Ep, nup in "
    "the plane 1-2 of isotropy, Et "
    "along "
    "axis 3, nupt the contraction along 3 per stretch in the plane, Gt the shear modulus between 3 "
    "and the plane");
const RealListOption orientationOption(
    "elasticity", "material_<group>_orientation", "1,0,0,0,1,0", "", anyReal,
    "axes of an orthotropic body: a1,a2,a3,b1,b2,b3 with axis 1 along a, b in the plane 1-2");
const RealListOption cylindricalOption(
    "elasticity", "material_<group>_cylindrical", "", "m", anyReal,
    "instead of _orientation: ox,oy,oz,kx,ky,kz, a point and the direction of the cylinder's axis; "
    "axis 1 radial, 2 tangential, 3 along k");
const RealOption densityOption("elasticity", "material_<group>_density", std::nullopt, "kg/m3",
                               positive, "mass density of the body");
const RealOption rayleighMassOption("elasticity", "material_<group>_rayleigh_mass", 0.0, "1/s",
                                    nonNegative,
                                    "alpha of the damping matrix C = alpha M + beta K of the body");
const RealOption rayleighStiffnessOption(
    "elasticity", "material_<group>_rayleigh_stiffness", 0.0, "s", nonNegative,
    "beta of the damping matrix C = alpha M + beta K of the body");
const RealOption lossFactorOption("elasticity", "material_<group>_loss_factor", 0.0, "",
                                  nonNegative,
                                  "loss factor eta as equivalent viscous damping C = eta / (2 pi "
                                  "f) K, exact at the frequency f = "
                                  "_loss_frequency alone: larger above it, smaller below");
const RealOption lossFrequencyOption("elasticity", "material_<group>_loss_frequency", std::nullopt,
                                     "Hz", positive, "the frequency at which _loss_factor holds");
const ChoiceOption planeOption("elasticity", "elasticity_plane", {"strain", "stress"}, "strain",
                               "plane problems: plane strain or plane stress");

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
                " numbers are wanted, " + std::to_string(values.size()) + " are given");
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
  const std::string rule = brokenRule(c);
  if (!rule.empty())
    throw Error("option -" + option.fullName(body) +
                ": the strain energy is not positive for every strain: " + rule +
                (transverse ? " (E1 = E2 = Ep, E3 = Et, nu12 = nup, nu13 = nu23 = nupt, G12 = Ep / "
                              "2(1 + nup), G13 = G23 = Gt)"
                            : ""));
  return c;
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
    throw Error("option -" + orientationOption.fullName(body) +
                ": the two directions must not be parallel nor zero");
  return axesOf(a, b);
}

/// Returns the cylindrical axes at x: radial, tangential, and along k.
Axes cylindricalAxes(const Point& x, const Point& origin, const Point& k) {
  Point tangential = cross(k, mesh::minus(x, origin));
  if (!(length(tangential) > 0))
    tangential =
        std::abs(k[0]) < 0.9 ? cross(k, {1, 0, 0}) : cross(k, {0, 1, 0});  // on the axis: any
  const Point two = unit(tangential);
  return {cross(two, k), two, k};
}

/// Returns the law with cylindrical axes at each point. Throws Error if the direction is zero, or
/// is not normal to the plane of a plane problem.
Law cylindricalLaw(const Hooke& solid, const std::string& body, int dimension, bool planeStress) {
  const auto v = numbers(cylindricalOption, body, 6);
  const Point origin{v[0], v[1], v[2]}, direction{v[3], v[4], v[5]};
  if (!(length(direction) > 0))
    throw Error("option -" + cylindricalOption.fullName(body) + ": the axis has no length");
  const Point k = unit(direction);
  if (dimension == 2 && std::hypot(k[0], k[1]) > 1e-9)
    throw Error("option -" + cylindricalOption.fullName(body) +
                ": the axis of a plane problem must be 0,0,1");
  return {{}, [=](const Point& x) {
            const Hooke turned = rotated(solid, cylindricalAxes(x, origin, k));
            return dimension == 2 ? inPlane(turned, planeStress) : turned;
          }};
}

/// Returns the law that the options ask for. Throws Error if options of different laws are given.
Law readLaw(const std::string& body, int dimension, bool planeStress) {
  const auto exclude = [&](const Option& one, const Option& other) {
    if (one.given(body) && other.given(body))
      throw Error("options -" + one.fullName(body) + " and -" + other.fullName(body) +
                  " exclude each other");
  };
  for (const Option* elastic : std::vector<const Option*>{&engineeringOption, &transverseOption})
    exclude(*elastic, youngOption), exclude(*elastic, poissonOption);
  exclude(engineeringOption, transverseOption);
  exclude(orientationOption, cylindricalOption);
  if (!engineeringOption.given(body) && !transverseOption.given(body)) {
    for (const auto* option : {&orientationOption, &cylindricalOption})
      if (option->given(body))
        throw Error("option -" + option->fullName(body) + " needs -" +
                    engineeringOption.fullName(body) + " or -" + transverseOption.fullName(body));
    return {isotropic(youngOption.get(body), poissonOption.get(body), dimension, planeStress), {}};
  }
  const Hooke solid = orthotropic(constants(body));
  if (cylindricalOption.given(body)) return cylindricalLaw(solid, body, dimension, planeStress);
  const Hooke turned = rotated(solid, orientation(body));
  if (dimension == 3) return {turned, {}};
  if (!mirrorSymmetric(turned))
    throw Error("option -" + orientationOption.fullName(body) +
                ": one axis of the material must be normal to the plane of the mesh");
  return {inPlane(turned, planeStress), {}};
}

/// Returns Material::poisson.
double poissonRatio(const std::string& body, int dimension, bool planeStress) {
  if (dimension == 2 && planeStress) return 0;
  if (!engineeringOption.given(body) && !transverseOption.given(body))
    return poissonOption.get(body);
  const Hooke solid = orthotropic(constants(body));
  double bulk = 0, shear = 0;
  for (int i = 0; i < 3; ++i) {
    shear += solid(3 + i, 3 + i) / 3;
    for (int j = 0; j < 3; ++j) bulk += solid(i, j) / 9;
  }
  return (3 * bulk - 2 * shear) / (6 * bulk + 2 * shear);
}

Material readMaterial(const std::string& body, int dimension, bool planeStress) {
  return {readLaw(body, dimension, planeStress), densityOption.get(body),
          rayleighMassOption.get(body), stiffnessDamping(body),
          poissonRatio(body, dimension, planeStress)};
}

}  // namespace

std::vector<Material> readMaterials(const mesh::Mesh& mesh) {
  const bool planeStress = planeOption.get() == "stress";
  std::vector<Material> materials;
  for (const auto& body : mesh.bodies)
    materials.push_back(readMaterial(body, mesh.dimension, planeStress));
  return materials;
}

std::vector<mesh::GroupRequest> materialGroups() {
  std::set<std::string> groups;
  for (const Option* option :
       std::vector<const Option*>{&youngOption, &engineeringOption, &transverseOption})
    for (const auto& group : option->subjects()) groups.insert(group);
  for (const Option* option : std::vector<const Option*>{
           &poissonOption, &densityOption, &rayleighMassOption, &rayleighStiffnessOption,
           &lossFactorOption, &lossFrequencyOption, &orientationOption, &cylindricalOption})
    for (const auto& group : option->subjects())
      if (!groups.count(group))
        throw Error("option -" + youngOption.fullName(group) +
                    " (or _engineering_constants, _transverse) is missing, but -" +
                    option->fullName(group) + " is given");
  if (groups.empty())
    throw Error("no body: " + howToGiveMaterials() + " for each volume group of the mesh");
  for (const auto& group : groups) readMaterial(group, 3, false);  // checks before the mesh is read
  std::vector<mesh::GroupRequest> requests;
  for (const auto& group : groups) requests.push_back({group, "-" + youngOption.fullName(group)});
  return requests;
}

std::string howToGiveMaterials() { return "give -material_<group>_young, _poisson and _density"; }

}  // namespace squeal::material
