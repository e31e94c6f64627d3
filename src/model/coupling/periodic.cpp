// SPDX-License-Identifier: BSD-2-Clause
#include "model/coupling/periodic.hpp"

#include <algorithm>

#include "base/petsc/check.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::coupling {
namespace {

using mesh::Point;
using mortar::Face;

/// Adds a translation unless it is zero or already in the list, within the digits of a mesh file.
void add(const Point& shift, double tolerance, std::vector<Point>& list) {
  const auto same = [&](const Point& other) {
    return mesh::length(mesh::minus(shift, other)) <= tolerance;
  };
  if (!same({0, 0, 0}) && std::none_of(list.begin(), list.end(), same)) list.push_back(shift);
}

/// Collective. Returns the ascending list of all ranks' translations.
std::vector<Point> gathered(MPI_Comm comm, const std::vector<Point>& mine) {
  auto all = concatenated(comm, mine);
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

std::vector<Point> translations(const mesh::Mesh& mesh, const std::vector<Face>& first,
                                const std::vector<Face>& second) {
  std::vector<int> bears(mesh.parts, 0);
  for (const auto* faces : {&first, &second})
    for (const auto& face : *faces)
      for (int part : face.parts) bears[part] = 1;
  double longest = 0;
  for (const auto& image : mesh.images) longest = std::max(longest, mesh::length(image.shift));
  mpi::reduce<int>(mesh.comm, bears, MPI_MAX);
  longest = mpi::max(mesh.comm, longest);
  if (longest == 0) return {};
  const double tolerance = 1e-4 * longest;  // tolerance of the pairing of nodes
  std::vector<Point> mine, ways, all;
  for (const auto& image : mesh.images)
    if (bears[mesh.nodePart[image.node]]) add(image.shift, tolerance, mine);
  for (const auto& shift : gathered(mesh.comm, mine)) add(shift, tolerance, ways);
  ways.push_back({0, 0, 0});
  for (const auto& a : ways)
    for (const auto& b : ways) add(mesh::minus(a, b), tolerance, all);
  return all;
}

std::vector<Face> repeated(std::vector<Face> faces, const std::vector<Point>& translations) {
  const std::size_t count = faces.size();
  for (const auto& shift : translations)
    for (std::size_t i = 0; i < count; ++i) {
      Face copy = faces[i];
      for (auto& point : copy.points) point = mesh::plus(point, shift);
      faces.push_back(std::move(copy));
    }
  return faces;
}

}  // namespace squeal::coupling
