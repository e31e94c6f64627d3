// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The quantities of a ContactSolver that depend on which unknowns are free.
#include <functional>
#include <memory>
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "base/petsc/owned.hpp"
#include "base/system/concatenation.hpp"
#include "steady/impedance/bordered_inverse.hpp"
#include "steady/impedance/symmetric_inverse.hpp"

namespace squeal::impedance {

/// Some released unknowns of all ranks, ordered by rank.
struct Unknowns {
  std::vector<PetscInt> local;   ///< released unknowns of this rank
  std::vector<PetscInt> places;  ///< [unknown of all ranks] its index among the known columns
  Concatenation ranks;           ///< of `local`
};

/// The stiffness of the free unknowns, and the effects of friction while they are free. A block
/// that differs little from an earlier one, its base, uses the inverse of the base.
struct FreeBlock {
  std::vector<unsigned char> free;  ///< [released unknown]
  OwnedMat direct;                  ///< kept alive: its address identifies the block
  Unknowns unknowns;                ///< the free ones
  int owner;                        ///< the rank with the inverse; the owner of the base, if any
  bool isReady = false;             ///< the inverse is known
  linalg::DenseMatrix matrix = {};  ///< on the owner: the stiffness, until it is factorised

  /// Null if the block has a stiffness of its own.
  std::shared_ptr<FreeBlock> base = nullptr;
  Unknowns added = {{}, {}, {MPI_COMM_SELF, 0}};  ///< free here, but not in the base
  std::vector<PetscInt> held = {};  ///< indices in the base of unknowns free there but not here
  /// F of the base's unknowns and of the added ones due to the added ones, until makeReady()
  linalg::DenseMatrix coupling = {}, addedMatrix = {};
  BorderedInverse border = {};  ///< on the owner

  SymmetricInverse stiffness = {};    ///< on the owner of a block without base
  std::vector<double> diagonal = {};  ///< of the stiffness, on its owner
  bool isRegular = true;              ///< the stiffness is positive definite, by a margin
  /// On the owner of a block without base: the inverse times the forces F due to the friction
  /// magnitudes, without direct effects, [free unknown]×[direction]. `solved` is the number of
  /// these columns.
  linalg::DenseMatrix solutions = {};
  PetscInt solved = 0;

  /// R of the friction magnitudes with the free unknowns released, [frictional node]
  linalg::DenseMatrix normal;

  /// Returns the memory of the inverses in bytes, the same on all ranks.
  double bytes() const;
  const FreeBlock& baseOrSelf() const { return base ? *base : *this; }
  FreeBlock& baseOrSelf() { return base ? *base : *this; }
};

/// Collective. Computes the inverses of those blocks that are not ready; all owners work at the
/// same time. If a block or its base is nearly singular, the block loses its base: `gather`, which
/// is collective, then gives it a stiffness of its own.
void makeReady(MPI_Comm comm, const std::vector<std::shared_ptr<FreeBlock>>& blocks,
               const std::function<void(FreeBlock&)>& gather);

}  // namespace squeal::impedance
