// SPDX-License-Identifier: BSD-2-Clause
#include "model/material/settings.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/options/options.hpp"
#include "base/petsc/check.hpp"
#include "base/system/text.hpp"
#include "model/material/section_lists.hpp"
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
    "axes of an orthotropic or anisotropic body: a1,a2,a3,b1,b2,b3; axis 1 is along the vector a, "
    "and the vector b lies in the plane 1-2");
const RealListOption cylindricalOption(
    "material", "material_<group>_cylindrical", "", "m", anyReal,
    "axis of cylindrical material axes, instead of _orientation: ox,oy,oz,kx,ky,kz, with a point o "
    "and a direction k; axis 1 is radial, 2 tangential, 3 along k");
const TextOption frameOption("material", "material_<group>_frame", "",
                             "name of the -frame whose axes x, y, z are the material axes 1, 2, 3, "
                             "instead of _orientation and _cylindrical");
const RealOption densityOption("material", "material_<group>_density", std::nullopt, "kg/m3",
                               positive, "mass density of the body");
const RealOption rayleighMassOption(
    "material", "material_<group>_rayleigh_mass", 0.0, "1/s", nonNegative,
    "factor alpha in the damping matrix C = alpha M + beta K of the body");
const RealOption rayleighStiffnessOption(
    "material", "material_<group>_rayleigh_stiffness", 0.0, "s", nonNegative,
    "factor beta in the damping matrix C = alpha M + beta K of the body");
const RealOption lossFactorOption(
    "material", "material_<group>_loss_factor", 0.0, "", nonNegative,
    "loss factor eta, represented by viscous damping C = eta / (2 pi f) K; the loss factor is eta "
    "at the frequency f = _loss_frequency, larger above f and smaller below");
const RealOption lossFrequencyOption(
    "material", "material_<group>_loss_frequency", std::nullopt, "Hz", positive,
    "frequency at which the loss factor has the value _loss_factor");
const ChoiceOption integrationOption(
    "material", "material_<group>_integration", {"full", "reduced"}, "full",
    "quadrature of the stiffness; reduced: 2x2x2 points, as in C3D20R, only for hex20 cells; mass "
    "and loads are always integrated fully");
const ChoiceOption planeOption("elasticity", "elasticity_plane", {"strain", "stress"}, "strain",
                               "assumption of plane problems: plane strain or plane stress");

/// Returns the numbers of the option. Throws Error unless there are `count`.
std::vector<double> numbers(const RealListOption& option, const std::string& body,
                            std::size_t count) {
  auto values = option.get(body);
  if (values.size() != count)
    throw Error("option " + option.dashed(body) + ": " + std::to_string(count) +
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
    throw Error("option " + option.dashed(body) +
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
    throw Error("option " + option.dashed(body) +
                ": the strain energy is not positive for every strain: " + rule);
  return stiffness;
}

/// Returns the anisotropic law that the option gives, without axes.
Anisotropy anisotropy(const std::string& body, const RealListOption& option) {
  const bool general = &option == &anisotropicOption;
  Anisotropy law{{}, {}, general, option.dashed(body), {}};
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
    throw Error("option " + orientationOption.dashed(body) +
                ": the two directions must be neither parallel nor zero");
  return axesOf(a, b);
}

CylinderAxis cylinderAxis(const std::string& body) {
  const auto v = numbers(cylindricalOption, body, 6);
  const Point origin{v[0], v[1], v[2]}, direction{v[3], v[4], v[5]};
  if (!(length(direction) > 0))
    throw Error("option " + cylindricalOption.dashed(body) + ": the axis has no length");
  return {origin, unit(direction)};
}

/// Throws Error if both options are given.
void exclude(const std::string& body, const Option& one, const Option& other) {
  if (one.given(body) && other.given(body))
    throw Error("options " + one.dashed(body) + " and " + other.dashed(body) +
                " exclude each other");
}

/// The options of the axes.
std::vector<const Option*> axesOptions() {
  return {&orientationOption, &cylindricalOption, &frameOption};
}

/// All options of a material.
std::vector<const Option*> materialOptions() {
  std::vector<const Option*> options{
      &youngOption,         &poissonOption,           &densityOption,
      &rayleighMassOption,  &rayleighStiffnessOption, &lossFactorOption,
      &lossFrequencyOption, &integrationOption};
  for (const auto& more :
       {axesOptions(), std::vector<const Option*>{&engineeringOption, &transverseOption,
                                                  &orthotropicOption, &anisotropicOption}})
    options.insert(options.end(), more.begin(), more.end());
  return options;
}

[[noreturn]] void rejectAxes(const Option& option, const std::string& group) {
  throw Error("option " + option.dashed(group) + " needs " + engineeringOption.dashed(group) +
              ", _transverse, _orthotropic or _anisotropic");
}

/// Throws Error if options of different laws, or of different axes, are given.
void rejectSecondLaw(const std::string& group) {
  const auto laws = anisotropicLaws();
  for (std::size_t i = 0; i < laws.size(); ++i) {
    exclude(group, *laws[i], youngOption);
    exclude(group, *laws[i], poissonOption);
    for (std::size_t j = i + 1; j < laws.size(); ++j) exclude(group, *laws[i], *laws[j]);
  }
  const auto axes = axesOptions();
  for (std::size_t i = 0; i < axes.size(); ++i)
    for (std::size_t j = i + 1; j < axes.size(); ++j) exclude(group, *axes[i], *axes[j]);
}

/// Reads the material of a volume group. An option that is not given for a section is that of its
/// body. The law is inherited as a whole, except that an isotropic one may take one of its two
/// constants from the body; the axes are inherited as a whole.
class MaterialReader {
 public:
  /// `body` is the body of a section, or the group itself. Adds the options that are read to
  /// `used`.
  MaterialReader(std::string group, std::string body, std::set<std::string>& used)
      : group_(std::move(group)), body_(std::move(body)), used_(used) {}
  BodySettings read();

 private:
  /// Returns the group if it has the option, and otherwise the body if that has it.
  std::string of(const Option& option);
  bool given(const Option& option) { return option.given(of(option)); }
  void readLaw(BodySettings& settings);
  void readAxes(Anisotropy& law);
  double stiffnessDamping();

  std::string group_, body_;
  std::set<std::string>& used_;
};

std::string MaterialReader::of(const Option& option) {
  const std::string& subject = !option.given(group_) && option.given(body_) ? body_ : group_;
  used_.insert(option.fullName(subject));
  return subject;
}

void MaterialReader::readAxes(Anisotropy& law) {
  const Option* chosen = &orientationOption;
  std::string subject = group_;
  for (const std::string& candidate : {body_, group_})  // those of the group replace the body's
    for (const auto* option : axesOptions())
      if (option->given(candidate)) chosen = option, subject = candidate;
  used_.insert(chosen->fullName(subject));
  law.axesOption = chosen->dashed(subject);
  if (chosen == &frameOption)
    law.axes = FrameName{frameOption.get(subject)};
  else if (chosen == &cylindricalOption)
    law.axes = cylinderAxis(subject);
  else
    law.axes = orientation(subject);
}

void MaterialReader::readLaw(BodySettings& settings) {
  rejectSecondLaw(group_);
  const auto lawOf = [](const std::string& group) -> const RealListOption* {
    for (const auto* law : anisotropicLaws())
      if (law->given(group)) return law;
    return nullptr;
  };
  const bool isotropic = youngOption.given(group_) || poissonOption.given(group_);
  const bool ofGroup = isotropic || lawOf(group_);
  const std::string& subject = ofGroup ? group_ : body_;
  if (const auto* law = lawOf(subject)) {
    used_.insert(law->fullName(subject));
    settings.anisotropy = anisotropy(subject, *law);
    readAxes(*settings.anisotropy);
    return;
  }
  for (const auto* option : axesOptions())
    if (option->given(group_)) rejectAxes(*option, group_);
  if (!ofGroup && body_ != group_ && !youngOption.given(body_) && !poissonOption.given(body_))
    throw Error("option " + youngOption.dashed(group_) +
                " (or _engineering_constants, _transverse, _orthotropic, _anisotropic) is missing: "
                "neither the section nor its body '" +
                body_ + "' has a law");
  settings.poisson = poissonOption.get(of(poissonOption));
  settings.young = youngOption.get(of(youngOption));
}

/// Returns β + η / (2π f), s [M.5].
double MaterialReader::stiffnessDamping() {
  const double beta = rayleighStiffnessOption.get(of(rayleighStiffnessOption));
  if (given(lossFactorOption))
    return beta + lossFactorOption.get(of(lossFactorOption)) /
                      (2 * M_PI * lossFrequencyOption.get(of(lossFrequencyOption)));
  if (given(lossFrequencyOption))
    throw Error("option " + lossFrequencyOption.dashed(of(lossFrequencyOption)) + " needs " +
                lossFactorOption.dashed(group_));
  return beta;
}

BodySettings MaterialReader::read() {
  BodySettings settings;
  readLaw(settings);
  settings.density = densityOption.get(of(densityOption));
  settings.massDamping = rayleighMassOption.get(of(rayleighMassOption));
  settings.stiffnessDamping = stiffnessDamping();
  settings.reducedIntegration = integrationOption.get(of(integrationOption)) == "reduced";
  return settings;
}

/// Returns the volume groups with an elastic law, sections included. Throws Error for a group with
/// other options but no law.
std::set<std::string> groupsGiven(const std::map<std::string, std::vector<std::string>>& sections) {
  std::set<std::string> groups;
  for (const auto& group : youngOption.subjects()) groups.insert(group);
  for (const auto* law : anisotropicLaws())
    for (const auto& group : law->subjects()) groups.insert(group);
  for (const auto& [body, list] : sections) groups.insert(list.begin(), list.end());
  for (const Option* option : materialOptions())
    for (const auto& group : option->subjects())
      if (!groups.count(group) && !sections.contains(group))
        throw Error("option " + youngOption.dashed(group) +
                    " (or _engineering_constants, _transverse, _orthotropic, _anisotropic) is "
                    "missing, but " +
                    option->dashed(group) + " is given");
  for (const auto& [body, list] : sections) groups.erase(body);
  if (groups.empty())
    throw Error("no body: " + howToGiveMaterials() + " for each volume group of the mesh");
  return groups;
}

/// Returns the material of a group outside the lists of sections. An error names the lists of
/// sections, where its name may be misspelt.
BodySettings alone(const std::string& group,
                   const std::map<std::string, std::vector<std::string>>& sections,
                   std::set<std::string>& used) try {
  return MaterialReader(group, group, used).read();
} catch (const Error& error) {
  std::string lists;
  for (const auto& [body, list] : sections)
    lists += "; '" + group + "' is not in " + sectionsName(body) + " " + joined(list, ",");
  throw Error(error.what() + lists);
}

/// Reads the assumption of plane problems.
void readPlane(Settings& settings) {
  settings.planeStress = planeOption.get() == "stress";
  if (planeOption.given()) settings.planeOption = planeOption.dashed();
}

/// Throws Error for an option of a body that all of its sections replace.
void rejectIdle(const Settings& settings, const std::set<std::string>& used) {
  for (const auto& [body, sections] : settings.sections) {
    rejectSecondLaw(body);
    const bool anisotropic = std::ranges::any_of(sections, [&](const auto& section) {
      return settings.bodies.at(section).anisotropy.has_value();
    });
    for (const Option* option : materialOptions()) {
      if (!option->given(body) || used.contains(option->fullName(body))) continue;
      if (const auto axes = axesOptions(); !anisotropic && std::ranges::count(axes, option))
        rejectAxes(*option, body);
      throw Error("option " + option->dashed(body) + ": no section of '" + body +
                  "' uses it, as all have their own; remove it");
    }
  }
}

}  // namespace

Settings Settings::given() {
  Settings settings;
  settings.sections = sectionsGiven();
  std::map<std::string, std::string> bodyOf;
  for (const auto& [body, sections] : settings.sections)
    for (const auto& section : sections) bodyOf[section] = body;
  std::set<std::string> used;
  for (const auto& group : groupsGiven(settings.sections)) {
    const auto body = bodyOf.find(group);
    if (body != bodyOf.end())
      settings.bodies[group] = MaterialReader(group, body->second, used).read();
    else
      settings.bodies[group] = alone(group, settings.sections, used);
  }
  rejectIdle(settings, used);
  settings.frames = frame::framesGiven();
  readPlane(settings);
  return settings;
}

std::vector<mesh::GroupRequest> groupRequests(const Settings& settings) {
  std::map<std::string, std::string> bodies;  // the option that names each
  for (const auto& [group, body] : settings.bodies) bodies[group] = youngOption.dashed(group);
  for (const auto& [body, sections] : settings.sections) {
    for (const auto& section : sections) bodies.erase(section);
    bodies[body] = sectionsName(body);
  }
  std::vector<mesh::GroupRequest> requests;
  for (const auto& [body, option] : bodies) requests.push_back({body, option});
  return requests;
}

std::map<std::string, std::vector<mesh::GroupRequest>> sectionRequests(const Settings& settings) {
  std::map<std::string, std::vector<mesh::GroupRequest>> requests;
  for (const auto& [body, sections] : settings.sections)
    for (const auto& section : sections) requests[body].push_back({section, sectionsName(body)});
  return requests;
}

std::string howToGiveMaterials() { return "give -material_<group>_young, _poisson and _density"; }

std::string integrationName(const std::string& group) { return integrationOption.dashed(group); }

}  // namespace squeal::material
