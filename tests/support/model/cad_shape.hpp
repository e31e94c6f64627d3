// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A shape as a CAD program writes it: a plate with a block on it.
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>

#include "support/model/gmsh_library.hpp"
#include "support/model/model.hpp"

namespace squeal::test {

/// Collective. Writes the shape and returns its path: a plate of 100 × 100 × 10, z from 0 to 10,
/// the solid `disc`, and on it a block of 40 × 40 × 5, the solid `brake pad`. In a STEP file the
/// lower face of the plate has the label `bottom`, the upper one of the block `top`, and the two
/// faces of the plate at its smallest and largest x are both `side`. gmsh numbers the upper face of
/// the plate 6 and the lower one of the block 11. `unit` is that of the STEP file, as it writes it.
inline std::string plateAndBlock(const std::string& name,
                                 const std::string& unit = "SI_UNIT(.MILLI.,.METRE.)") {
  const std::string path = SQUEAL_OUTPUT_DIR "/" + name;
  int rank = 0;
  check(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  if (rank == 0) {
    startGmsh();
    gmsh::clear();
    gmsh::model::occ::addBox(0, 0, 0, 100, 100, 10);
    gmsh::model::occ::addBox(30, 30, 10, 40, 40, 5);
    gmsh::model::occ::synchronize();
    gmsh::write(path);
    gmsh::clear();
    if (std::filesystem::path(name).extension() == ".step") {
      std::stringstream text;
      text << std::ifstream(path).rdbuf();
      // gmsh writes no labels. OpenCASCADE calls products by a number; faces follow each other in
      // the order of their numbers.
      std::string step = text.str();
      const std::string product = "'Open CASCADE STEP translator [0-9.]+ [0-9]+";
      step = std::regex_replace(step, std::regex(product + "\\.1'"), "'disc'");
      step = std::regex_replace(step, std::regex(product + "\\.2'"), "'brake pad'");
      step = std::regex_replace(step, std::regex("SI_UNIT\\(\\.MILLI\\.,\\.METRE\\.\\)"), unit);
      const std::string face = "ADVANCED_FACE('";
      std::size_t at = 0;
      for (const char* label : {"side", "side", "", "", "bottom", "", "", "", "", "", "", "top"}) {
        at = step.find(face, at) + face.size();
        step.insert(at, label);
      }
      std::ofstream(path) << step;
    }
  }
  check(MPI_Barrier(PETSC_COMM_WORLD));
  return path;
}

}  // namespace squeal::test
