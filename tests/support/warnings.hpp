// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// What parts of the program print as warnings.
#include <gtest/gtest.h>

#include <string>

#include "base/petsc/check.hpp"

namespace squeal::test {

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

}  // namespace squeal::test
