// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Serialisation of a job for gmsh and of its result.
#include "base/system/stream.hpp"
#include "model/meshfile/contents.hpp"
#include "model/meshfile/job.hpp"

namespace squeal::meshfile {

void fields(Stream& stream, ElementBlock& block);
void fields(Stream& stream, GroupElements& group);
void fields(Stream& stream, Contents& contents);
void fields(Stream& stream, Format& format);
void fields(Stream& stream, GeometryParameter& parameter);
void fields(Stream& stream, ShapeMesh& shape);
void fields(Stream& stream, Job& job);

}  // namespace squeal::meshfile
