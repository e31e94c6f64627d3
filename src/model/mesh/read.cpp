#include "model/mesh/read.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <set>

#include "base/petsc/check.hpp"
#include "base/system/buffer.hpp"
#include "model/mesh/pairing.hpp"
#include "model/mesh/partition.hpp"
#include "model/mesh/straighten.hpp"
#include "model/mesh/whole.hpp"
#include "model/meshfile/format.hpp"
#include "model/meshfile/geometry.hpp"

namespace squeal::mesh {
namespace {

/// A Numbering holds the owners and the global numbers of the nodes. The numbers of the nodes of a
/// rank are contiguous.
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

/// A Shares lists the items of the mesh by the rank that gets them, so that packing all ranks is
/// one pass over the mesh.
struct Shares {
  std::vector<std::vector<std::vector<PetscInt>>> cells, faces;  // [rank][block] -> element
  std::vector<std::vector<PetscInt>> images, pairs;              // [rank] -> item
  std::vector<std::vector<std::vector<PetscInt>>> groups;        // [rank][group] -> whole node
};

Shares share(const WholeMesh& mesh, const Numbering& numbering, const std::vector<int>& cellRank,
             int ranks) {
  Shares shares;
  shares.cells.assign(ranks, std::vector<std::vector<PetscInt>>(mesh.cells.size()));
  shares.faces.assign(ranks, std::vector<std::vector<PetscInt>>(mesh.faces.size()));
  shares.groups.assign(ranks, std::vector<std::vector<PetscInt>>(mesh.nodeGroups.size()));
  shares.images.resize(ranks);
  shares.pairs.resize(ranks);
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

Buffer pack(const WholeMesh& mesh, const Numbering& numbering, const Shares& shares, int rank) {
  // The local numbers are those of the owned nodes in global order, then those of the ghosts of
  // this rank's cells.
  std::vector<PetscInt> local;  // local -> global
  for (PetscInt g = numbering.firstOfRank[rank]; g < numbering.firstOfRank[rank + 1]; ++g)
    local.push_back(g);
  const PetscInt first = numbering.firstOfRank[rank], end = numbering.firstOfRank[rank + 1];
  std::set<PetscInt> ghosts;
  for (std::size_t b = 0; b < mesh.cells.size(); ++b)
    for (PetscInt node : elementNodes(mesh.cells[b], shares.cells[rank][b])) {
      const PetscInt g = numbering.global[node];
      if (g < first || g >= end) ghosts.insert(g);
    }
  local.insert(local.end(), ghosts.begin(), ghosts.end());
  const auto toLocal = [&](PetscInt node) -> PetscInt {
    const PetscInt g = numbering.global[node];
    if (g >= first && g < end) return g - first;
    return std::lower_bound(local.begin() + (end - first), local.end(), g) - local.begin();
  };
  const auto allToLocal = [&](std::vector<PetscInt> nodes) {
    for (auto& node : nodes) node = toLocal(node);
    return nodes;
  };

  const PetscInt parts = mesh.partName.size(), cellBlocks = mesh.cells.size(),
                 faceBlocks = mesh.faces.size();
  Buffer buffer;
  buffer.put(std::vector<PetscInt>{mesh.dimension, mesh.nodeCount(), mesh.cellCount(), end - first,
                                   first, parts, mesh.unusedNodes});
  buffer.put(std::vector{mesh.straightened});
  buffer.put(mesh.bodies);
  buffer.put(mesh.surfaces);
  buffer.put(mesh.partName);
  buffer.put(local);
  std::vector<PetscInt> whole;
  for (PetscInt g : local) whole.push_back(numbering.whole[g]);
  buffer.put(picked(mesh.points, whole));
  buffer.put(picked(mesh.tags, whole));
  buffer.put(picked(mesh.part, whole));
  buffer.put(std::vector{cellBlocks});
  for (std::size_t b = 0; b < mesh.cells.size(); ++b) {
    const auto& block = mesh.cells[b];
    buffer.put(std::vector<PetscInt>{block.type, block.nodesPerElement});
    buffer.put(allToLocal(elementNodes(block, shares.cells[rank][b])));
    buffer.put(picked(block.label, shares.cells[rank][b]));
    buffer.put(picked(block.tag, shares.cells[rank][b]));
  }
  buffer.put(std::vector{faceBlocks});
  for (std::size_t b = 0; b < mesh.faces.size(); ++b) {
    const auto& block = mesh.faces[b];
    buffer.put(std::vector<PetscInt>{block.type, block.nodesPerElement});
    buffer.put(allToLocal(elementNodes(block, shares.faces[rank][b])));
    buffer.put(picked(block.label, shares.faces[rank][b]));
    buffer.put(picked(block.sign, shares.faces[rank][b]));
  }
  std::vector<std::string> names;
  for (const auto& [name, nodes] : mesh.nodeGroups) names.push_back(name);
  buffer.put(names);
  for (const auto& nodes : shares.groups[rank]) buffer.put(allToLocal(nodes));
  auto images = picked(mesh.images, shares.images[rank]);
  for (auto& image : images)
    image.node = toLocal(image.node), image.primary = numbering.global[image.primary];
  buffer.put(images);
  auto pairs = picked(mesh.pairs, shares.pairs[rank]);
  for (auto& pair : pairs) {
    pair.node = toLocal(pair.node);
    if (pair.master >= 0) pair.master = numbering.global[pair.master];
  }
  // Pairs stand in local order, so that all data per contact node (gap columns of T, reports) have
  // the same order.
  std::sort(pairs.begin(), pairs.end(),
            [](const auto& a, const auto& b) { return a.node < b.node; });
  buffer.put(pairs);
  buffer.put(mesh.matching);
  buffer.put(mesh.mismatch);
  buffer.put(mesh.nearlyMatching);
  return buffer;
}

Mesh unpack(MPI_Comm comm, Buffer& buffer) {
  Mesh mesh;
  mesh.comm = comm;
  const auto sizes = buffer.take<PetscInt>();
  mesh.dimension = sizes[0], mesh.totalNodes = sizes[1], mesh.totalCells = sizes[2];
  mesh.ownedNodes = sizes[3], mesh.firstNode = sizes[4], mesh.parts = sizes[5];
  mesh.unusedNodes = sizes[6];
  mesh.straightened = buffer.take<Straightened>().at(0);
  mesh.bodies = buffer.takeTexts();
  mesh.surfaces = buffer.takeTexts();
  mesh.partName = buffer.takeTexts();
  mesh.globalNode = buffer.take<PetscInt>();
  mesh.coordinates = buffer.take<Point>();
  mesh.nodeTag = buffer.take<PetscInt>();
  mesh.nodePart = buffer.take<int>();
  mesh.cells.resize(buffer.take<PetscInt>().at(0));
  for (auto& block : mesh.cells) {
    const auto kind = buffer.take<PetscInt>();
    block.type = kind[0], block.nodesPerCell = kind[1];
    block.nodes = buffer.take<PetscInt>();
    block.body = buffer.take<int>();
    block.tag = buffer.take<PetscInt>();
  }
  mesh.faces.resize(buffer.take<PetscInt>().at(0));
  for (auto& block : mesh.faces) {
    const auto kind = buffer.take<PetscInt>();
    block.type = kind[0], block.nodesPerFace = kind[1];
    block.nodes = buffer.take<PetscInt>();
    block.surface = buffer.take<int>();
    block.sign = buffer.take<int>();
  }
  for (const auto& name : buffer.takeTexts()) mesh.nodeGroups[name] = buffer.take<PetscInt>();
  mesh.images = buffer.take<Image>();
  mesh.pairs = buffer.take<ContactPair>();
  mesh.matching = buffer.take<unsigned char>();
  mesh.mismatch = buffer.takeTexts();
  mesh.nearlyMatching = buffer.take<unsigned char>();
  return mesh;
}

/// Collective. Sends buffers[r] from rank 0 to rank r, which gets it as the result. The buffers are
/// used up.
Buffer scatter(MPI_Comm comm, std::vector<Buffer>& buffers) {
  int rank = 0;
  check(MPI_Comm_rank(comm, &rank));
  std::vector<int> counts, offsets;
  std::vector<char> all;
  std::string failure;
  constexpr std::size_t most = std::numeric_limits<int>::max();
  for (auto& buffer : buffers) {
    if (all.size() + buffer.bytes().size() > most)
      failure = "the mesh is too large for one rank to hand out (2 GiB of message)";
    counts.push_back(buffer.bytes().size());
    offsets.push_back(all.size());
    all.insert(all.end(), buffer.bytes().begin(), buffer.bytes().end());
    std::vector<char>().swap(buffer.bytes());
  }
  failTogether(comm, failure);
  int count = 0;
  check(MPI_Scatter(counts.data(), 1, MPI_INT, &count, 1, MPI_INT, 0, comm));
  Buffer mine;
  mine.bytes().resize(count);
  check(MPI_Scatterv(all.data(), counts.data(), offsets.data(), MPI_CHAR, mine.bytes().data(),
                     count, MPI_CHAR, 0, comm));
  return mine;
}

}  // namespace

Mesh read(MPI_Comm comm, const Request& request) {
  const std::string file = meshfile::meshFile();
  const auto parameters = meshfile::geometryParameters();
  int rank = 0, size = 1;
  check(MPI_Comm_rank(comm, &rank));
  check(MPI_Comm_size(comm, &size));
  std::vector<Buffer> buffers;
  std::string failure;
  if (rank == 0) try {
      WholeMesh whole = load(file, parameters, request);
      pairNodes(whole, request);
      straighten(whole, request.geometry);
      const auto cellRank = partition(whole, size);
      const Numbering numbering = number(whole, cellRank, size);
      const Shares shares = share(whole, numbering, cellRank, size);
      for (int r = 0; r < size; ++r) buffers.push_back(pack(whole, numbering, shares, r));
    } catch (const std::exception& error) {
      failure = error.what();
    }
  failTogether(comm, failure);
  Buffer mine = scatter(comm, buffers);
  return unpack(comm, mine);
}

}  // namespace squeal::mesh
