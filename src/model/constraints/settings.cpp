// SPDX-License-Identifier: BSD-2-Clause
#include "model/constraints/settings.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "base/options/options.hpp"
#include "base/system/error.hpp"
#include "base/system/text.hpp"

namespace squeal::constraints {
namespace {

const RealListOption positionOption("reference", "reference_<name>_position", "0,0,0", "m", anyReal,
                                    "position of a reference node, which has a displacement and a "
                                    "rotation");
const TextOption centreOption("reference", "reference_<name>_centre_of", "",
                              "group of nodes whose mean position is that of the reference node");
const TextOption clampedOption(
    "constraint", "constraint_<group>_clamped", "",
    "fixed components of the displacement of the nodes of a group: some of xyz");
const RealListOption displacementOption("constraint", "constraint_<group>_displacement", "0,0,0",
                                        "m", anyReal,
                                        "prescribed values of the clamped components");
const TextOption rotationOption(
    "constraint", "constraint_<group>_clamped_rotation", "",
    "fixed components of the rotation of a reference node: some of xyz; in plane problems z");
const RealListOption angleOption("constraint", "constraint_<group>_angle", "0,0,0", "rad", anyReal,
                                 "prescribed values of the clamped rotations");
const TextOption frameOption("constraint", "constraint_<group>_frame", "",
                             "name of the -frame whose axes are x, y, z of the clamped "
                             "components; default: the global axes");
const TextOption imageOption("constraint", "constraint_<group>_image_of", "",
                             "group whose periodic image this group is: a translation maps its "
                             "nodes onto those of this group");
const TextOption referenceOption("coupling", "coupling_<name>_reference", "",
                                 "reference node of a coupling");
const TextOption nodesOption(
    "coupling", "coupling_<name>_nodes", "",
    "groups of nodes, or reference nodes, that the coupling connects with its reference node");
const ChoiceOption kindOption(
    "coupling", "coupling_<name>_kind", {"rigid", "distributed"}, "rigid",
    "kind of a coupling; rigid: the nodes move with the reference node as one rigid body (RBE2); "
    "distributed: the reference node follows their weighted mean motion (RBE3)");
const TextOption componentsOption("coupling", "coupling_<name>_components", "xyz",
                                  "components of the displacement that a rigid coupling connects; "
                                  "the nodes are free in the others");
const TextOption couplingFrameOption("coupling", "coupling_<name>_frame", "",
                                     "name of the -frame whose axes are x, y, z of the coupled "
                                     "components; default: the global axes");
const RealListOption weightsOption(
    "coupling", "coupling_<name>_weights", "1", "", positive,
    "weights of a distributed coupling, one per group; each node of the group has this weight, and "
    "the weights of a node in several groups add up");
const FlagOption pinnedOption("coupling", "coupling_<name>_pinned", false,
                              "free rotations of the reference nodes among -coupling_<name>_nodes "
                              "of a rigid coupling; off: their rotations follow the coupling too");
const TextOption equationOption("equation", "equation_<name>", "",
                                "linear equation of displacements, such as a:x - 2*b:y + c:rz = "
                                "0.1; a, b: groups of one node or reference nodes; x, y, z: "
                                "displacement, m; rx, ry, rz: rotation of a reference node, rad");

const TextOption sectionOption("bolt", "bolt_<name>_section", "",
                               "surface group inside a body, at which the shank of a bolt is cut");
const RealOption boltForceOption("bolt", "bolt_<name>_force", 0.0, "N", nonNegative,
                                 "bolt tension, applied in a first step without pressure and "
                                 "friction; the length of the bolt is constant afterwards");
const RealOption shorteningOption("bolt", "bolt_<name>_shortening", 0.0, "m", anyReal,
                                  "length by which the two sides of the section are drawn "
                                  "together, instead of -bolt_<name>_force");
const RealListOption boltAxisOption(
    "bolt", "bolt_<name>_axis", "0,0,1", "", anyReal,
    "direction of the bolt, which decides the sign of the normal of its section; if not given: the "
    "normal of a face of the section");

const FlagOption underPressureOption(
    "bolt", "bolt_under_pressure", false,
    "loads that -flutter_pressure scales, such as pressures, in the first step too; on: needed if "
    "parts of the brake are loose without these loads");

std::vector<mesh::ReferenceRequest> referencesGiven() {
  std::set<std::string> names;
  for (const Option* option : std::vector<const Option*>{&positionOption, &centreOption})
    for (const auto& name : option->subjects()) names.insert(name);
  std::vector<mesh::ReferenceRequest> references;
  for (const auto& name : names) {
    const bool isCentre = centreOption.given(name);
    if (isCentre && positionOption.given(name))
      throw Error("options " + positionOption.dashed(name) + " and " + centreOption.dashed(name) +
                  ": give the position once");
    mesh::ReferenceRequest request{name, {}, {}, positionOption.dashed(name)};
    if (isCentre) {
      const std::string group = centreOption.get(name);
      request.option = centreOption.dashed(name) + " " + group;
      request.centreOf = {group, request.option};
    } else {
      request.position = positionOption.vector(name);
    }
    references.push_back(std::move(request));
  }
  return references;
}

bool isReference(const Settings& settings, const std::string& name) {
  return std::ranges::find(settings.references, name, &mesh::ReferenceRequest::name) !=
         settings.references.end();
}

/// Throws Error unless the components are letters of xyz, each once.
void requireLetters(const std::string& components, const std::string& option) {
  for (const char letter : components)
    if (letter < 'x' || letter > 'z' || std::ranges::count(components, letter) > 1)
      throw Error("option " + option + " " + components +
                  ": must be some of the letters xyz, each once");
}

std::map<std::string, ClampSettings> clampsGiven(const Settings& settings) {
  requireOption({&displacementOption}, clampedOption);
  requireOption({&angleOption}, rotationOption);
  std::map<std::string, ClampSettings> clamps;
  for (const Option* option : std::vector<const Option*>{&clampedOption, &rotationOption})
    for (const auto& group : option->subjects())
      clamps[group] = {clampedOption.get(group), displacementOption.vector(group),
                       rotationOption.get(group), angleOption.vector(group),
                       frameOption.get(group)};
  for (const auto& group : frameOption.subjects())
    if (!clamps.contains(group)) requireOption({&frameOption}, clampedOption);
  for (const auto& [group, clamp] : clamps) {
    requireLetters(clamp.rotations, rotationOption.dashed(group));
    if (!clamp.rotations.empty() && !isReference(settings, group))
      throw Error("option " + rotationOption.dashed(group) + ": '" + group +
                  "' is not a reference node; only these have a rotation. Make one with " +
                  positionOption.dashed(group));
  }
  return clamps;
}

CouplingSettings couplingGiven(const std::string& name, const Settings& settings) {
  CouplingSettings coupling;
  coupling.name = name;
  coupling.reference = referenceOption.get(name);
  if (!isReference(settings, coupling.reference))
    throw Error("option " + referenceOption.dashed(name) + " " + coupling.reference +
                ": no reference node has this name; make it with " +
                positionOption.dashed(coupling.reference) + " or " +
                centreOption.dashed(coupling.reference));
  const bool rigid = kindOption.get(name) == "rigid";
  coupling.kind = rigid ? CouplingKind::rigid : CouplingKind::distributed;
  for (const Option* option :
       std::vector<const Option*>{&componentsOption, &couplingFrameOption, &pinnedOption})
    if (!rigid && option->given(name))
      throw Error("option " + option->dashed(name) + " needs " + kindOption.dashed(name) +
                  " rigid");
  if (rigid && weightsOption.given(name))
    throw Error("option " + weightsOption.dashed(name) + " needs " + kindOption.dashed(name) +
                " distributed");
  coupling.groups = nodesOption.list(name);
  for (const auto& group : coupling.groups)
    if (group == coupling.reference || std::ranges::count(coupling.groups, group) > 1)
      throw Error("option " + nodesOption.dashed(name) + ": '" + group + "' " +
                  (group == coupling.reference ? "is the reference node of this coupling"
                                               : "is there twice"));
  if (!rigid) {
    coupling.weights = weightsOption.get(name);
    if (!weightsOption.given(name)) coupling.weights.assign(coupling.groups.size(), 1);
    if (coupling.weights.size() != coupling.groups.size())
      throw Error(formatted("option %s: %zu weights for the %zu groups of %s; give one per group",
                            weightsOption.dashed(name).c_str(), coupling.weights.size(),
                            coupling.groups.size(), nodesOption.dashed(name).c_str()));
  }
  coupling.components = componentsOption.get(name);
  requireLetters(coupling.components, componentsOption.dashed(name));
  coupling.frame = couplingFrameOption.get(name);
  coupling.pinned = pinnedOption.get(name);
  return coupling;
}

std::vector<CouplingSettings> couplingsGiven(const Settings& settings) {
  requireOption({&nodesOption, &kindOption, &componentsOption, &couplingFrameOption, &weightsOption,
                 &pinnedOption},
                referenceOption);
  requireOption({&referenceOption}, nodesOption);
  std::vector<CouplingSettings> couplings;
  for (const auto& name : referenceOption.subjects())
    couplings.push_back(couplingGiven(name, settings));
  return couplings;
}

/// Reads an equation from its text.
class EquationReader {
 public:
  EquationReader(const std::string& name, const std::string& text, const Settings& settings)
      : option_(equationOption.dashed(name)), text_(text), settings_(settings) {
    equation_.name = name, equation_.text = text;
  }
  EquationSettings read();

 private:
  [[noreturn]] void reject(const std::string& why) const {
    throw Error("option " + option_ + " '" + text_ + "': " + why + hint_);
  }
  double number(const std::string& text) const;
  void addTerm(const std::string& text, double sign);

  std::string option_, text_;
  std::string hint_;  // for the term that is read
  const Settings& settings_;
  EquationSettings equation_;
};

double EquationReader::number(const std::string& text) const {
  double x = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, x);
  if (error != std::errc() || stop != end || !std::isfinite(x))
    reject("'" + text + "' is not a number");
  return x;
}

void EquationReader::addTerm(const std::string& text, double sign) {
  EquationTerm term{.factor = sign};
  for (std::size_t i = 1; i < text.size(); ++i)
    if ((text[i] == '+' || text[i] == '-') && text[i - 1] != 'e' && text[i - 1] != 'E')
      hint_ = "; a blank before + and - separates terms, as in a:x - 2*b:y";
  std::string place = text;
  if (const auto star = text.find('*'); star != std::string::npos) {
    term.factor *= number(trimmed(text.substr(0, star)));
    place = trimmed(text.substr(star + 1));
  }
  const auto colon = place.rfind(':');
  if (colon == std::string::npos)
    reject("the term '" + text + "' has no component; write factor*group:component");
  if (place.find(':') != colon && !hint_.empty()) reject("'" + text + "' has two components");
  term.group = place.substr(0, colon);
  std::string component = place.substr(colon + 1);
  if (component.starts_with('r')) term.rotation = true, component.erase(0, 1);
  if (component.size() != 1 || component[0] < 'x' || component[0] > 'z')
    reject("the component of '" + text + "' must be x, y, z, rx, ry or rz");
  if (term.rotation && !isReference(settings_, term.group))
    reject("'" + term.group + "' is not a reference node; only these have a rotation");
  if (term.factor == 0) reject("the factor of '" + text + "' is zero");
  term.component = component[0] - 'x';
  for (const auto& other : equation_.terms)
    if (other.group == term.group && other.component == term.component &&
        other.rotation == term.rotation)
      reject("'" + place + "' is there twice");
  hint_.clear();
  equation_.terms.push_back(std::move(term));
}

EquationSettings EquationReader::read() {
  const auto sides = split(text_, '=');
  if (sides.size() != 2) reject("must have one equals sign, with the value after it");
  equation_.value = number(trimmed(sides[1]));
  // A sign separates terms only after a blank or at the beginning: group names may contain a
  // hyphen, and numbers an exponent.
  const std::string left = trimmed(sides[0]);
  double sign = 1;
  std::string term;
  const auto finish = [&] {
    if (!trimmed(term).empty()) addTerm(trimmed(term), sign);
    term.clear();
  };
  for (std::size_t i = 0; i < left.size(); ++i) {
    const bool separates = i == 0 || left[i - 1] == ' ';
    if (separates && (left[i] == '+' || left[i] == '-')) {
      finish();
      sign = left[i] == '-' ? -1 : 1;
    } else {
      term += left[i];
    }
  }
  finish();
  if (equation_.terms.empty()) reject("has no term");
  return equation_;
}

std::vector<EquationSettings> equationsGiven(const Settings& settings) {
  std::vector<EquationSettings> equations;
  for (const auto& name : equationOption.subjects())
    equations.push_back(EquationReader(name, equationOption.get(name), settings).read());
  return equations;
}

std::vector<BoltSettings> boltsGiven() {
  requireOption({&boltForceOption, &shorteningOption, &boltAxisOption}, sectionOption);
  std::vector<BoltSettings> bolts;
  for (const auto& name : sectionOption.subjects()) {
    if (boltForceOption.given(name) == shorteningOption.given(name))
      throw Error("option " + sectionOption.dashed(name) + ": give either " +
                  boltForceOption.dashed(name) + " or " + shorteningOption.dashed(name));
    BoltSettings bolt{.name = name, .section = sectionOption.get(name)};
    if (boltForceOption.given(name)) bolt.force = boltForceOption.get(name);
    if (shorteningOption.given(name)) bolt.shortening = shorteningOption.get(name);
    if (boltAxisOption.given(name)) bolt.axis = boltAxisOption.vector(name);
    bolts.push_back(std::move(bolt));
  }
  if (underPressureOption.given() &&
      std::ranges::none_of(bolts, [](const auto& bolt) { return bolt.force.has_value(); }))
    throw Error("option " + underPressureOption.dashed() + " needs -bolt_<name>_force");
  return bolts;
}

}  // namespace

Settings Settings::given() {
  Settings settings;
  settings.frames = frame::framesGiven();
  settings.references = referencesGiven();
  settings.clamps = clampsGiven(settings);
  settings.couplings = couplingsGiven(settings);
  settings.equations = equationsGiven(settings);
  settings.bolts = boltsGiven();
  settings.boltsUnderPressure = underPressureOption.get();
  for (const auto& image : imageOption.subjects()) settings.imageOf[image] = imageOption.get(image);
  return settings;
}

std::vector<mesh::GroupRequest> constrainedGroups(const Settings& settings) {
  std::vector<mesh::GroupRequest> requests;
  for (const auto& [group, clamp] : settings.clamps)
    requests.push_back(
        {group, clamp.components.empty() ? clampedRotationName(group) : clampedName(group)});
  for (const auto& coupling : settings.couplings)
    for (const auto& group : coupling.groups)
      requests.push_back({group, couplingNodesName(coupling.name)});
  for (const auto& equation : settings.equations)
    for (const auto& term : equation.terms)
      requests.push_back({term.group, equationName(equation.name)});
  return requests;
}

std::vector<mesh::PeriodicRequest> periodicPairs(const Settings& settings) {
  std::vector<mesh::PeriodicRequest> pairs;
  for (const auto& [image, primary] : settings.imageOf)
    pairs.push_back({image, primary, imageOption.dashed(image) + " " + primary});
  return pairs;
}

std::vector<mesh::SectionRequest> boltSections(const Settings& settings) {
  std::vector<mesh::SectionRequest> sections;
  for (const auto& bolt : settings.bolts)
    sections.push_back({bolt.name,
                        {bolt.section, sectionOption.dashed(bolt.name) + " " + bolt.section},
                        bolt.axis,
                        boltAxisOption.dashed(bolt.name)});
  return sections;
}

std::string clampedName(const std::string& group) { return clampedOption.dashed(group); }
std::string displacementName(const std::string& group) { return displacementOption.dashed(group); }
std::string clampedRotationName(const std::string& group) { return rotationOption.dashed(group); }
std::string angleName(const std::string& group) { return angleOption.dashed(group); }
std::string clampFrameName(const std::string& group) { return frameOption.dashed(group); }
std::string pinnedName(const std::string& coupling) { return pinnedOption.dashed(coupling); }
std::string couplingNodesName(const std::string& coupling) { return nodesOption.dashed(coupling); }
std::string couplingComponentsName(const std::string& coupling) {
  return componentsOption.dashed(coupling);
}
std::string couplingFrameName(const std::string& coupling) {
  return couplingFrameOption.dashed(coupling);
}
std::string equationName(const std::string& equation) { return equationOption.dashed(equation); }
std::string boltForceName(const std::string& bolt) { return boltForceOption.dashed(bolt); }
std::string boltShorteningName(const std::string& bolt) { return shorteningOption.dashed(bolt); }
std::string boltsUnderPressureName() { return underPressureOption.dashed(); }

}  // namespace squeal::constraints
