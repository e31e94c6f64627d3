// SPDX-License-Identifier: BSD-2-Clause
#include "model/ties/adjustment.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/petsc/arrays.hpp"
#include "base/session/stages.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/elasticity/element.hpp"
#include "model/element/shape.hpp"
#include "model/interfaces/algebra.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::ties {

using namespace interfaces;

namespace {

using mesh::length;
using mesh::plus;

/// The moves of the masters of this rank's tied nodes, on any rank.
class MasterMoves {
 public:
  /// Collective.
  MasterMoves(const mesh::Mesh& mesh, const std::vector<TiedNode>& tied) {
    for (const auto& node : tied)
      for (const auto& master : node.connection.masters) masters_.push_back(master.node);
    std::sort(masters_.begin(), masters_.end());
    masters_.erase(std::unique(masters_.begin(), masters_.end()), masters_.end());
    OwnedIS nodes;
    check(VecCreateMPI(mesh.comm, 3 * mesh.ownedNodes, PETSC_DETERMINE, all_.out()));
    check(VecCreateSeq(PETSC_COMM_SELF, 3 * masters_.size(), found_.out()));
    check(ISCreateBlock(PETSC_COMM_SELF, 3, masters_.size(), masters_.data(), PETSC_COPY_VALUES,
                        nodes.out()));
    check(VecScatterCreate(all_, nodes, found_, nullptr, scatter_.out()));
  }
  /// Collective. Takes the moves of the owned nodes, [local node].
  void set(const std::vector<Point>& moves) {
    {
      const WriteArray values(all_);
      for (PetscInt i = 0; i < values.size(); ++i) values[i] = moves[i / 3][i % 3];
    }
    check(VecScatterBegin(scatter_, all_, found_, INSERT_VALUES, SCATTER_FORWARD));
    check(VecScatterEnd(scatter_, all_, found_, INSERT_VALUES, SCATTER_FORWARD));
  }
  /// Returns Σ P_il v_l of the moves v.
  Point mean(const Connection& slave) const {
    const ReadArray values(found_);
    Point sum{};
    for (const auto& [node, weight] : slave.masters) {
      const auto at = std::lower_bound(masters_.begin(), masters_.end(), node) - masters_.begin();
      for (std::size_t d = 0; d < 3; ++d) sum[d] += weight * values[3 * at + d];
    }
    return sum;
  }

 private:
  std::vector<PetscInt> masters_;
  OwnedVec all_, found_;
  OwnedScatter scatter_;
};

std::vector<Point> picked(const std::vector<Point>& all, std::span<const PetscInt> nodes) {
  std::vector<Point> some;
  for (PetscInt node : nodes) some.push_back(all[node]);
  return some;
}

/// The displacement of each node from its position in the file, [local node], m.
using Moves = std::vector<Point>;

/// Collective. Sends the moves of the primaries from their owners to all ranks and images.
void share(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange, Moves& moves) {
  std::vector<double> values(moves.size());
  for (std::size_t d = 0; d < 3; ++d) {
    for (PetscInt i = 0; i < mesh.localNodes(); ++i) {
      const bool isOurs = i < mesh.ownedNodes && exchange.primary(i) == mesh.globalNode[i];
      values[i] = isOurs ? moves[i][d] : 0;
    }
    exchange.sum(values);
    for (std::size_t i = 0; i < moves.size(); ++i) moves[i][d] = values[i];
  }
}

/// Collective. Returns the moves of the tied nodes, zero elsewhere:
///   v_i = Σ P_il x_l − x_i + Σ P_il v_l.
Moves movesOfTied(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange,
                  const Interfaces& ties) {
  Moves moves(mesh.localNodes(), Point{});
  MasterMoves masters(mesh, ties.tied);
  for (int level = 1; level <= ties.levels; ++level) {
    masters.set(moves);
    for (const auto& [interface, connection, parts, offset, apart] : ties.tied)
      if (connection.level == level && ties.options[interface].adjust)
        moves[connection.node] = plus(offset, masters.mean(connection));
  }
  share(mesh, exchange, moves);
  return moves;
}

/// Collective. Adds the moves of the nodes that follow the corners of their cells.
void moveWithCorners(const mesh::Mesh& mesh, const coupling::NodeExchange& exchange, Moves& moves) {
  std::vector<double> onSurface(mesh.localNodes(), 0.0);
  for (const auto& block : mesh.faces)
    for (PetscInt node : block.nodes) onSurface[node] = 1;
  exchange.largest(onSurface);
  for (const auto& block : mesh.cells) {
    const std::size_t corners = element::shapeTable(block.type).corners;
    for (std::size_t e = 0; e < block.tag.size(); ++e) {
      const auto nodes = block.nodesOf(e);
      const auto linear = elasticity::straightened(block.type, picked(moves, nodes));
      for (std::size_t i = corners; i < nodes.size(); ++i)
        if (onSurface[nodes[i]] == 0) moves[nodes[i]] = linear[i];
    }
  }
  share(mesh, exchange, moves);
}

/// The cells that a tie has folded.
struct Folded {
  PetscInt count = 0, first = PETSC_MAX_INT;  ///< smallest tag
  std::string cell;                           ///< the cell of this tag in words
};

/// Returns the cells of this rank that have become folded, by the tie, [interface], of the node
/// with the largest move.
std::vector<Folded> foldedCells(const mesh::Mesh& mesh, const std::vector<Point>& file,
                                const Moves& moves, const std::vector<double>& tieOf,
                                std::size_t interfaces) {
  std::vector<Folded> folded(interfaces);
  const auto way = [&](PetscInt node) { return tieOf[node] > 0 ? length(moves[node]) : 0; };
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e) {
      const auto nodes = block.nodesOf(e);
      const PetscInt most = *std::max_element(
          nodes.begin(), nodes.end(), [&](PetscInt a, PetscInt b) { return way(a) < way(b); });
      if (way(most) == 0 ||
          !elasticity::foldedAnywhere(block.type, picked(mesh.coordinates, nodes)) ||
          elasticity::foldedAnywhere(block.type, picked(file, nodes)))
        continue;
      auto& [count, first, cell] = folded[std::lround(tieOf[most]) - 1];
      ++count;
      if (block.tag[e] >= first) continue;
      first = block.tag[e];
      cell = formatted("cell %" PetscInt_FMT
                       " (%s) of group '%s', of which the node at %s moves by "
                       "%.3g m",
                       first, element::shapeTable(block.type).name.c_str(),
                       mesh.bodies[block.body[e]].c_str(), text(file[most]).c_str(), way(most));
    }
  return folded;
}

/// Collective. Throws Error for a tie that has folded cells.
void rejectFolded(const mesh::Mesh& mesh, const std::vector<Point>& file, const Moves& moves,
                  const std::vector<double>& tieOf, const Interfaces& ties) {
  auto folded = foldedCells(mesh, file, moves, tieOf, ties.options.size());
  for (std::size_t i = 0; i < folded.size(); ++i) {
    PetscInt count = folded[i].count, first = folded[i].first;
    count = mpi::sum(mesh.comm, count);
    first = mpi::min(mesh.comm, first);
    if (count == 0) continue;
    const auto& options = ties.options[i];
    const std::string adjust = adjustName(options.surfaces.name);
    failTogether(mesh.comm,
                 folded[i].first != first
                     ? ""
                     : formatted("option %s: moving '%s' onto '%s' folds %" PetscInt_FMT
                                 " cells, first %s; give a smaller %s, or %s off",
                                 adjust.c_str(), options.surfaces.pad.name.c_str(),
                                 options.surfaces.disc.name.c_str(), count, folded[i].cell.c_str(),
                                 searchName(options).c_str(), adjust.c_str()));
  }
}

constexpr double largestChange = 0.1;  // of a distance; curved cuts on usual meshes cause less

/// Returns the strains by the tie, [interface], of the node with the largest move in each cell.
std::vector<StrainReport> strainsOf(const mesh::Mesh& mesh, const std::vector<Point>& file,
                                    const Moves& moves, const std::vector<double>& tieOf,
                                    std::size_t interfaces) {
  std::vector<StrainReport> strains(interfaces);
  const auto way = [&](PetscInt node) { return tieOf[node] > 0 ? length(moves[node]) : 0; };
  for (const auto& block : mesh.cells) {
    const std::size_t corners = element::shapeTable(block.type).corners;
    for (std::size_t e = 0; e < block.tag.size(); ++e) {
      const auto nodes = block.nodesOf(e);
      const PetscInt most = *std::max_element(
          nodes.begin(), nodes.end(), [&](PetscInt a, PetscInt b) { return way(a) < way(b); });
      if (way(most) == 0) continue;
      double largest = 0;
      Point middle{};
      for (std::size_t i = 0; i < corners; ++i)
        for (std::size_t j = 0; j < i; ++j) {
          const auto between = [&](const std::vector<Point>& points) {
            return length(mesh::minus(points[nodes[i]], points[nodes[j]]));
          };
          const double change = std::abs(between(mesh.coordinates) / between(file) - 1);
          if (change <= largest) continue;
          largest = change;
          middle = mesh::scaled(plus(file[nodes[i]], file[nodes[j]]), 0.5);
        }
      StrainReport& strain = strains[std::lround(tieOf[most]) - 1];
      strain.cells += largest > largestChange;
      if (largest > strain.change) strain.change = largest, strain.where = middle;
    }
  }
  return strains;
}

/// Collective. Reports ties that have stretched or compressed cells, and warns of them.
void reportStrain(const mesh::Mesh& mesh, const std::vector<Point>& file, const Moves& moves,
                  const std::vector<double>& tieOf, Interfaces& ties) {
  const auto strains = strainsOf(mesh, file, moves, tieOf, ties.options.size());
  for (std::size_t i = 0; i < strains.size(); ++i) {
    const auto all = concatenated(mesh.comm, std::vector<StrainReport>{strains[i]});
    StrainReport& worst = ties.reports[i].strain;
    worst = *std::max_element(all.begin(), all.end(),
                              [](const auto& a, const auto& b) { return a.change < b.change; });
    worst.cells = 0;
    for (const auto& strain : all) worst.cells += strain.cells;
    if (worst.cells == 0) continue;
    const auto& options = ties.options[i];
    const std::string adjust = adjustName(options.surfaces.name);
    printWarning(
        mesh.comm,
        formatted("warning: %s: moving '%s' onto '%s' changes distances in %" PetscInt_FMT
                  " cells by more than %g %%, at most by %.3g %% at %s; give a smaller %s, "
                  "or %s off",
                  options.label().c_str(), options.surfaces.pad.name.c_str(),
                  options.surfaces.disc.name.c_str(), worst.cells, 100 * largestChange,
                  100 * worst.change, text(worst.where).c_str(), searchName(options).c_str(),
                  adjust.c_str()));
  }
}

}  // namespace

void moveOntoMasters(mesh::Mesh& mesh, const coupling::NodeExchange& exchange, Interfaces& ties) {
  const std::vector<Point> file = mesh.coordinates;
  Moves moves = movesOfTied(mesh, exchange, ties);
  for (const auto& node : ties.tied) {
    double& largest = ties.reports[node.interface].largestAdjustment;
    largest = std::max(largest, length(moves[node.connection.node]));
  }
  for (auto& report : ties.reports)
    report.largestAdjustment = mpi::max(mesh.comm, report.largestAdjustment);
  moveWithCorners(mesh, exchange, moves);
  for (std::size_t i = 0; i < moves.size(); ++i) mesh.coordinates[i] = plus(file[i], moves[i]);
  std::vector<double> tieOf(mesh.localNodes(), 0.0);  // one more than the index of the tie
  for (const auto& node : ties.tied) tieOf[node.connection.node] = node.interface + 1;
  exchange.largest(tieOf);
  rejectFolded(mesh, file, moves, tieOf, ties);
  reportStrain(mesh, file, moves, tieOf, ties);
}

}  // namespace squeal::ties
