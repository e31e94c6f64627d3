// SPDX-License-Identifier: BSD-2-Clause
#include "steady/impedance/free_block.hpp"

#include <algorithm>

#include "algebra/linalg/spread.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/system/mpi.hpp"

namespace squeal::impedance {
namespace {

/// Factorises the stiffness. Not collective.
void factorise(FreeBlock& block) {
  linalg::DenseMatrix matrix = linalg::symmetricPart(block.matrix);
  block.matrix = {};
  block.diagonal.clear();
  for (PetscInt i = 0; i < matrix.rows(); ++i) block.diagonal.push_back(matrix(i, i));
  block.stiffness = SymmetricInverse(std::move(matrix));
  // Nearly loose bodies would cost the blocks with this base their digits.
  constexpr double small = 1e-8;
  block.isRegular = block.stiffness.leastPivot() > small;
}

/// Makes the inverse from that of the base. Not collective.
void border(FreeBlock& block) {
  block.border = BorderedInverse(block.base->stiffness, block.base->diagonal,
                                 std::move(block.coupling), block.addedMatrix, block.held);
  block.isRegular = block.base->isRegular && block.border.isRegular();
}

/// Collective. Calls action(block) for these blocks on their owners, which then share `isRegular`.
void onOwners(MPI_Comm comm, const std::vector<FreeBlock*>& blocks,
              const std::function<void(FreeBlock&)>& action) {
  if (blocks.empty()) return;
  const int rank = mpi::rank(comm);
  linalg::onOwners(comm, mpi::size(comm), [&](std::size_t) {
    for (FreeBlock* block : blocks)
      if (block->owner == rank) action(*block);
  });
  std::vector<int> regular;
  for (const FreeBlock* block : blocks) regular.push_back(block->owner != rank || block->isRegular);
  mpi::reduce<int>(comm, regular, MPI_LAND);
  for (std::size_t k = 0; k < blocks.size(); ++k) blocks[k]->isRegular = regular[k] != 0;
}

}  // namespace

double FreeBlock::bytes() const {
  const double order = unknowns.ranks.size();
  if (!base) return 8 * order * (order + solved);
  return 16.0 * base->unknowns.ranks.size() * (added.ranks.size() + held.size());
}

void makeReady(MPI_Comm comm, const std::vector<std::shared_ptr<FreeBlock>>& blocks,
               const std::function<void(FreeBlock&)>& gather) {
  std::vector<FreeBlock*> own, bordered, refused;
  for (const auto& block : blocks) {
    auto& list = block->base ? bordered : own;
    if (!block->isReady && std::ranges::find(list, block.get()) == list.end())
      list.push_back(block.get());
  }
  onOwners(comm, own, factorise);
  onOwners(comm, bordered, border);
  for (FreeBlock* block : bordered) {
    block->coupling = block->addedMatrix = {};
    if (block->isRegular) continue;
    block->base.reset();
    block->border = {};
    gather(*block);
    refused.push_back(block);
  }
  onOwners(comm, refused, factorise);
  for (const auto& block : blocks) block->isReady = true;
}

}  // namespace squeal::impedance
