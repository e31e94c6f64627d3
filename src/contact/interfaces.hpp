#pragma once
/// These functions read the contact interfaces: their surfaces, their rigid obstacles and how their
/// sides are paired.
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace squeal::contact {

using mesh::Point;

/// The side of an interface whose nodes have the gaps.
enum class SlaveChoice { finer, pad, disc };

/// One interface as the options give it.
struct InterfaceOptions {
  mesh::InterfaceRequest surfaces;
  Point obstacleVelocity{};      ///< m/s, of the rigid obstacle in place of a disc
  Point obstacleDisplacement{};  ///< m
  SlaveChoice slave = SlaveChoice::finer;
  double searchDistance = 0;  ///< m; zero stands for half the size of a face

  bool onObstacle() const { return surfaces.disc.name.empty(); }
};

/// Not collective. Returns the contact interfaces that the options ask for, for the mesh reader.
/// Throws Error for an interface without a pad surface, and for one with neither or both of a disc
/// surface and an obstacle.
std::vector<mesh::InterfaceRequest> readInterfaces();
/// Not collective. Returns the interfaces with all their options, in the same order.
std::vector<InterfaceOptions> readInterfaceOptions(int dimension);
/// Returns "-contact_<interface>_obstacle_velocity" and the like of this interface, for messages.
std::string obstacleVelocityName(const std::string& interface);
std::string padName(const std::string& interface);
std::string searchName(const std::string& interface);

}  // namespace squeal::contact
