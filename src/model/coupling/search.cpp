// SPDX-License-Identifier: BSD-2-Clause
#define BOOST_ALLOW_DEPRECATED_HEADERS  // headers of Boost 1.74 include some, and would say so
#include "model/coupling/search.hpp"

#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <iterator>
#include <limits>
#include <map>
#include <tuple>

#include "base/petsc/check.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "base/system/stream.hpp"

namespace squeal::coupling {
namespace {

/// The number of boxes that contain all slave faces of a rank: enough to separate faces on both
/// sides of a disc, or at several places around it.
constexpr std::size_t mostBoxes = 8;

std::vector<Box> boxesOf(const std::vector<Face>& faces) {
  std::vector<Box> boxes;
  boxes.reserve(faces.size());
  for (const auto& face : faces) boxes.push_back(boxOf(face));
  return boxes;
}

/// Finds the boxes of a list that touch a given one.
class BoxTree {
 public:
  explicit BoxTree(std::span<const Box> boxes) {
    std::vector<Entry> entries;
    entries.reserve(boxes.size());
    for (const auto& box : boxes) entries.emplace_back(converted(box), entries.size());
    tree_ = Tree(entries);  // bulk loading is faster than insertion
  }
  /// Calls action(index) for each box that touches `box`, in no particular order.
  template <class Action>
  void forEach(const Box& box, const Action& action) const {
    const auto touching = boost::geometry::index::intersects(converted(box));
    for (auto found = tree_.qbegin(touching); found != tree_.qend(); ++found) action(found->second);
  }

 private:
  using Corner = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
  using Bounds = boost::geometry::model::box<Corner>;
  using Entry = std::pair<Bounds, std::size_t>;
  using Tree = boost::geometry::index::rtree<Entry, boost::geometry::index::quadratic<16>>;

  static Bounds converted(const Box& box) {
    const auto& [low, high] = box;
    return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
  }
  Tree tree_;
};

/// The boxes of all ranks that have slave faces.
struct RankBoxes {
  std::vector<Box> boxes;
  std::vector<int> rank;  // [box]
};

RankBoxes gather(MPI_Comm comm, const std::vector<Box>& mine) {
  const int rank = mpi::rank(comm);
  return {concatenated(comm, mine), concatenated(comm, std::vector<int>(mine.size(), rank))};
}

/// Returns for each rank the indices of the `boxes` that touch a box of that rank, if there are
/// any.
std::map<int, std::vector<std::size_t>> wantedBy(const RankBoxes& all,
                                                 const std::vector<Box>& boxes) {
  std::map<int, std::vector<std::size_t>> wanted;
  const BoxTree tree(all.boxes);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    tree.forEach(boxes[i], [&](std::size_t box) {
      auto& list = wanted[all.rank[box]];
      if (list.empty() || list.back() != i)
        list.push_back(i);  // a box may touch several boxes of a rank
    });
  return wanted;
}

/// Returns these faces as a message.
std::vector<char> packed(const std::vector<Face>& faces, const std::vector<std::size_t>& which) {
  std::vector<Face> some;
  for (const std::size_t i : which) some.push_back(faces[i]);
  Stream stream;
  stream(some);
  return std::move(stream).bytes();
}

/// Adds the faces of a message to the list.
void unpack(std::vector<char> message, std::vector<Face>& faces) {
  std::vector<Face> more;
  Stream stream(std::move(message));
  stream(more);
  std::ranges::move(more, std::back_inserter(faces));
}

/// Collective. Sends each message to its rank and returns the messages for this rank. No rank needs
/// to know its senders in advance, and none stores a list of all ranks.
std::vector<std::vector<char>> messagesTo(MPI_Comm comm,
                                          const std::map<int, std::vector<char>>& outgoing) {
  std::vector<PetscMPIInt> to, lengths;
  std::string failure;
  for (const auto& [rank, message] : outgoing) {
    if (message.size() > std::numeric_limits<PetscMPIInt>::max())
      failure =
          "the master faces of an interface near the slave faces of one process exceed the size of "
          "a message (2 GiB); run with more processes";
    to.push_back(rank);
    lengths.push_back(message.size());
  }
  failTogether(comm, failure);
  PetscMPIInt count = 0, tag = 0, *from = nullptr, *sizes = nullptr;
  check(PetscCommBuildTwoSided(comm, 1, MPI_INT, to.size(), to.data(), lengths.data(), &count,
                               &from, &sizes));
  MPI_Comm inner = MPI_COMM_NULL;  // PETSc's copy, on which no other message has this tag
  check(PetscCommDuplicate(comm, &inner, &tag));
  std::vector<std::vector<char>> incoming(count);
  std::vector<MPI_Request> requests;
  for (int i = 0; i < count; ++i) {
    auto& bytes = incoming[i];
    bytes.resize(sizes[i]);
    check(
        MPI_Irecv(bytes.data(), sizes[i], MPI_BYTE, from[i], tag, inner, &requests.emplace_back()));
  }
  for (const auto& [rank, message] : outgoing)
    check(MPI_Isend(message.data(), message.size(), MPI_BYTE, rank, tag, inner,
                    &requests.emplace_back()));
  check(MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE));
  check(PetscCommDestroy(&inner));
  check(PetscFree(from));
  check(PetscFree(sizes));
  return incoming;
}

/// Collective. Returns the master faces of all ranks that touch a box of this rank.
std::vector<Face> nearby(MPI_Comm comm, const std::vector<Face>& masters,
                         const std::vector<Box>& slaveBoxes, std::size_t& received) {
  const int rank = mpi::rank(comm);
  const RankBoxes all = gather(comm, summary(slaveBoxes, mostBoxes));
  std::vector<Face> faces;
  std::map<int, std::vector<char>> outgoing;
  for (const auto& [to, which] : wantedBy(all, boxesOf(masters)))
    if (to == rank)
      for (std::size_t i : which) faces.push_back(masters[i]);
    else
      outgoing[to] = packed(masters, which);
  const std::size_t own = faces.size();
  for (auto& message : messagesTo(comm, outgoing)) unpack(std::move(message), faces);
  received = faces.size() - own;
  return faces;
}

/// Orders by position, since global node numbers depend on the number of ranks.
bool before(const Face& a, const Face& b) {
  return std::tie(a.points, a.type, a.sign, a.body) < std::tie(b.points, b.type, b.sign, b.body);
}

/// Moves the faces that a slave needs to `found.masters`, in order, and renumbers the lists of the
/// slaves.
void keepNeeded(Candidates& found, std::vector<Face>& faces) {
  std::vector<std::size_t> needed;
  for (const auto& list : found.ofSlave) needed.insert(needed.end(), list.begin(), list.end());
  std::sort(needed.begin(), needed.end());
  needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
  std::sort(needed.begin(), needed.end(),
            [&](std::size_t a, std::size_t b) { return before(faces[a], faces[b]); });
  std::vector<std::size_t> position(faces.size());
  for (std::size_t i : needed) {
    position[i] = found.masters.size();
    found.masters.push_back(std::move(faces[i]));
  }
  for (auto& list : found.ofSlave) {
    for (auto& i : list) i = position[i];
    std::sort(list.begin(), list.end());
  }
}

}  // namespace

Candidates candidates(MPI_Comm comm, const std::vector<Face>& slaves,
                      const std::vector<Face>& masters, std::span<const double> distances) {
  std::vector<Box> slaveBoxes = boxesOf(slaves);
  for (std::size_t s = 0; s < slaves.size(); ++s)
    slaveBoxes[s] = widened(slaveBoxes[s], distances[s]);
  Candidates found;
  std::vector<Face> faces = nearby(comm, masters, slaveBoxes, found.received);
  const BoxTree tree(boxesOf(faces));
  found.ofSlave.resize(slaves.size());
  for (std::size_t s = 0; s < slaves.size(); ++s)
    tree.forEach(slaveBoxes[s], [&](std::size_t i) { found.ofSlave[s].push_back(i); });
  keepNeeded(found, faces);
  return found;
}

}  // namespace squeal::coupling
