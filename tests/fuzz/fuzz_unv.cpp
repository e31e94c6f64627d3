// SPDX-License-Identifier: BSD-2-Clause
#include "fuzz/fuzz.hpp"
#include "model/mesh/gmsh_model.hpp"
#include "support/model/mesh_text.hpp"

namespace squeal::fuzz {

Target target() {
  return {
      "unv", ".unv", {test::quadranglesUnv()}, [](const std::string& path) {
        mesh::GmshModel({.file = path, .parameters = {}, .shape = {}}).group("layer", "the fuzzer");
      }};
}

}  // namespace squeal::fuzz
