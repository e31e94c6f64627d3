// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/idle_options.hpp"

#include <algorithm>

#include "base/session/stages.hpp"

namespace squeal::analysis {
namespace {

void warn(const mesh::Mesh& mesh, const std::string& option, const std::string& why) {
  printWarning(mesh.comm, "option " + option + " was not used: " + why);
}

void warnOfFrames(const mesh::Mesh& mesh, const ModelSettings& settings) {
  for (const auto& [name, frame] : settings.constraints.frames) {
    if (std::ranges::find(settings.idleFrames, name) != settings.idleFrames.end())
      warn(mesh, frame.firstOption, "no other option refers to the frame '" + name + "'");
    else if (!frame.cylindrical && !frame.originOption.empty())
      warn(mesh, frame.originOption, "the axes of a rectangular frame are the same everywhere");
  }
  for (const auto& mass : settings.elasticity.attachments.masses)
    if (!mass.frame.empty() && !mass.hasInertia && !mass.hasOffset)
      warn(mesh, attachments::massFrameName(mass.group), "the mass has no inertia and no offset");
}

void warnOfCouplings(const mesh::Mesh& mesh, const constraints::Settings& settings) {
  const std::string all = std::string("xyz").substr(0, mesh.dimension);
  for (const auto& coupling : settings.couplings) {
    if (coupling.pinned && std::ranges::none_of(coupling.groups, [&](const auto& group) {
          return mesh.reference(group) != nullptr;
        }))
      warn(mesh, constraints::pinnedName(coupling.name),
           "none of the coupled nodes is a reference node, so none has a rotation");
    if (!coupling.frame.empty() && std::ranges::all_of(all, [&](char letter) {
          return coupling.components.find(letter) != std::string::npos;
        }))
      warn(mesh, constraints::couplingFrameName(coupling.name), "all components are coupled");
  }
}

/// Warns of base motions without an effect: nothing slides, and nothing is convected.
void warnOfMotions(const mesh::Mesh& mesh, const ModelSettings& settings) {
  const auto& elasticity = settings.elasticity;
  const bool anyContact =
      !std::ranges::all_of(settings.interfaces.interfaces, &interfaces::InterfaceSettings::isTie);
  if (anyContact || elasticity.convective) return;
  for (const auto& [body, motion] : elasticity.motions)
    if (motion.moves && !(motion.speed != 0 && elasticity.centrifugal))
      warn(mesh, motion.option,
           motion.speed != 0 ? "without contact, -load_centrifugal and -motion_convective a motion "
                               "has no effect"
                             : "without contact and -motion_convective on a translation has no "
                               "effect");
}

}  // namespace

void warnOfIdleOptions(const mesh::Mesh& mesh, const ModelSettings& settings) {
  warnOfFrames(mesh, settings);
  warnOfCouplings(mesh, settings.constraints);
  warnOfMotions(mesh, settings);
  if (mesh.dimension == 3 && !settings.materials.planeOption.empty())
    warn(mesh, settings.materials.planeOption,
         "the mesh is solid, and this is about plane problems");
}

}  // namespace squeal::analysis
