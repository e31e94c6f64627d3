// SPDX-License-Identifier: BSD-2-Clause
#include "run/audit/cells.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/elasticity/assembly.hpp"
#include "model/elasticity/jacobian.hpp"
#include "model/interfaces/algebra.hpp"

namespace squeal::audit {
namespace {

using mesh::Point;

/// Returns the largest condition number of the Jacobian at the points of the rule with a positive
/// determinant.
double conditionOf(const elasticity::ShapeTable& table, const std::vector<Point>& nodes) {
  double largest = 0;
  for (int q = 0; q < table.points(); ++q) {
    const auto j =
        elasticity::jacobian(table.gradient.data() + 3 * q * table.nodes, nodes, table.dimension);
    const double det = mesh::determinant(j);
    if (!(det > 0)) continue;
    const auto inverse = mesh::inverse(j, det);
    double norms[2] = {0, 0};
    for (int a = 0; a < table.dimension; ++a)
      for (int b = 0; b < table.dimension; ++b)
        norms[0] += j[a][b] * j[a][b], norms[1] += inverse[a][b] * inverse[a][b];
    largest = std::max(largest, std::sqrt(norms[0] * norms[1]) / table.dimension);
  }
  return largest;
}

WorstCell cellOf(double value, const mesh::CellBlock& block, std::size_t e,
                 const std::vector<Point>& nodes) {
  Point mean{};
  for (const auto& node : nodes) mean = mesh::plus(mean, node, 1.0 / nodes.size());
  return {value, block.tag[e], block.type, mean};
}

/// Collective. Replaces the cell of each body by the one of all ranks with the smallest `sign`
/// times its value.
void reduceWorst(MPI_Comm comm, std::vector<CellQuality>& quality, WorstCell CellQuality::*member,
                 double sign) {
  std::vector<WorstCell> own;
  for (const auto& body : quality) own.push_back(body.*member);
  const auto all = concatenated(comm, own);
  const auto key = [sign](const WorstCell& cell) {  // ranks without cells of the body have no type
    return std::tuple(cell.type == 0, sign * cell.value, cell.tag);
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    WorstCell& worst = quality[i % quality.size()].*member;
    if (key(all[i]) < key(worst)) worst = all[i];
  }
}

std::string cellText(const WorstCell& cell) {
  return formatted("cell %" PetscInt_FMT " (%s) at %s", cell.tag,
                   element::shapeTable(cell.type).name.c_str(),
                   interfaces::text(cell.place).c_str());
}

}  // namespace

std::vector<CellQuality> cellQuality(const mesh::Mesh& mesh) {
  std::vector<CellQuality> quality(mesh.bodies.size());
  std::vector<PetscInt> counts(2 * quality.size(), 0);
  elasticity::forEachCell(
      mesh, [&](const mesh::CellBlock& block, std::size_t e, const elasticity::ShapeTable& table,
                const std::vector<Point>& nodes) {
        const int b = block.body[e];
        const auto ratio = cellOf(elasticity::jacobianRatio(block.type, nodes), block, e, nodes);
        const auto aspect = cellOf(conditionOf(table, nodes), block, e, nodes);
        auto& [worst, longest, folded, elongated] = quality[b];
        counts[2 * b] += ratio.value < smallestRatio;
        counts[2 * b + 1] += aspect.value > largestAspect;
        if (worst.type == 0 || std::tie(ratio.value, ratio.tag) < std::tie(worst.value, worst.tag))
          worst = ratio;
        if (longest.type == 0 || aspect.value > longest.value ||
            (aspect.value == longest.value && aspect.tag < longest.tag))
          longest = aspect;
      });
  reduceWorst(mesh.comm, quality, &CellQuality::jacobian, 1);
  reduceWorst(mesh.comm, quality, &CellQuality::aspect, -1);
  mpi::reduce<PetscInt>(mesh.comm, counts, MPI_SUM);
  for (std::size_t b = 0; b < quality.size(); ++b)
    quality[b].folded = counts[2 * b], quality[b].elongated = counts[2 * b + 1];
  return quality;
}

Findings cellFindings(const Subject& model, const std::vector<CellQuality>& quality) {
  Findings findings;
  const auto& mesh = model.mesh;
  for (std::size_t b = 0; b < quality.size(); ++b) {
    const auto& [jacobian, aspect, folded, elongated] = quality[b];
    const std::string of = " of body '" + mesh.bodies[b] + "' ";
    if (folded > 0)
      findings.push_back(
          {Kind::cells, jacobian.value > 0 ? Severity::note : Severity::warning,
           "in " + counted(folded, "cell") + of +
               formatted("the Jacobian falls below %g of its largest value, at worst to %.2g in %s",
                         smallestRatio, jacobian.value, cellText(jacobian).c_str()),
           "mesh again there, or straighten the edges of such cells: -mesh_straighten bad"});
    if (elongated > 0)
      findings.push_back({Kind::cells, Severity::note,
                          counted(elongated, "flat or long cell") + of +
                              formatted("with an aspect above %g, at worst %.3g in %s",
                                        largestAspect, aspect.value, cellText(aspect).c_str()),
                          "mesh again there with edges of similar lengths"});
  }
  const auto linear = elasticity::linearCells(mesh, model.bodies.settings);
  for (std::size_t m = 0; m < linear.size(); ++m)
    if (const double poisson = model.bodies.materials[m].poisson;
        elasticity::locks(poisson) && linear[m] > 0)
      findings.push_back(
          {Kind::locking, Severity::warning,
           formatted("%s is nearly incompressible, with a Poisson's ratio of %.6g, and has "
                     "%s, which lock",
                     mesh.materialText(m).c_str(), poisson,
                     counted(linear[m], "linear cell").c_str()),
           "use a mesh of second order, or -elasticity_incompatible_modes for hex8 and quad4"});
  return findings;
}

}  // namespace squeal::audit
