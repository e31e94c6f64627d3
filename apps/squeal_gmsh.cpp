// SPDX-License-Identifier: BSD-2-Clause
/// squeal_gmsh: the program that reads and meshes files with gmsh. squeal starts it (GmshModel); it
/// is the only program that loads gmsh's library.
#include <gmsh.h>

#include "base/system/child_work.hpp"
#include "base/system/process_memory.hpp"
#include "model/gmshreader/read.hpp"
#include "model/meshfile/serialization.hpp"

int main() {
  squeal::Assignment assignment;
  squeal::retainFreedMemory();
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);  // our own errors contain its messages
  assignment.perform([](std::vector<char> bytes, const squeal::Warn& warn) {
    squeal::Stream question(std::move(bytes));
    squeal::meshfile::Job job;
    question(job);
    squeal::meshfile::Contents contents = squeal::gmshreader::read(job, warn);
    squeal::Stream reply;
    reply(contents);
    return std::move(reply).bytes();
  });
}
