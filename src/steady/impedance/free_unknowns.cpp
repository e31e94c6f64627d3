// SPDX-License-Identifier: BSD-2-Clause
#include "steady/impedance/free_unknowns.hpp"

#include <algorithm>

#include "algebra/linalg/rows.hpp"
#include "base/petsc/object.hpp"
#include "base/system/mpi.hpp"

namespace squeal::impedance {

using linalg::DenseMatrix;
using linalg::DenseView;

namespace {

/// The largest number of active sets in memory.
constexpr std::size_t mostBlocks = 32;
/// A block differs from its base by at most this fraction of the free unknowns of the base. Up to a
/// sixth, this is less work than a factorisation.
constexpr double mostChanged = 0.125;

}  // namespace

FreeUnknowns::FreeUnknowns(const Impedance& impedance)
    : impedance_(impedance), columns_(impedance.length()) {
  first_ = mpi::sumBefore<PetscInt>(impedance.comm(), impedance.nodeOf().size());
}

double FreeUnknowns::mostBytes(MPI_Comm comm) { return 256e6 * mpi::size(comm); }

void FreeUnknowns::compute(std::span<const unsigned char> free) {
  std::vector<PetscInt> wanted;
  for (std::size_t i = 0; i < free.size(); ++i)
    if (free[i] && place_.count(first_ + i) == 0) wanted.push_back(first_ + i);
  const auto all = concatenated(impedance_.comm(), wanted);
  if (all.empty()) return;
  for (const PetscInt unknown : all) place_.emplace(unknown, place_.size());
  columns_.append(impedance_.responsesToUnits(all));
}

PetscInt FreeUnknowns::placeOf(PetscInt unknown) const {
  const auto place = place_.find(first_ + unknown);
  return place == place_.end() ? -1 : place->second;
}

std::shared_ptr<FreeBlock> FreeUnknowns::blockOf(const std::vector<unsigned char>& free,
                                                 Mat direct) {
  const MPI_Comm comm = impedance_.comm();
  std::vector<int> same;
  for (const auto& block : blocks_)
    same.push_back(block->free == free && block->direct.get() == direct);
  mpi::reduce<int>(comm, same, MPI_LAND);
  if (const auto known = std::ranges::find(same, 1); known != same.end()) {
    const auto block = blocks_[known - same.begin()];
    // The base of a block in use is in use too.
    for (const auto& used : {block->base, block})
      if (const auto place = std::ranges::find(blocks_, used); place != blocks_.end())
        std::rotate(blocks_.begin(), place, place + 1);
    return block;
  }
  OwnedMat stored;
  if (direct) {
    check(PetscObjectReference(object(direct)));
    stored = OwnedMat(direct);
  }
  std::vector<PetscInt> local;
  for (std::size_t i = 0; i < free.size(); ++i)
    if (free[i]) local.push_back(i);
  auto block = std::make_shared<FreeBlock>(FreeBlock{.free = free,
                                                     .direct = std::move(stored),
                                                     .unknowns = unknowns(std::move(local)),
                                                     .owner = 0,
                                                     .base = nearest(free),
                                                     .normal = DenseMatrix(0)});
  block->base ? gatherBorder(*block) : gatherStiffness(*block);
  blocks_.insert(blocks_.begin(), std::move(block));
  const double most = mostBytes(comm);
  double bytes = 0;
  const auto kept =
      std::ranges::find_if(blocks_.begin() + 1, blocks_.end(), [&](const auto& other) {
        return (bytes += other->bytes()) + blocks_.front()->bytes() > most;
      });
  blocks_.erase(kept, blocks_.end());
  if (blocks_.size() > mostBlocks) blocks_.resize(mostBlocks);
  return blocks_.front();
}

/// Collective. Returns the block with a stiffness of its own that differs least from these free
/// unknowns, and makes it the newest; null if all differ much.
std::shared_ptr<FreeBlock> FreeUnknowns::nearest(const std::vector<unsigned char>& free) {
  std::vector<PetscInt> differing, which;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const FreeBlock& block = *blocks_[k];
    if (block.base || !block.isRegular) continue;
    PetscInt count = 0;
    for (std::size_t i = 0; i < free.size(); ++i) count += block.free[i] != free[i];
    differing.push_back(count);
    which.push_back(k);
  }
  mpi::reduce<PetscInt>(impedance_.comm(), differing, MPI_SUM);
  const auto least = std::ranges::min_element(differing);
  if (least == differing.end()) return {};
  const auto place = blocks_.begin() + which[least - differing.begin()];
  if (*least > mostChanged * (*place)->unknowns.ranks.size()) return {};
  std::rotate(blocks_.begin(), place, place + 1);
  return blocks_.front();
}

/// Collective. Returns the list of these unknowns of all ranks, which have columns.
Unknowns FreeUnknowns::unknowns(std::vector<PetscInt> local) const {
  std::vector<PetscInt> places;
  for (const PetscInt i : local) places.push_back(place_.at(first_ + i));
  const Concatenation ranks(impedance_.comm(), local.size());
  auto all = ranks.gathered(places);
  return {std::move(local), std::move(all), ranks};
}

/// Collective. Gathers the stiffness of a block on its owner, the next rank in turn.
void FreeUnknowns::gatherStiffness(FreeBlock& block) {
  const PetscInt n = impedance_.nodes();
  const auto& [local, places, ranks] = block.unknowns;
  // Row by row, so that one message has all rows of a rank. The matrix is symmetric except for
  // round-off, so its rows serve as columns.
  DenseMatrix rows(std::ssize(places), local.size()), matrix(std::ssize(places), ranks.size());
  for (PetscInt j = 0; j < rows.rows(); ++j)
    for (std::size_t i = 0; i < local.size(); ++i) rows(j, i) = columns_(n + local[i], places[j]);
  ranks.gather(rows.data(), matrix.data(), static_cast<int>(rows.rows()));
  block.owner = static_cast<int>(blocksSoFar_++ % mpi::size(impedance_.comm()));
  if (block.owner == mpi::rank(impedance_.comm())) block.matrix = std::move(matrix);
}

/// Collective. Gathers the data of a block that its base lacks.
void FreeUnknowns::gatherBorder(FreeBlock& block) const {
  const FreeBlock& base = *block.base;
  block.owner = base.owner;
  std::vector<PetscInt> added, held;
  for (std::size_t i = 0; i < block.free.size(); ++i)
    if (block.free[i] && !base.free[i]) added.push_back(i);
  const auto& own = base.unknowns.local;
  for (std::size_t k = 0; k < own.size(); ++k)
    if (!block.free[own[k]]) held.push_back(base.unknowns.ranks.ownBegin() + k);
  block.added = unknowns(std::move(added));
  block.held = concatenated(impedance_.comm(), held);
  DenseMatrix columns(columns_.rows());
  for (const PetscInt place : block.added.places) columns.append(columns_.column(place));
  block.coupling = forcesAt(base.unknowns, columns);
  block.addedMatrix = forcesAt(block.added, columns);
}

/// Collective. Returns F at some unknowns of all ranks.
DenseMatrix FreeUnknowns::forcesAt(const Unknowns& at, const DenseView& effects) const {
  DenseMatrix rows(at.local.size(), effects.columns());
  for (PetscInt j = 0; j < effects.columns(); ++j)
    for (PetscInt i = 0; i < rows.rows(); ++i)
      rows(i, j) = effects(impedance_.nodes() + at.local[i], j);
  return linalg::gatheredRows(at.ranks, rows);
}

std::vector<DenseMatrix> FreeUnknowns::released(std::span<const ReleaseTask> tasks) const {
  const MPI_Comm comm = impedance_.comm();
  std::vector<DenseMatrix> inBase, added;  // forces, then values
  for (const auto& [block, effects, magnitude] : tasks) {
    FreeBlock& base = block.baseOrSelf();
    const PetscInt last = magnitude + effects.columns(), columns = effects.columns(),
                   known = magnitude < 0 ? 0 : std::min(base.solved - magnitude, columns);
    inBase.push_back(known < columns ? forcesAt(base.unknowns, effects.columnRange(known, columns))
                                     : DenseMatrix(base.unknowns.ranks.size()));
    added.push_back(block.base ? forcesAt(block.added, effects) : DenseMatrix());
    if (mpi::rank(comm) != base.owner) inBase.back() = {};
    if (magnitude >= 0) base.solved = std::max(base.solved, last);
  }
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    FreeBlock& block = tasks[k].block;
    FreeBlock& base = block.baseOrSelf();
    const PetscInt columns = tasks[k].effects.columns(), magnitude = tasks[k].magnitude;
    if (mpi::rank(comm) != base.owner) continue;
    base.stiffness.apply(inBase[k]);
    if (magnitude >= 0) {
      base.solutions.append(inBase[k]);
      inBase[k] = DenseMatrix(base.solutions.columnRange(magnitude, magnitude + columns));
    }
    if (block.base) block.border.complete(inBase[k], added[k]);
  }
  std::vector<DenseMatrix> amounts;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const FreeBlock& block = tasks[k].block;
    const Unknowns& ofBase = block.baseOrSelf().unknowns;
    if (mpi::rank(comm) != block.owner)
      inBase[k] = DenseMatrix(ofBase.ranks.size(), tasks[k].effects.columns());
    auto& all = amounts.emplace_back(columns_.columns(), tasks[k].effects.columns());
    const auto take = [&](DenseMatrix& values, const Unknowns& of) {
      mpi::broadcastEntries(comm, values.entries(), block.owner);
      for (PetscInt j = 0; j < values.columns(); ++j)
        for (PetscInt i = 0; i < values.rows(); ++i) all(of.places[i], j) = -values(i, j);
      values = {};
    };
    take(inBase[k], ofBase);
    if (block.base) take(added[k], block.added);
  }
  return amounts;
}

void FreeUnknowns::makeReady(const std::vector<std::shared_ptr<FreeBlock>>& blocks) {
  impedance::makeReady(impedance_.comm(), blocks,
                       [this](FreeBlock& block) { gatherStiffness(block); });
}

}  // namespace squeal::impedance
