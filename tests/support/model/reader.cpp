// SPDX-License-Identifier: BSD-2-Clause
/// The module squeal_test_reader: the reader of the program `squeal_gmsh` for readInCopy().
#include <gmsh.h>

#include "base/system/child.hpp"
#include "model/gmshreader/read.hpp"
#include "model/meshfile/serialization.hpp"

extern "C" void squealTestRead(squeal::meshfile::Job& job, const squeal::ChildLimits& limits,
                               squeal::meshfile::Contents& contents) {
  squeal::Stream reply(squeal::inChild(limits, [&](const squeal::Warn& warn) {
    gmsh::initialize(0, nullptr, false);  // without effect if the test has done so
    gmsh::finalize();                     // and with it the options that the test has set
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    squeal::meshfile::Contents read = squeal::gmshreader::read(job, warn);
    squeal::Stream stream;
    stream(read);
    return std::move(stream).bytes();
  }));
  reply(contents);
}
