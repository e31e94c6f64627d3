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

/// Returns the fastest code of OpenBLAS that the processor can run, of those with AVX-512 (2017)
/// and with AVX2 (2013); null if it can run neither.
const char* fastest() {
#ifdef __x86_64__
  const bool avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512cd") &&
                      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vl");
  if (avx512) return "SkylakeX";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
#endif
  return nullptr;
}

}  // namespace

std::string blasKernel() {
  void* const name = dlsym(RTLD_DEFAULT, "openblas_get_corename");
  return name ? reinterpret_cast<char* (*)()>(name)() : "";
}

void restartWithBlasKernel(char** arguments) {
  const char* const code = fastest();
  if (std::getenv(variable) || blasKernel() != "Prescott" || !code) return;
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  setenv(variable, code, 1);  // OpenBLAS reads it when it is loaded
  if (!error) execv(program.c_str(), arguments);
  unsetenv(variable);
  std::fprintf(stderr,
               "squeal: warning: OpenBLAS does not know this processor, and dense products are "
               "slow; %s=%s makes them fast\n",
               variable, code);
}

}  // namespace squeal
