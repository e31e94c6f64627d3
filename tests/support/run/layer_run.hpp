// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The case `layer` on a coarser mesh with fewer modes. For tests on one rank.
#include <string>

#include "support/harness/program.hpp"

namespace squeal::test {

inline const std::string coarseLayer =
    "-options_file options/layer.yaml -mesh_set nx=12,ny=4 -modes_count 21 ";
inline const std::string frictions = "-flutter_friction 0.4,0,0.2 ";

/// Runs it on two ranks over these frictions, into a subfolder of the folder of a test.
inline ProgramRun runLayer(const std::string& test, const std::string& options = "") {
  return runProgram(test + "/layer", 2, coarseLayer + frictions + options);
}

}  // namespace squeal::test
