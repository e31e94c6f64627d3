#include "fuzz/fuzz.hpp"
#include "model/mesh/gmsh_model.hpp"
#include "support/mesh_text.hpp"

namespace squeal::fuzz {

Target target() {
  return {"unv", ".unv", {test::quadranglesUnv()}, [](const std::string& path) {
            mesh::GmshModel(path, {}).group("layer", "the fuzzer");
          }};
}

}  // namespace squeal::fuzz
