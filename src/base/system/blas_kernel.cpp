// SPDX-License-Identifier: BSD-2-Clause
#include "base/system/blas_kernel.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace squeal {
namespace {

constexpr const char* variable = "OPENBLAS_CORETYPE";

/// Returns true if the processor has the instructions of a Haswell (2013).
bool canRunHaswell() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

}  // namespace

std::string blasKernel() {
  void* const name = dlsym(RTLD_DEFAULT, "openblas_get_corename");
  return name ? reinterpret_cast<char* (*)()>(name)() : "";
}

void restartWithBlasKernel(char** arguments) {
  if (std::getenv(variable) || blasKernel() != "Prescott" || !canRunHaswell()) return;
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  setenv(variable, "Haswell", 1);  // OpenBLAS reads it when it is loaded
  if (!error) execv(program.c_str(), arguments);
  unsetenv(variable);
  std::fprintf(stderr,
               "squeal: warning: OpenBLAS does not know this processor, and dense products are "
               "slow; %s=Haswell makes them fast\n",
               variable);
}

}  // namespace squeal
