// SPDX-License-Identifier: BSD-2-Clause
#include "model/gmshreader/geometry.hpp"

#include <gmsh.h>
#include <petscsystypes.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "base/system/error.hpp"
#include "base/system/process_memory.hpp"
#include "base/system/text.hpp"

namespace squeal::gmshreader {
namespace {

using Json = nlohmann::json;
using meshfile::GeometryParameter;

std::string optionText(const GeometryParameter& given) {
  return "option -mesh_set " + given.name + "=" + shortest(given.value) + ": ";
}

/// A Range is the range of a parameter, with its step. Where a geometry declares none, gmsh guesses
/// them from the value for its sliders; guesses are not rules.
struct Range {
  double low, high, step;
};

/// Returns the range that gmsh guesses from a value.
Range guessed(double value) {
  const bool whole = std::floor(value) == value;
  const double factor = whole ? 5 : 20;
  Range range{-1e200, 1e200, 0};
  if (value > 0) range.low = value / factor, range.high = value * factor;
  if (value < 0) range.low = value * factor, range.high = value / factor;
  if (value != 0) range.step = (range.high - range.low) / 100;
  if (value != 0 && whole)
    range = {std::trunc(range.low), std::trunc(range.high), std::trunc(range.step)};
  return range;
}

/// Returns true if both ranges are the same to the digits that gmsh prints.
bool alike(const Range& a, const Range& b) {
  const auto near = [](double x, double y) {
    return std::abs(x - y) <= 1e-6 * std::max(std::abs(x), std::abs(y));
  };
  return near(a.low, b.low) && near(a.high, b.high);
}

/// Returns the parameters that gmsh knows, without its own ones.
std::vector<std::string> knownNames() {
  std::vector<std::string> all, known;
  gmsh::onelab::getNames(all);
  for (const auto& name : all)
    if (name.rfind("Gmsh/", 0) != 0 && name.rfind("ONELAB/", 0) != 0) known.push_back(name);
  return known;
}

/// Returns the rule that a geometry declares for a parameter and that the value breaks; empty if
/// there is none.
std::string brokenRule(const GeometryParameter& given) {
  std::string text;
  gmsh::onelab::get(text, given.name);
  const Json parameter = Json::parse(text, nullptr, false);
  if (parameter.is_discarded()) return "";  // a value that is not finite
  if (parameter.value("type", "") != "number") return "a text, which cannot be set";
  const auto numbers = [&](const char* name) {
    return parameter.contains(name) ? parameter.at(name).get<std::vector<double>>()
                                    : std::vector<double>{};
  };
  const double x = given.value;
  if (const auto choices = numbers("choices");
      !choices.empty() && std::find(choices.begin(), choices.end(), x) == choices.end()) {
    std::vector<std::string> words;
    for (double choice : choices) words.push_back(shortest(choice));
    return joined(words, " or ");
  }
  const Range range{parameter.value("min", -1e200), parameter.value("max", 1e200),
                    parameter.value("step", 0.0)};
  if (const auto values = numbers("values"); values.size() == 1 && alike(range, guessed(values[0])))
    return "";
  // A step is the increment of a slider, but 1 from a whole number on means whole numbers.
  const bool whole = range.step == 1 && std::floor(range.low) == range.low;
  if (x >= range.low && x <= range.high && (!whole || std::floor(x) == x)) return "";
  std::string rule = whole ? "a whole number" : "a number";
  if (range.low > -1e200) rule += " >= " + shortest(range.low);
  if (range.high < 1e200) rule += (range.low > -1e200 ? " and <= " : " <= ") + shortest(range.high);
  return rule;
}

std::size_t edgesOn(int curve) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, 1, curve);
  std::size_t count = 0;
  for (const auto& list : tags) count += list.size();
  return count;
}

std::vector<int> boundaryOf(int dimension, int entity) {
  gmsh::vectorpair boundary;
  gmsh::model::getBoundary({{dimension, entity}}, boundary, false, false);
  std::vector<int> tags;
  for (const auto& [d, tag] : boundary) tags.push_back(tag);
  return tags;
}

/// Returns the number of cells of the finest structured mesh that the edges on the curves allow. It
/// is exact for rectangles and boxes with the same number of cells on opposite sides, and gives the
/// order of magnitude for meshes of even size.
double cellsByEdges() {
  gmsh::vectorpair surfaces, volumes;
  gmsh::model::getEntities(surfaces, 2);
  gmsh::model::getEntities(volumes, 3);
  std::map<int, double> ofSurface;
  double inSurfaces = 0, inVolumes = 0;
  for (const auto& [dimension, surface] : surfaces) {
    std::vector<double> edges;
    double sum = 0;
    for (int curve : boundaryOf(2, surface)) edges.push_back(edgesOn(curve)), sum += edges.back();
    ofSurface[surface] = edges.size() == 4
                             ? std::max(edges[0], edges[2]) * std::max(edges[1], edges[3])
                             : sum * sum / 16;
    inSurfaces += ofSurface[surface];
  }
  for (const auto& [dimension, volume] : volumes) {
    std::vector<double> faces;
    double sum = 0;
    for (int surface : boundaryOf(3, volume))
      faces.push_back(ofSurface[surface]), sum += faces.back();
    std::sort(faces.begin(), faces.end());  // of a box, in pairs: ab, ab, bc, bc, ca, ca
    inVolumes +=
        faces.size() == 6 ? std::sqrt(faces[1] * faces[3] * faces[5]) : std::pow(sum / 6, 1.5);
  }
  return volumes.empty() ? inSurfaces : inVolumes;
}

}  // namespace

void applyParameters(const std::vector<meshfile::GeometryParameter>& parameters) {
  const auto known = knownNames();
  for (const auto& given : parameters) {
    if (std::find(known.begin(), known.end(), given.name) == known.end())
      throw Error(optionText(given) + "the geometry has no parameter '" + given.name + "'; " +
                  (known.empty() ? "it has none" : "it has: " + joined(known)));
    if (const std::string rule = brokenRule(given); !rule.empty())
      throw Error(optionText(given) + "must be " + rule + ", as the geometry declares");
  }
  gmsh::onelab::clear();  // a default computed from other parameters must follow the values given
                          // here
  for (const auto& given : parameters) gmsh::onelab::setNumber(given.name, {given.value});
}

void requireParametersUsed(const std::vector<meshfile::GeometryParameter>& parameters) {
  for (const auto& given : parameters) {
    std::vector<double> used;
    gmsh::onelab::getNumber(given.name, used);
    if (used != std::vector<double>{given.value})
      throw Error(optionText(given) + "the geometry takes " +
                  (used.empty() ? "none" : shortest(used[0])) + " in its place");
  }
}

void meshGeometry(const std::string& file, const Warn& warn) {
  gmsh::model::mesh::generate(1);
  const double cells = cellsByEdges(), order = [] {
    double value = 1;
    gmsh::option::getNumber("Mesh.ElementOrder", value);
    return value;
  }();
  const int dimension = std::max(2, gmsh::model::getDimension());
  const double numbers = cells * std::pow(order, dimension) * dimension;  // displacements
  const std::string expected = formatted(
      "option -mesh_file %s: by the numbers of cells along its edges the mesh has about %.2g cells",
      file.c_str(), cells);
  if (numbers > std::numeric_limits<PetscInt>::max())
    throw Error(expected + formatted(", more displacements than indices of %zu bits can number",
                                     8 * sizeof(PetscInt)));
  constexpr double bytesPerCell = 200;  // only of gmsh, at least
  const double needed = cells * bytesPerCell, free = availableMemory();
  const std::string need =
      expected + formatted(", for which gmsh needs %.2g GB or more; %.2g GB are free", needed / 1e9,
                           free / 1e9);
  if (needed > 2 * free) throw Error(need);
  if (needed > free / 2) warn(need);
  gmsh::model::mesh::generate(dimension);
}

}  // namespace squeal::gmshreader
