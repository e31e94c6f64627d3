// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Reference nodes with couplings, bushings, springs, masses, forces, local axes and equations.
#include <optional>
#include <string>

#include "fuzz/models/model.hpp"
#include "fuzz/random.hpp"

namespace squeal::fuzz {

/// The faces that joints hold.
struct JointFaces {
  std::string outer;                  ///< of the plate, or of the pad; no contact is there
  bool mayBeRigid = true;             ///< no node of this face is in a bond with several forms
  std::optional<std::string> second;  ///< of another body, or of the end of the pad
  Vector near{};                      ///< a place near the outer face, m
};

/// Adds joints to a model at random.
void addJoints(const JointFaces& faces, Random& random, Model& model);

}  // namespace squeal::fuzz
