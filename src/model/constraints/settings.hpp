// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Settings of supports, reference nodes, couplings, equations, bolts and periodic images. Not
/// collective: all ranks have the same options, so they get the same results and Errors.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/options/option_types.hpp"
#include "model/frame/settings.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::constraints {

/// The supports of one group, or of one reference node.
struct ClampSettings {
  std::string components;         ///< held components of the displacement, some of xyz
  VectorValue displacement = {};  ///< values of these components, m
  std::string rotations;          ///< held components of the rotation of a reference node
  VectorValue angle = {};         ///< values of these rotations, rad
  std::string frame;              ///< the axes of x, y, z; empty: the global ones
};

enum class CouplingKind {
  rigid,       ///< the nodes of the groups follow the reference node
  distributed  ///< the reference node follows the mean motion of the groups
};

/// The coupling of a reference node with groups of nodes.
struct CouplingSettings {
  std::string name, reference;
  CouplingKind kind = CouplingKind::rigid;
  std::vector<std::string> groups;  ///< groups of nodes, or reference nodes
  std::vector<double> weights;      ///< [group] weight of each of its nodes, if distributed
  std::string components;           ///< coupled components of the nodes, some of xyz, if rigid
  std::string frame;                ///< the axes of these components; empty: the global ones
  bool pinned = false;              ///< rotations of reference nodes in the groups stay free
};

/// One term of an equation: a factor times a component of a node.
struct EquationTerm {
  std::string group = {};  ///< a group with one node, or a reference node
  int component = 0;
  bool rotation = false;
  double factor = 0;
};

/// The equation Σ factor · component = value.
struct EquationSettings {
  std::string name, text;  ///< text: as given, for messages
  std::vector<EquationTerm> terms;
  double value = 0;
};

/// A bolt: a section of a body whose two sides are drawn together.
struct BoltSettings {
  std::string name;
  std::string section;  ///< surface group inside a body
  /// Tension in the first step, N; the length is fixed afterwards.
  std::optional<double> force = {};
  std::optional<double> shortening = {};  ///< fixed shortening, m, instead of a force
  std::optional<VectorValue> axis = {};   ///< direction of the bolt
};

struct Settings {
  std::map<std::string, frame::FrameSettings> frames;  ///< [name]
  std::vector<mesh::ReferenceRequest> references;      ///< sorted by name
  std::map<std::string, ClampSettings> clamps;         ///< [group]
  std::vector<CouplingSettings> couplings;             ///< sorted by name
  std::vector<EquationSettings> equations;             ///< sorted by name
  std::vector<BoltSettings> bolts;                     ///< sorted by name
  /// True if the loads that the sweep scales already act in the first step.
  bool boltsUnderPressure = false;
  std::map<std::string, std::string> imageOf;  ///< [image group] the group that it repeats

  /// Reads the options. Throws Error if an option is given without another one that it requires,
  /// for a reference node that nothing uses or that does not exist, for weights that do not fit the
  /// groups, and for an equation that cannot be read.
  static Settings given();
};

/// Return what the mesh reader needs: the groups with supports, couplings or equations, and the
/// periodic pairs of groups.
std::vector<mesh::GroupRequest> constrainedGroups(const Settings& settings);
std::vector<mesh::PeriodicRequest> periodicPairs(const Settings& settings);
/// Returns the sections of the bolts, for the mesh reader.
std::vector<mesh::SectionRequest> boltSections(const Settings& settings);

/// Return names of options with their dash, for messages.
std::string clampedName(const std::string& group);
std::string displacementName(const std::string& group);
std::string clampedRotationName(const std::string& group);
std::string angleName(const std::string& group);
std::string clampFrameName(const std::string& group);
std::string couplingNodesName(const std::string& coupling);
std::string couplingComponentsName(const std::string& coupling);
std::string couplingFrameName(const std::string& coupling);
std::string pinnedName(const std::string& coupling);
std::string equationName(const std::string& equation);
std::string boltForceName(const std::string& bolt);
std::string boltShorteningName(const std::string& bolt);
std::string boltsUnderPressureName();

}  // namespace squeal::constraints
