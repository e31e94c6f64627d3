// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Errors that parts of the program throw and warnings that they print.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/petsc/check.hpp"
#include "base/system/error.hpp"

namespace squeal::test {

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The message of the Error that `action` throws; empty if none.
template <class Action>
std::string errorOf(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// Collective. What rank 0 prints on the standard error output during `action`, on all ranks.
template <class Action>
std::string warningsOf(const Action& action) {
  testing::internal::CaptureStderr();
  action();
  std::string text = testing::internal::GetCapturedStderr();
  int length = text.size();
  check(MPI_Bcast(&length, 1, MPI_INT, 0, PETSC_COMM_WORLD));
  text.resize(length);
  check(MPI_Bcast(text.data(), length, MPI_CHAR, 0, PETSC_COMM_WORLD));
  return text;
}

/// A message of one line with all these pieces.
inline void expectMessage(const std::string& message, const std::vector<std::string>& pieces) {
  EXPECT_NE(message, "");
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  for (const auto& piece : pieces)
    EXPECT_TRUE(contains(message, piece)) << "missing: " << piece << "\nin: " << message;
}

}  // namespace squeal::test
