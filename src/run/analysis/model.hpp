// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The discrete model of a brake: its mesh, the matrices of its bodies, and its contact.
#include <mpi.h>

#include <memory>

#include "model/contact/contact.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/mesh/mesh.hpp"
#include "run/analysis/model_settings.hpp"
#include "run/audit/audit.hpp"

namespace squeal::analysis {

/// All members are empty for matrices from files.
struct Model {
  /// On the heap, so that its address does not change: contact and the steady states borrow it.
  std::unique_ptr<mesh::Mesh> mesh;
  elasticity::Bodies bodies;
  contact::Contact contact;

  /// Returns the active set in which all contact nodes of this rank are closed, and stick if their
  /// interface sticks.
  contact::ActiveSet bonded() const {
    return contact::ActiveSet::bonded(contact.interfaces.nodes.size());
  }
};

/// Collective. Reads the mesh, moves the nodes of adjusted ties, and assembles the bodies and their
/// contact. Does not tighten the bolts. Throws Error under the conditions that the stages document.
Model buildModel(MPI_Comm comm, const ModelSettings& settings);

/// Collective. Throws Error if a body is under-constrained (the message refers to the audit), or if
/// no interface slides or sticks.
void requireSupports(const Model& model);

/// Collective. Audits a model, and prints a line with the number of findings. `place` is added to
/// this line and states where the findings are.
audit::Audit auditModel(const Model& model, const ModelSettings& settings,
                        const std::string& place);

}  // namespace squeal::analysis
