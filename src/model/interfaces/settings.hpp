// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Settings of the contact interfaces and ties. Not collective: all ranks have the
/// same options, and therefore the same results and Errors.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/options/option_types.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::interfaces {

using mesh::Point;

/// The side of an interface whose nodes have the gaps.
enum class SlaveChoice { finer, pad, disc };

/// The interaction of the two sides of an interface. Tied interfaces never separate.
enum class Role {
  sliding,       ///< friction along the sliding velocity
  sticking,      ///< no tangential jump
  frictionless,  ///< no tangential force
  tied           ///< no jump at all
};

/// Returns the value of `-contact_<interface>_role` for a role.
std::string text(Role role);

/// A coefficient of friction as a function of the swept friction f: fixed + swept · f.
struct Coefficient {
  double fixed = 0, swept = 0;

  bool operator==(const Coefficient&) const = default;
  double at(double friction) const { return fixed + swept * friction; }
  /// Returns the factor of f^exponent: fixed for 0, swept for 1.
  double part(int exponent) const { return exponent == 0 ? fixed : swept; }
};

/// One interface: contact, or a tie of two bodies.
struct InterfaceSettings {
  mesh::InterfaceRequest surfaces;  ///< of a tie: the pad is the slave, the disc the master
  Role role = Role::sliding;
  VectorValue obstacleVelocity;      ///< of the rigid obstacle in place of a disc, m/s
  VectorValue obstacleDisplacement;  ///< m
  SlaveChoice slave = SlaveChoice::finer;
  double searchDistance = 0;  ///< m; 0: half the size of each face
  Coefficient friction;       ///< of a sliding interface; zero for other roles
  /// Coefficient of friction up to which the nodes of a sticking interface stick; none: unlimited.
  std::optional<double> stickingLimit;
  bool releases = false;       ///< nodes of a sticking interface that exceed this limit slide
  bool gapIsMeasured = false;  ///< the gap without load is the distance between the surfaces
  double gap = 0;  ///< gap without load if it is not measured, m; negative: interference
  /// Stiffness of a compliant layer along the normal and, on a sticking interface, along the face,
  /// N/m³; 0: hard contact.
  double layerStiffness = 0, layerTangentialStiffness = 0;
  bool separates = true;  ///< false: the gap stays zero, even under tension
  bool adjust = false;    ///< of a tie: its nodes are moved onto the master

  /// Returns true for an interface that the options `-tie_*` define, and false for one that the
  /// options `-contact_*` define, even if its role is tied.
  bool isTie() const { return surfaces.pad.option.starts_with("-tie_"); }
  bool onObstacle() const { return surfaces.disc.name.empty(); }
  bool isTied() const { return role == Role::tied; }
  /// Returns "interface 'pad'" or "tie 'lining'", for messages.
  const std::string& label() const { return surfaces.label; }
};

struct Settings {
  std::vector<InterfaceSettings> interfaces;  ///< contact, then ties, each sorted by name

  /// Reads the options. Throws Error for an interface without a pad surface, for an interface that
  /// has neither a disc surface nor an obstacle or has both, for a tie without one of its sides,
  /// and for incompatible options.
  static Settings given();
  /// Returns the interface with this label, borrowed; there must be one.
  const InterfaceSettings& interface(const std::string& label) const;
};

/// Returns the exponents of the swept friction in the coefficients of the interfaces, ascending: 0
/// if any coefficient has a fixed part, 1 if any has a swept part.
std::vector<int> frictionExponents(const std::vector<InterfaceSettings>& interfaces);

/// Returns the surfaces of the interfaces, for the mesh reader.
std::vector<mesh::InterfaceRequest> interfaceRequests(const Settings& settings);

/// Return names of options of an interface with their dash, for messages:
/// `-contact_<interface>_obstacle_velocity`, `-contact_<interface>_search` or
/// `-tie_<name>_tolerance`, `-contact_<interface>_role`, `-contact_<interface>_separation`,
/// `-contact_<interface>_slave`, `-contact_<interface>_stiffness`, and `-tie_<name>_adjust`.
std::string obstacleVelocityName(const std::string& interface);
std::string searchName(const InterfaceSettings& interface);
std::string roleName(const std::string& interface);
std::string separationName(const std::string& interface);
std::string slaveName(const std::string& interface);
std::string stiffnessName(const std::string& interface);
std::string adjustName(const std::string& tie);
/// Returns the option of the search distance with its value in words, for messages.
std::string searchText(const InterfaceSettings& interface);

}  // namespace squeal::interfaces
