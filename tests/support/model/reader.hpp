// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Reads meshes in a copy of the test program. The program `squeal_gmsh` takes some 0.08 s for each
/// to load gmsh; a test program loads it once.
#include <dlfcn.h>

#include "base/system/error.hpp"
#include "model/meshfile/reader.hpp"

namespace squeal::test {

/// Not collective. The Reader of the module squeal_test_reader, which the first call loads.
inline meshfile::Contents readInCopy(meshfile::Job job, const ChildLimits& limits) {
  using Read = void (*)(meshfile::Job&, const ChildLimits&, meshfile::Contents&);
  static const auto read = [] {
    void* module = dlopen(SQUEAL_TEST_READER, RTLD_LAZY | RTLD_LOCAL);
    void* function = module ? dlsym(module, "squealTestRead") : nullptr;
    if (!function) throw Error(dlerror());
    return reinterpret_cast<Read>(function);
  }();
  meshfile::Contents contents;
  read(job, limits, contents);
  return contents;
}

}  // namespace squeal::test
