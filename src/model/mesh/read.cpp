// SPDX-License-Identifier: BSD-2-Clause
#include "model/mesh/read.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <set>

#include "base/petsc/check.hpp"
#include "base/system/mpi.hpp"
#include "model/mesh/layers.hpp"
#include "model/mesh/pairing.hpp"
#include "model/mesh/partition.hpp"
#include "model/mesh/serialization.hpp"
#include "model/mesh/straighten.hpp"
#include "model/mesh/whole.hpp"

namespace squeal::mesh {
namespace {

/// The owners and the global numbers of the nodes. The numbers of the nodes of a rank are
/// contiguous.
struct Numbering {
  std::vector<int> owner;             ///< [whole node]
  std::vector<PetscInt> global;       ///< [whole node]
  std::vector<PetscInt> whole;        ///< [global node]
  std::vector<PetscInt> firstOfRank;  ///< [rank], and the total at the end
};

Numbering number(const WholeMesh& mesh, const std::vector<int>& cellRank, int ranks) {
  Numbering numbering;
  numbering.owner.assign(mesh.points.size(), ranks);
  std::size_t cell = 0;
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e, ++cell)
      for (PetscInt node : block.nodesOf(e))
        numbering.owner[node] = std::min(numbering.owner[node], cellRank[cell]);
  // The first rank owns reference nodes, which are in no cell.
  for (const auto& reference : mesh.references)
    numbering.owner[reference.displacement] = numbering.owner[reference.rotation] = 0;
  for (const auto& [node, layer] : mesh.layers) numbering.owner[layer] = numbering.owner[node];
  numbering.whole.resize(mesh.points.size());
  std::iota(numbering.whole.begin(), numbering.whole.end(), 0);
  std::stable_sort(numbering.whole.begin(), numbering.whole.end(),
                   [&](PetscInt a, PetscInt b) { return numbering.owner[a] < numbering.owner[b]; });
  numbering.global.resize(mesh.points.size());
  numbering.firstOfRank.assign(ranks + 1, 0);
  for (PetscInt g = 0; g < mesh.nodeCount(); ++g) {
    const PetscInt node = numbering.whole[g];
    numbering.global[node] = g;
    ++numbering.firstOfRank[numbering.owner[node] + 1];
  }
  std::partial_sum(numbering.firstOfRank.begin(), numbering.firstOfRank.end(),
                   numbering.firstOfRank.begin());
  return numbering;
}

/// The items of the mesh by the rank that gets them, so that all parts are
/// made in one pass over the mesh.
struct Shares {
  std::vector<std::vector<std::vector<PetscInt>>> cells, faces;        // [rank][block] -> element
  std::vector<std::vector<PetscInt>> images, pairs, sections, layers;  // [rank] -> item
  std::vector<std::vector<std::vector<PetscInt>>> groups;  // [rank][group] -> whole node
};

Shares share(const WholeMesh& mesh, const Numbering& numbering, const std::vector<int>& cellRank,
             int ranks) {
  Shares shares;
  shares.cells.assign(ranks, std::vector<std::vector<PetscInt>>(mesh.cells.size()));
  shares.faces.assign(ranks, std::vector<std::vector<PetscInt>>(mesh.faces.size()));
  shares.groups.assign(ranks, std::vector<std::vector<PetscInt>>(mesh.nodeGroups.size()));
  shares.images.resize(ranks);
  shares.pairs.resize(ranks);
  shares.sections.resize(ranks);
  shares.layers.resize(ranks);
  std::size_t cell = 0;
  for (std::size_t b = 0; b < mesh.cells.size(); ++b)
    for (std::size_t e = 0; e < mesh.cells[b].tag.size(); ++e, ++cell)
      shares.cells[cellRank[cell]][b].push_back(e);
  for (std::size_t b = 0; b < mesh.faces.size(); ++b)
    for (std::size_t e = 0; e < mesh.faces[b].tag.size(); ++e)
      shares.faces[cellRank[mesh.faces[b].cell[e]]][b].push_back(e);
  for (std::size_t i = 0; i < mesh.images.size(); ++i)
    shares.images[numbering.owner[mesh.images[i].node]].push_back(i);
  for (std::size_t i = 0; i < mesh.pairs.size(); ++i)
    shares.pairs[numbering.owner[mesh.pairs[i].node]].push_back(i);
  for (std::size_t i = 0; i < mesh.sectionPairs.size(); ++i)
    shares.sections[numbering.owner[mesh.sectionPairs[i].node]].push_back(i);
  for (std::size_t i = 0; i < mesh.layers.size(); ++i)
    shares.layers[numbering.owner[mesh.layers[i].node]].push_back(i);
  std::size_t g = 0;
  for (const auto& [name, nodes] : mesh.nodeGroups) {
    for (PetscInt node : nodes) shares.groups[numbering.owner[node]][g].push_back(node);
    ++g;
  }
  return shares;
}

std::vector<PetscInt> elementNodes(const WholeBlock& block, const std::vector<PetscInt>& elements) {
  std::vector<PetscInt> nodes;
  for (PetscInt e : elements) {
    const auto more = block.nodesOf(e);
    nodes.insert(nodes.end(), more.begin(), more.end());
  }
  return nodes;
}

template <class Number>
std::vector<Number> picked(const std::vector<Number>& all, const std::vector<PetscInt>& which) {
  std::vector<Number> some;
  for (PetscInt i : which) some.push_back(all[i]);
  return some;
}

/// The local numbers of one rank: those of the owned nodes in global order, then those of the
/// ghosts of its cells.
class LocalNumbers {
 public:
  LocalNumbers(const WholeMesh& mesh, const Numbering& numbering,
               const std::vector<std::vector<PetscInt>>& cells, int rank)
      : numbering_(numbering),
        first_(numbering.firstOfRank[rank]),
        end_(numbering.firstOfRank[rank + 1]) {
    for (PetscInt g = first_; g < end_; ++g) global_.push_back(g);
    std::set<PetscInt> ghosts;
    for (std::size_t b = 0; b < mesh.cells.size(); ++b)
      for (PetscInt node : elementNodes(mesh.cells[b], cells[b])) {
        const PetscInt g = numbering.global[node];
        if (g < first_ || g >= end_) ghosts.insert(g);
      }
    global_.insert(global_.end(), ghosts.begin(), ghosts.end());
  }
  PetscInt first() const { return first_; }
  PetscInt owned() const { return end_ - first_; }
  /// Returns the global numbers, [local node].
  const std::vector<PetscInt>& global() const { return global_; }
  PetscInt of(PetscInt node) const {
    const PetscInt g = numbering_.global[node];
    if (g >= first_ && g < end_) return g - first_;
    return std::lower_bound(global_.begin() + owned(), global_.end(), g) - global_.begin();
  }
  std::vector<PetscInt> of(std::vector<PetscInt> nodes) const {
    for (auto& node : nodes) node = of(node);
    return nodes;
  }

 private:
  const Numbering& numbering_;
  PetscInt first_, end_;
  std::vector<PetscInt> global_;
};

/// Adds the contact pairs of a rank, in the order of local nodes, so that all data per contact node
/// (gap columns of T, reports) have the same order.
void addPairs(const WholeMesh& mesh, const std::vector<PetscInt>& which, const Numbering& numbering,
              const LocalNumbers& local, Mesh& part) {
  part.pairs = picked(mesh.pairs, which);
  for (auto& pair : part.pairs) {
    pair.node = local.of(pair.node);
    if (pair.master >= 0) pair.master = numbering.global[pair.master];
  }
  std::sort(part.pairs.begin(), part.pairs.end(),
            [](const auto& a, const auto& b) { return a.node < b.node; });
}

/// Adds the cells and faces of a rank.
void addElements(const WholeMesh& mesh, const Shares& shares, int rank, const LocalNumbers& local,
                 Mesh& part) {
  for (std::size_t b = 0; b < mesh.cells.size(); ++b) {
    const auto& block = mesh.cells[b];
    const auto& which = shares.cells[rank][b];
    part.cells.push_back({.type = block.type,
                          .nodesPerCell = block.nodesPerElement,
                          .nodes = local.of(elementNodes(block, which)),
                          .body = picked(block.label, which),
                          .tag = picked(block.tag, which),
                          .material = picked(block.material, which)});
  }
  for (std::size_t b = 0; b < mesh.faces.size(); ++b) {
    const auto& block = mesh.faces[b];
    const auto& which = shares.faces[rank][b];
    part.faces.push_back({.type = block.type,
                          .nodesPerFace = block.nodesPerElement,
                          .nodes = local.of(elementNodes(block, which)),
                          .surface = picked(block.label, which),
                          .sign = picked(block.sign, which)});
  }
}

/// Returns the part of a rank.
Mesh partOf(const WholeMesh& mesh, const Numbering& numbering, const Shares& shares, int rank) {
  const LocalNumbers local(mesh, numbering, shares.cells[rank], rank);
  Mesh part;
  part.dimension = mesh.dimension;
  part.totalNodes = mesh.nodeCount(), part.totalCells = mesh.cellCount();
  part.unusedNodes = mesh.unusedNodes;
  part.straightened = mesh.straightened;
  part.diagonal = mesh.diagonal;
  part.ownedNodes = local.owned(), part.firstNode = local.first();
  part.globalNode = local.global();
  std::vector<PetscInt> whole;
  for (PetscInt g : local.global()) whole.push_back(numbering.whole[g]);
  part.coordinates = picked(mesh.points, whole);
  part.nodeTag = picked(mesh.tags, whole);
  part.nodePart = picked(mesh.part, whole);
  part.parts = std::ssize(mesh.partName);
  part.partName = mesh.partName;
  part.bodies = mesh.bodies, part.surfaces = mesh.surfaces;
  part.materialGroups = mesh.materialGroups;
  addElements(mesh, shares, rank, local, part);
  std::size_t g = 0;
  for (const auto& [name, nodes] : mesh.nodeGroups)
    part.nodeGroups[name] = local.of(shares.groups[rank][g++]);
  part.sections = mesh.sections;
  part.sectionPairs = picked(mesh.sectionPairs, shares.sections[rank]);
  for (auto& pair : part.sectionPairs)
    pair.node = local.of(pair.node), pair.lower = numbering.global[pair.lower];
  part.layers = picked(mesh.layers, shares.layers[rank]);
  for (auto& [node, layer] : part.layers) node = local.of(node), layer = local.of(layer);
  part.layerNodes = std::ssize(mesh.layers);
  part.references = mesh.references;
  for (auto& reference : part.references)
    for (PetscInt* node : {&reference.displacement, &reference.rotation})
      *node = numbering.global[*node];
  part.images = picked(mesh.images, shares.images[rank]);
  for (auto& image : part.images)
    image.node = local.of(image.node), image.primary = numbering.global[image.primary];
  addPairs(mesh, shares.pairs[rank], numbering, local, part);
  part.interfaces = mesh.interfaces;
  return part;
}

/// Collective. Sends messages[r] from rank 0 to rank r, which gets it as the result. The messages
/// are used up.
std::vector<char> scatter(MPI_Comm comm, std::vector<std::vector<char>>& messages) {
  std::vector<int> counts, offsets;
  std::vector<char> all;
  std::string failure;
  constexpr std::size_t most = std::numeric_limits<int>::max();
  for (auto& message : messages) {
    if (all.size() + message.size() > most)
      failure = "the mesh is too large for one rank to distribute (2 GiB of message)";
    counts.push_back(message.size());
    offsets.push_back(all.size());
    all.insert(all.end(), message.begin(), message.end());
    std::vector<char>().swap(message);
  }
  failTogether(comm, failure);
  int count = 0;
  check(MPI_Scatter(counts.data(), 1, MPI_INT, &count, 1, MPI_INT, 0, comm));
  std::vector<char> mine(count);
  check(MPI_Scatterv(all.data(), counts.data(), offsets.data(), MPI_CHAR, mine.data(), count,
                     MPI_CHAR, 0, comm));
  return mine;
}

}  // namespace

Mesh read(MPI_Comm comm, const Request& request, const meshfile::Settings& file,
          const Settings& settings, const CellGeometry& geometry, meshfile::Reader reader) {
  const int size = mpi::size(comm);
  std::vector<std::vector<char>> messages;
  std::string failure;
  if (mpi::rank(comm) == 0) try {
      WholeMesh whole = load(file, request, reader);
      pairNodes(whole, request);
      straighten(whole, geometry, settings.straightening);
      addLayers(whole, request);
      const auto cellRank = partition(whole, size);
      const Numbering numbering = number(whole, cellRank, size);
      const Shares shares = share(whole, numbering, cellRank, size);
      for (int r = 0; r < size; ++r) {
        Mesh part = partOf(whole, numbering, shares, r);
        Stream stream;
        stream(part);
        messages.push_back(std::move(stream).bytes());
      }
    } catch (const std::exception& error) {
      failure = error.what();
    }
  failTogether(comm, failure);
  Mesh mesh;
  Stream stream(scatter(comm, messages));
  stream(mesh);
  mesh.comm = comm;
  return mesh;
}

}  // namespace squeal::mesh
