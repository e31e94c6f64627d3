// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Matrices and loads of springs, bushings and point masses, summed and separate.
#include <string>
#include <vector>

#include "base/petsc/owned.hpp"
#include "model/attachments/forms.hpp"
#include "model/elasticity/elasticity.hpp"

namespace squeal::elasticity {

/// Collective. Returns Σ factor δδᵀ over the forms, N×N; null if all factors are zero.
OwnedMat formMatrix(const mesh::Mesh& mesh, const std::vector<attachments::Form>& forms,
                    double attachments::Form::*factor);

/// Collective. Returns δ of each form for a nodal vector u, [form], the same on all ranks.
std::vector<double> formValues(const mesh::Mesh& mesh, const std::vector<attachments::Form>& forms,
                               Vec u);

/// The contribution of one stiffness, damping or mass to Bodies, on all nodal displacements: the
/// derivatives of matrices and loads with respect to a factor on this quantity. Null members do not
/// contribute.
struct AttachedPart {
  std::string parameter;  ///< name, such as bushing_hub_stiffness, spring_s_damping, mass_hub
  OwnedMat stiffness, damping, mass, gyroscopic;
  OwnedVec centrifugal, weight;
};
/// Collective. Returns the contributions of all springs, bushings and point masses.
std::vector<AttachedPart> attachedParts(const mesh::Mesh& mesh, const Bodies& bodies);

}  // namespace squeal::elasticity
