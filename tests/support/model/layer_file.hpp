// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Mesh files with one body, `layer`, such as those of mesh_text.hpp.
#include <string>

#include "support/model/model.hpp"

namespace squeal::test {

inline const std::string layer = material("layer", "1", "0.3", "1");

/// Collective. The error at the reading of a mesh file with these options; empty if there is none.
inline std::string messageOf(const std::string& file, const std::string& options = layer) {
  return messageOfMesh(file, options);
}

}  // namespace squeal::test
