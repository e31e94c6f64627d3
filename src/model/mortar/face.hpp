// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A boundary face with its geometry. It is independent of the mesh, so it can be sent to the rank
/// that integrates over it.
#include <string>
#include <vector>

#include "base/system/stream.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::mortar {

using mesh::Point;

struct Face {
  int type = 0;  ///< gmsh element type: a line in plane problems, otherwise a surface
  std::vector<PetscInt> nodes;  ///< [node] global number, in gmsh's order
  std::vector<int> parts;       ///< [node] connected part of the mesh
  std::vector<Point> points;    ///< [node] coordinates, m
  int sign = 1;  ///< +1 if the normal by node order points out of the body, −1 if it points into it
  int body = -1;      ///< index into Mesh::bodies
  int material = -1;  ///< index into Mesh::materialGroups
};

void fields(Stream& stream, Face& face);

/// Returns the faces of a surface group on this rank, each with the body of the cell that it
/// bounds. Images of periodic nodes have their own numbers. Not collective. Throws Error if no
/// option names the surface.
std::vector<Face> facesOf(const mesh::Mesh& mesh, const std::string& surface);

}  // namespace squeal::mortar
