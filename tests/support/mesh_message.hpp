// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// What the mesh reader says of a file.
#include <gtest/gtest.h>

#include "support/model.hpp"

namespace squeal::test {

/// Collective. The error of reading the file with these options; empty if it is read.
inline std::string messageOfMesh(const std::string& file, const std::string& options) {
  setOptions("-mesh_file " + file + " " + options);
  return errorOf([] { readMesh(); });
}

/// A message of one line with all these pieces.
inline void expectMessage(const std::string& message, const std::vector<std::string>& pieces) {
  EXPECT_NE(message, "");
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  for (const auto& piece : pieces)
    EXPECT_TRUE(contains(message, piece)) << "missing: " << piece << "\nin: " << message;
}

}  // namespace squeal::test
