// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The code that OpenBLAS has chosen for the processor. OpenBLAS 0.3.20 to 0.3.24 take newer Intel
/// processors for a Prescott of 2004 (OpenBLAS issue 4267); dense products then take 4.6
/// times as long (measured). Debian 12 has OpenBLAS 0.3.21.
#include <string>

namespace squeal {

/// Returns OpenBLAS's name of the processor whose code it uses; empty with another BLAS.
std::string blasKernel();

/// Starts the program again with OPENBLAS_CORETYPE=SkylakeX, or Haswell without AVX-512, and does
/// not return, if OpenBLAS uses the code for Prescott although the processor can run one of these,
/// and OPENBLAS_CORETYPE is not set. Call it before MPI starts. Prints a warning if the start
/// fails. Debuggers and valgrind see a program that replaces itself; setting OPENBLAS_CORETYPE
/// avoids that.
void restartWithBlasKernel(char** arguments);

}  // namespace squeal
