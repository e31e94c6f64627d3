// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Models of one and of two blocks for audits.
#include <string>

#include "support/model/blocks_apart.hpp"
#include "support/model/mesh_text.hpp"
#include "support/run/audited.hpp"

namespace squeal::test {

/// The supports of the two blocks, and their interface.
inline const std::string clampedBlocks =
    " -constraint_disc_low_clamped xyz -constraint_pad_high_clamped xyz ";
inline const std::string blockContact = " -contact_face_pad pad_low -contact_face_disc disc_high ";

/// Collective. Returns a mesh of one block, clamped below, with an obstacle at its upper face.
inline std::string oneBlock(const std::string& file, const mesh::Point& high,
                            const std::string& young, const std::string& density,
                            const std::string& poisson = "0.3") {
  BlockWriter writer;
  writer.add("box", {hex8, {2, 2, 2}, {0, 0, 0}, high, 0});
  return "-mesh_file " + writeFile(file, writer.text()) + material("box", young, poisson, density) +
         "-constraint_box_low_clamped xyz -contact_plate_pad box_high "
         "-contact_plate_obstacle_velocity 1,0,0 ";
}

/// Collective. Returns two blocks, 0.1 m long, with a gap, clamped at their far sides, without
/// their interface.
inline std::string twoBlocks(const std::string& file, double gap, int padCells = 2) {
  const auto options =
      blocksApart(file, {hex8, {2, 2, 1}, {0, 0, -0.05}, {0.1, 0.1, 0}, 0},
                  {hex8, {padCells, 2, 1}, {0, 0, gap}, {0.1, 0.1, gap + 0.05}, 0});
  return options.substr(0, options.find("-contact_")) + clampedBlocks;
}

}  // namespace squeal::test
