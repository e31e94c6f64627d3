// SPDX-License-Identifier: BSD-2-Clause
#include "model/elasticity/carried_axes.hpp"

#include <algorithm>
#include <cmath>

#include "base/session/stages.hpp"
#include "base/system/error.hpp"
#include "base/system/mpi.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::elasticity {
namespace {

using material::Hooke;
using material::Law;
using mesh::Point;

/// Returns a vector, turned by an angle about a unit axis.
Point turned(const Point& x, const Point& n, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return mesh::plus(mesh::plus(mesh::scaled(x, c), mesh::cross(n, x), s), n,
                    (1 - c) * mesh::dot(n, x));
}

/// Returns the law in space; one in the plane without stiffness across it.
Hooke inSpace(const Hooke& law) {
  if (law.size == 6) return law;
  const int kept[] = {0, 1, 3};
  Hooke solid{6, std::vector<double>(36, 0.0)};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) solid.matrix[6 * kept[i] + kept[j]] = law(i, j);
  return solid;
}

/// Returns the largest difference of two laws, relative to the entries of the second.
double difference(const Hooke& one, const Hooke& other) {
  double largest = 0, difference = 0;
  for (std::size_t i = 0; i < other.matrix.size(); ++i) {
    largest = std::max(largest, std::abs(other.matrix[i]));
    difference = std::max(difference, std::abs(other.matrix[i] - one.matrix[i]));
  }
  return difference / largest;
}

/// Two laws are the same if they differ by less: axes are given with a limited number of digits.
constexpr double sameLaw = 1e-6;

/// Returns true if a step of round-off from x turns the axes of a material and changes its law.
bool isUndefinedAt(const material::Material& material, const Point& x, double step) {
  if (!material.law.varying) return false;
  const material::Axes axes = material.axes(x);
  Hooke here, there;
  for (int d = 0; d < 3; ++d)
    for (const double sign : {-1.0, 1.0}) {
      const Point place = mesh::plus(x, mesh::axis(d), sign * step);
      const material::Axes turned = material.axes(place);
      double least = 1;
      for (std::size_t k = 0; k < 3; ++k) least = std::min(least, mesh::dot(axes[k], turned[k]));
      if (least < 0.9 &&
          difference(material.law.at(place, there), material.law.at(x, here)) > sameLaw)
        return true;
    }
  return false;
}

/// Returns the mean position of the nodes of a cell.
Point centreOf(const mesh::Mesh& mesh, const mesh::CellBlock& block, std::size_t cell) {
  Point centre{};
  for (const PetscInt node : block.nodesOf(cell))
    centre = mesh::plus(centre, mesh.coordinates[node], 1.0 / block.nodesPerCell);
  return centre;
}

/// Returns true if the motion, after a while, brings the law at x to a place with this law.
bool isCarried(const Law& law, const Motion& motion, const Point& x) {
  // One radian: orthotropic axes are not the same after a turn by it, as they are by a half turn.
  const double angle = motion.speed != 0 ? 1 : 0;
  const Point place = mesh::plus(
      mesh::plus(motion.origin, turned(mesh::minus(x, motion.origin), motion.axis, angle)),
      motion.translation);
  material::Axes axes;
  for (int d = 0; d < 3; ++d) axes[d] = turned(mesh::axis(d), motion.axis, angle);
  Hooke here, there;
  const Hooke before = inSpace(law.at(x, here)), after = inSpace(law.at(place, there)),
              carried = material::rotated(before, axes);
  return difference(carried, after) <= sameLaw;
}

}  // namespace

void requireMaterialAxes(const mesh::Mesh& mesh, const std::vector<material::Material>& materials) {
  std::string failure;
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e) {
      const Point centre = centreOf(mesh, block, e);
      // Within round-off of the axis, a step of this size turns the radial direction.
      if (isUndefinedAt(materials[block.material[e]], centre, 2 * mesh.coincidence(centre)))
        failure = mesh.materialText(block.material[e]) +
                  ": the axis of the cylindrical axes of its material passes through the centre of "
                  "the cell at " +
                  mesh::text(centre) +
                  ", where the radial direction is not defined; place nodes on this axis, or leave "
                  "a hole around it";
    }
  failTogether(mesh.comm, failure);
}

void checkCarriedAxes(const mesh::Mesh& mesh, const std::vector<material::Material>& materials,
                      const std::vector<Motion>& motions, bool convective) {
  std::vector<int> wrong(materials.size(), 0), seen(materials.size(), 0);
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e) {
      const int m = block.material[e];
      const Motion& motion = motions[block.body[e]];
      if (seen[m]++ || !motion.moves()) continue;
      wrong[m] = !isCarried(materials[m].law, motion, centreOf(mesh, block, e));
    }
  mpi::reduce<int>(mesh.comm, wrong, MPI_MAX);
  for (std::size_t m = 0; m < wrong.size(); ++m) {
    if (!wrong[m]) continue;
    const std::string found =
        mesh.materialText(m) +
        " moves, and its matter would carry the axes of its material to other places; use "
        "cylindrical axes about the axis of rotation (-frame_<name>_axis)";
    if (convective)
      throw Error("option -motion_convective: " + found + ", or -motion_convective off");
    printWarning(mesh.comm, "warning: " + found + ", or read the result as that of this position");
  }
}

}  // namespace squeal::elasticity
