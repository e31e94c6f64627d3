// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Settings of springs and bushings between nodes, point masses, and forces on nodes. Not
/// collective: all ranks have the same options, so they get the same results and Errors.
#include <map>
#include <string>
#include <vector>

#include "base/options/option_types.hpp"
#include "model/frame/settings.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::attachments {

/// A spring and a dashpot along the line between two nodes.
struct SpringSettings {
  std::string name, from, to;  ///< groups with one node, or reference nodes
  double stiffness = 0;        ///< N/m
  double damping = 0;          ///< N·s/m
};

/// Springs and dashpots along and about three axes.
struct BushingSettings {
  /// Groups with one node, or reference nodes; an empty `to` means the ground.
  std::string name, from, to;
  std::vector<double> stiffness;  ///< along the axes, N/m, then about them, N·m/rad
  std::vector<double> damping;    ///< along the axes, N·s/m, then about them, N·m·s/rad
  std::string frame;              ///< empty: the global axes
};

/// Masses at the nodes of a group, or at a reference node.
struct MassSettings {
  std::string group;
  double total = 0;             ///< kg, shared equally by the nodes of the group
  std::vector<double> inertia;  ///< Jxx, Jyy, Jzz, Jxy, Jxz, Jyz about the centre of mass, kg·m²
  VectorValue offset;           ///< from the reference node to the centre of mass, m
  std::string frame;            ///< axes of inertia and offset; empty: the global ones
  bool hasInertia = false, hasOffset = false;  ///< true if given
};

/// A force, and a moment at a reference node.
struct ForceSettings {
  std::string group;
  VectorValue force;       ///< N, shared equally by the nodes of the group
  VectorValue moment;      ///< N·m
  std::string frame;       ///< empty: the global axes
  bool hasMoment = false;  ///< true if given
  bool hydraulic = true;   ///< true if it scales with the pressure of the sweep
};

struct Settings {
  std::map<std::string, frame::FrameSettings> frames;  ///< [name]
  std::vector<SpringSettings> springs;                 ///< sorted by name, like the lists below
  std::vector<BushingSettings> bushings;
  std::vector<MassSettings> masses;
  std::vector<ForceSettings> forces;

  /// Reads the options. Throws Error for a spring without one of its ends, a bushing without its
  /// first end, a spring or bushing without stiffness and damping, and a mass that is not positive.
  static Settings given();
};

/// Returns the groups that these settings name, for the mesh reader.
std::vector<mesh::GroupRequest> attachedGroups(const Settings& settings);

/// Returns true if the loads of a group scale with the pressure of the sweep.
bool isHydraulic(const std::string& group);
/// Throws Error if -load_<group>_hydraulic is given for a group without a load, that is, without a
/// force, a moment or a value of `pressure`.
void rejectIdleHydraulic(const RealOption& pressure);

/// Return names of options with their dash, for messages.
std::string springFromName(const std::string& spring);
std::string springToName(const std::string& spring);
std::string bushingFromName(const std::string& bushing);
std::string bushingToName(const std::string& bushing);
std::string bushingStiffnessName(const std::string& bushing);
std::string bushingDampingName(const std::string& bushing);
std::string bushingFrameName(const std::string& bushing);
std::string massName(const std::string& group);
std::string inertiaName(const std::string& group);
std::string massOffsetName(const std::string& group);
std::string massFrameName(const std::string& group);
std::string forceName(const std::string& group);
std::string momentName(const std::string& group);
std::string forceFrameName(const std::string& group);

}  // namespace squeal::attachments
