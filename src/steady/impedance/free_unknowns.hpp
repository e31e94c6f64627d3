// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Responses to unit values of the entries of w, and inverses of the stiffness of free ones.
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "steady/impedance/free_block.hpp"
#include "steady/impedance/impedance.hpp"

namespace squeal::impedance {

/// A block, and the effects that its free unknowns shall balance, so that F = 0 in their rows.
struct ReleaseTask {
  FreeBlock& block;           ///< borrowed
  linalg::DenseView effects;  ///< (R, F), [entry]×[column]; borrowed
  /// If the columns are the effects of consecutive friction magnitudes, without
  /// Impedance::directFriction(): the index of the first magnitude; −1 otherwise. Blocks with the
  /// same base share results, so all earlier columns must have been in tasks of such blocks, and a
  /// column must not change later.
  PetscInt magnitude = -1;
};

/// The known columns Z (0, e) of an Impedance, and the blocks of free unknowns in use. Blocks
/// without a FreeBlock::base are assigned to the ranks in turn.
class FreeUnknowns {
 public:
  /// Collective. Borrows the impedance during the lifetime of the object.
  explicit FreeUnknowns(const Impedance& impedance);
  /// Collective. Computes the columns of the unknowns flagged in `free`, [entry of w], unless they
  /// are known.
  void compute(std::span<const unsigned char> free);
  /// Returns Z (0, e), [n + m]×[known column].
  const linalg::DenseMatrix& columns() const { return columns_; }
  /// Returns the index of the column of an entry of w, numbered on this rank; −1 if the column is
  /// not known.
  PetscInt placeOf(PetscInt unknown) const;
  /// Returns the index of this rank's first entry of w among those of all ranks.
  PetscInt first() const { return first_; }
  /// Returns the index of the known column of an entry of w, numbered over all ranks.
  PetscInt columnOf(PetscInt unknown) const { return place_.at(unknown); }
  /// Collective. Returns the block of these free unknowns, whose columns must be known, and makes
  /// it the newest. A new block is not ready until makeReady() is called. `direct` is the
  /// matrix of Impedance::directFriction(), or null.
  std::shared_ptr<FreeBlock> blockOf(const std::vector<unsigned char>& free, Mat direct);
  /// Collective. Computes the inverses of those blocks that are not ready.
  void makeReady(const std::vector<std::shared_ptr<FreeBlock>>& blocks);
  /// Returns the blocks in use, the newest first.
  const std::vector<std::shared_ptr<FreeBlock>>& blocks() const { return blocks_; }
  /// Collective. Returns for each task, on all ranks, the values of the free unknowns that make F
  /// vanish in their rows, [known column]×[column]. All owners work at the same time.
  std::vector<linalg::DenseMatrix> released(std::span<const ReleaseTask> tasks) const;
  /// Limit on the memory of all inverses, bytes, summed over the ranks; a single one may exceed it.
  static double mostBytes(MPI_Comm comm);

 private:
  std::shared_ptr<FreeBlock> nearest(const std::vector<unsigned char>& free);
  Unknowns unknowns(std::vector<PetscInt> local) const;
  void gatherStiffness(FreeBlock& block);
  void gatherBorder(FreeBlock& block) const;
  linalg::DenseMatrix forcesAt(const Unknowns& at, const linalg::DenseView& effects) const;

  const Impedance& impedance_;
  PetscInt first_ = 0;
  // [released unknown of all ranks] its column in columns_
  std::unordered_map<PetscInt, PetscInt> place_;
  linalg::DenseMatrix columns_;
  std::vector<std::shared_ptr<FreeBlock>> blocks_;
  PetscInt blocksSoFar_ = 0;  // with a stiffness of their own
};

}  // namespace squeal::impedance
