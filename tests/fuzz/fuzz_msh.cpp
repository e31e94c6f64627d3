// SPDX-License-Identifier: BSD-2-Clause
#include "fuzz/fuzz.hpp"

#include <filesystem>
#include <fstream>

#include "model/mesh/gmsh_model.hpp"
#include "support/model/gmsh_library.hpp"
#include "support/model/mesh_text.hpp"

namespace squeal::fuzz {

Target target() {
  const std::string two = test::quadranglesMsh2(), four = test::quadranglesMsh4();
  const auto binary = [](const std::string& text, double version) {
    return bytesWritten([&](const std::string& path) {
      const std::string from = path + "_text.msh", to = path + "_binary.msh";
      std::ofstream(from) << text;
      test::writeBinaryMsh(from, to, version);
      std::filesystem::rename(to, path);
      std::filesystem::remove(from);
    });
  };
  return {
      "msh", ".msh", {two, four, binary(two, 2.2), binary(four, 4.1)}, [](const std::string& path) {
        mesh::GmshModel({.file = path, .parameters = {}, .shape = {}}).group("layer", "the fuzzer");
      }};
}

}  // namespace squeal::fuzz
