// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Settings of the elements, loads, base motions and supports of the bodies. Not collective: all
/// ranks have the same options, and therefore the same results and Errors.
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/options/option_types.hpp"
#include "model/attachments/settings.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::elasticity {

enum class MassKind { consistent, higherOrder };

/// The base motion of one body.
struct MotionSettings {
  std::string option;           ///< an option that gives the motion, with its dash, for messages
  bool moves = false;           ///< a velocity or a speed is given
  VectorValue velocity = {};    ///< of a translation, m/s
  double speed = 0;             ///< of a rotation, rad/s
  VectorValue axis = {};        ///< direction of the rotation axis
  VectorValue origin = {};      ///< a point of the rotation axis, m
  std::string axisOption = {};  ///< the option of the axis, with its dash, for messages
};

/// The total stiffness and damping of the springs and dashpots between one group and the ground.
struct GroundSettings {
  VectorValue stiffness;   ///< N/m
  VectorValue damping;     ///< N·s/m
  std::string frame = {};  ///< the frame of these components; empty: the global axes
  bool springs = false, dashpots = false;  ///< true if given
};

struct Settings {
  MassKind mass = MassKind::consistent;
  std::vector<std::string> incompatible{"hex8"};  ///< cell types with incompatible modes
  bool prestress = false;   ///< the geometric stiffness of the steady stress is added to K
  bool centrifugal = true;  ///< centrifugal forces act on rotating bodies
  /// The convective terms of moving bodies, with D u = (V·∇)u, are included.
  bool convective = false;
  std::map<std::string, double> pressure;            ///< [surface group], Pa, positive inwards
  std::set<std::string> constantPressure;            ///< surface groups with fixed pressure
  VectorValue gravity;                               ///< of all bodies and point masses, m/s²
  std::map<std::string, VectorValue> accelerations;  ///< [body] added to gravity, m/s²
  /// [body] a rotation that acts only as a load, by its centrifugal forces
  std::map<std::string, MotionSettings> spins;
  bool bodyForces = false;  ///< gravity, an acceleration or a spin is given
  attachments::Settings attachments;
  std::map<std::string, MotionSettings> motions;  ///< [body], only bodies with such an option
  std::map<std::string, GroundSettings> ground;   ///< [group]

  /// Reads the options. Throws Error if rotation and translation, or both units of the speed, are
  /// given for one body, and for an unknown cell type.
  static Settings given();
  /// Returns true if cells of this type have incompatible modes.
  bool isIncompatible(const std::string& cellType) const;
};

/// Returns the bodies with a given velocity or speed.
std::vector<std::string> movingBodies(const Settings& settings);
/// Return groups for the mesh reader: surfaces with a pressure, and groups with springs or
/// dashpots.
std::vector<mesh::GroupRequest> loadedSurfaces(const Settings& settings);
std::vector<mesh::GroupRequest> groundedGroups(const Settings& settings);
/// Return names of options with their dash, for messages.
std::string groundFrameName(const std::string& group);
std::string accelerationName(const std::string& body);
std::string pressureName(const std::string& surface);
/// Returns the options that give a motion, for messages.
inline const char* motionOptions() { return "-motion_<body>_*"; }

}  // namespace squeal::elasticity
