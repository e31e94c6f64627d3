// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of all folders of src/model, and the groups that they need from the mesh. Not
/// collective.
#include "model/constraints/settings.hpp"
#include "model/contact/settings.hpp"
#include "model/elasticity/settings.hpp"
#include "model/interfaces/settings.hpp"
#include "model/material/settings.hpp"
#include "model/mesh/mesh.hpp"
#include "model/mesh/settings.hpp"
#include "model/meshfile/settings.hpp"

namespace squeal::analysis {

struct ModelSettings {
  material::Settings materials;
  interfaces::Settings interfaces;
  constraints::Settings constraints;
  elasticity::Settings elasticity;
  meshfile::Settings file;
  mesh::Settings mesh;
  contact::Settings contact;
  std::vector<std::string> idleFrames;  ///< names of frames that no option uses

  /// Returns the settings that the options give. Throws Error under the conditions that the
  /// settings of each folder document.
  static ModelSettings given();
};

/// Returns the groups and interfaces that the settings need from the mesh.
mesh::Request meshRequest(const ModelSettings& settings);

}  // namespace squeal::analysis
