// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Settings of the materials of the bodies. Not collective: all ranks have the same options, and
/// therefore the same results and Errors.
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "model/material/hooke.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::material {

/// The axis of a body with cylindrical axes: axis 1 is radial, 2 tangential, 3 along it.
struct CylinderAxis {
  Point origin{};            ///< a point of the axis, m
  Point direction{0, 0, 1};  ///< unit vector
};

/// The elastic law and the axes of an anisotropic body.
struct Anisotropy {
  Hooke stiffness;  ///< in the axes of the material, 6×6
  std::variant<Axes, CylinderAxis> axes;
  bool general = false;  ///< it is not orthotropic in these axes
  std::string option;    ///< that gives the constants, with its dash, for messages
};

/// The material of one body.
struct BodySettings {
  double young = 0;                      ///< Young's modulus of an isotropic body, Pa
  double poisson = 0;                    ///< Poisson's ratio of an isotropic body
  std::optional<Anisotropy> anisotropy;  ///< in place of young and poisson
  double density = 0;                    ///< kg/m³
  double massDamping = 0;                ///< α, 1/s: C = α M + …
  double stiffnessDamping = 0;           ///< β + η / (2π f), s: C = … + (β + η / (2π f)) K
  bool reducedIntegration = false;       ///< of the stiffness of hex20 cells
};

struct Settings {
  bool planeStress = false;                    ///< of plane problems; otherwise plane strain
  std::map<std::string, BodySettings> bodies;  ///< [volume group], those with an elastic law

  /// Reads the options. Throws Error if no group has a law, for a group with other options but no
  /// law, for a wrong or missing option, for options of different laws, and for constants without
  /// positive strain energy.
  static Settings given();
};

/// Returns the volume groups with a material, for the mesh reader.
std::vector<mesh::GroupRequest> groupRequests(const Settings& settings);
/// Returns the options that give a material, for messages: "give -…".
std::string howToGiveMaterials();
/// Return names of options of a body, with their dash, for messages:
/// `-material_<group>_orientation` and `-material_<group>_cylindrical`.
std::string orientationName(const std::string& body);
std::string cylindricalName(const std::string& body);
/// Returns the same for `-material_<group>_integration`.
std::string integrationName(const std::string& body);

}  // namespace squeal::material
