// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Settings of the materials of the bodies. Not collective: all ranks have the same options, and
/// therefore the same results and Errors.
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "model/frame/settings.hpp"
#include "model/material/hooke.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::material {

/// The axis of cylindrical material axes: axis 1 is radial, axis 2 tangential, and axis 3 along
/// this axis.
struct CylinderAxis {
  Point origin{};            ///< a point of the axis, m
  Point direction{0, 0, 1};  ///< unit vector
};

/// The name of a frame whose axes x, y, z are the axes 1, 2, 3 of the material.
struct FrameName {
  std::string name;
};

/// The elastic law and the axes of an anisotropic material.
struct Anisotropy {
  Hooke stiffness;  ///< in the axes of the material, 6×6
  std::variant<Axes, CylinderAxis, FrameName> axes;
  bool general = false;    ///< the material is not orthotropic in these axes
  std::string option;      ///< option that gives the constants, with its dash, for messages
  std::string axesOption;  ///< option that gives the axes, or could give them
};

/// The material of one body, or of one section of a body.
struct BodySettings {
  double young = 0;                      ///< Young's modulus of an isotropic material, Pa
  double poisson = 0;                    ///< Poisson's ratio of an isotropic material
  std::optional<Anisotropy> anisotropy;  ///< in place of young and poisson
  double density = 0;                    ///< kg/m³
  double massDamping = 0;                ///< α, 1/s: C = α M + …
  double stiffnessDamping = 0;           ///< β + η / (2π f), s: C = … + (β + η / (2π f)) K
  bool reducedIntegration = false;       ///< reduced rule for the stiffness of hex20 cells
};

struct Settings {
  bool planeStress = false;  ///< plane problems are in plane stress; otherwise in plane strain
  /// [volume group] materials of the bodies without sections, and of all sections.
  std::map<std::string, BodySettings> bodies;
  std::map<std::string, std::vector<std::string>> sections;  ///< [body] its sections
  std::map<std::string, frame::FrameSettings> frames;        ///< [name]
  std::string planeOption;  ///< the option of `planeStress` if it is given, with its dash

  /// Reads the options. Throws Error if no group has a law, for a group with other options but no
  /// law, for a wrong or missing option, for options of different laws, for constants without
  /// positive strain energy, for a section that belongs to two bodies or has sections of its own,
  /// and for an option of a body that all sections of the body override.
  static Settings given();
};

/// Returns the bodies, sorted by name, for the mesh reader.
std::vector<mesh::GroupRequest> groupRequests(const Settings& settings);
/// Returns the sections of bodies, [body], for the mesh reader.
std::map<std::string, std::vector<mesh::GroupRequest>> sectionRequests(const Settings& settings);
/// Returns the options that give a material, for messages: "give -…".
std::string howToGiveMaterials();
/// Returns the option `-material_<group>_integration` of a body or section, for messages.
std::string integrationName(const std::string& group);

}  // namespace squeal::material
