#pragma once
/// These functions read the contact interfaces: their surfaces, their rigid obstacles and how their
/// sides are paired.
#include <optional>
#include <string>
#include <vector>

#include "model/mesh/mesh.hpp"

namespace squeal::interfaces {

using mesh::Point;

/// The side of an interface whose nodes have the gaps.
enum class SlaveChoice { finer, pad, disc };

/// A Role tells what the two sides of an interface do to each other. All but tied ones may open.
enum class Role {
  sliding,       ///< friction along the sliding velocity
  sticking,      ///< no tangential jump
  frictionless,  ///< no tangential force
  tied           ///< no jump at all
};

/// Returns the value of `-contact_<interface>_role` for a role.
std::string text(Role role);

/// A coefficient of friction at the swept one f: fixed + swept · f.
struct Coefficient {
  double fixed = 0, swept = 0;

  double at(double friction) const { return fixed + swept * friction; }
  /// Returns the factor of f^exponent: fixed for 0, swept for 1.
  double part(int exponent) const { return exponent == 0 ? fixed : swept; }
};

/// One interface as the options give it: contact, or a tie of two bodies.
struct InterfaceOptions {
  mesh::InterfaceRequest surfaces;  ///< of a tie: the slave as pad, the master as disc
  Role role = Role::sliding;
  Point obstacleVelocity{};      ///< m/s, of the rigid obstacle in place of a disc
  Point obstacleDisplacement{};  ///< m
  SlaveChoice slave = SlaveChoice::finer;
  double searchDistance = 0;  ///< m; zero stands for half the size of a face
  Coefficient friction;       ///< of a sliding interface; zero on others
  /// Coefficient of friction up to which the nodes of a sticking interface may be held; none: any.
  std::optional<double> stickingLimit;
  bool releases = false;       ///< nodes of a sticking interface slide where they exceed this limit
  bool gapIsMeasured = false;  ///< the gap without load is the distance of the surfaces
  double gap = 0;       ///< gap without load if it is not measured, m; negative: interference
  bool adjust = false;  ///< of a tie: its nodes are moved onto the master

  /// Returns true for a tie, false for contact, be its role tied or not.
  bool isTie() const { return surfaces.pad.option.starts_with("-tie_"); }
  bool onObstacle() const { return surfaces.disc.name.empty(); }
  bool isTied() const { return role == Role::tied; }
  /// Returns "interface 'pad'" or "tie 'lining'", for messages.
  std::string label() const;
};

/// Not collective. Returns the contact interfaces and the ties that the options ask for, for the
/// mesh reader. Throws Error for an interface without a pad surface, for one with neither or both
/// of a disc surface and an obstacle, and for a tie without one of its sides.
std::vector<mesh::InterfaceRequest> readInterfaces();
/// Not collective. Returns the interfaces with all their options, in the same order: contact, then
/// ties. Throws Error for options that do not go together.
std::vector<InterfaceOptions> readInterfaceOptions(int dimension);
/// These return names of options of an interface with their dash, for messages:
/// `-contact_<interface>_obstacle_velocity`, `-contact_<interface>_search` or
/// `-tie_<name>_tolerance`, `-contact_<interface>_role`, and `-tie_<name>_adjust`.
std::string obstacleVelocityName(const std::string& interface);
std::string searchName(const InterfaceOptions& interface);
std::string roleName(const std::string& interface);
std::string adjustName(const std::string& tie);
/// Returns the option of the search with its value in words, for messages.
std::string searchText(const InterfaceOptions& interface);

}  // namespace squeal::interfaces
