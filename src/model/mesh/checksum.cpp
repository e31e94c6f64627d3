// SPDX-License-Identifier: BSD-2-Clause
#include "base/checkpoint/checkpoint.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/text.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::mesh {

std::string checksum(const Mesh& mesh) {
  unsigned long sum = 0;
  const auto add = [&](const auto& entries) {
    sum = checkpoint::checksum(entries.data(), entries.size() * sizeof entries[0], sum);
  };
  add(mesh.coordinates);
  add(mesh.globalNode);
  for (const auto& block : mesh.cells) add(block.nodes), add(block.material);
  add(concatenated(mesh.comm, std::vector<unsigned long>{sum}));
  return formatted("checksum %08lx", sum);
}

}  // namespace squeal::mesh
