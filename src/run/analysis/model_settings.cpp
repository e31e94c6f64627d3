// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/model_settings.hpp"

namespace squeal::analysis {

ModelSettings ModelSettings::given() {
  return {.materials = material::Settings::given(),
          .interfaces = interfaces::Settings::given(),
          .constraints = constraints::Settings::given(),
          .elasticity = elasticity::Settings::given(),
          .file = meshfile::Settings::given(),
          .mesh = mesh::Settings::given(),
          .contact = contact::Settings::given(),
          .idleFrames = frame::idleFrames()};
}

mesh::Request meshRequest(const ModelSettings& settings) {
  mesh::Request request;
  request.bodies = material::groupRequests(settings.materials);
  request.bodySections = material::sectionRequests(settings.materials);
  request.moving = elasticity::movingBodies(settings.elasticity);
  request.nodeGroups = constraints::constrainedGroups(settings.constraints);
  for (const auto& group : elasticity::groundedGroups(settings.elasticity))
    request.nodeGroups.push_back(group);
  for (const auto& group : attachments::attachedGroups(settings.elasticity.attachments))
    request.nodeGroups.push_back(group);
  request.sections = constraints::boltSections(settings.constraints);
  request.references = settings.constraints.references;
  request.surfaces = elasticity::loadedSurfaces(settings.elasticity);
  request.interfaces = interfaces::interfaceRequests(settings.interfaces);
  request.periodic = constraints::periodicPairs(settings.constraints);
  request.howToGiveMaterials = material::howToGiveMaterials();
  request.motionOptions = elasticity::motionOptions();
  return request;
}

}  // namespace squeal::analysis
