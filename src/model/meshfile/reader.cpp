// SPDX-License-Identifier: BSD-2-Clause
#include "model/meshfile/reader.hpp"

#include "base/system/child.hpp"
#include "model/meshfile/serialization.hpp"

namespace squeal::meshfile {

Contents readInProgram(Job job, const ChildLimits& limits) {
  Stream question;
  question(job);
  Stream reply(inProgram("squeal_gmsh", limits, std::move(question).bytes()));
  Contents contents;
  reply(contents);
  return contents;
}

}  // namespace squeal::meshfile
