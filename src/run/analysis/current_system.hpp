// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The systems of equations of active sets.
#include <memory>
#include <optional>

#include "model/contact/active_set.hpp"
#include "model/contact/coupled.hpp"
#include "run/analysis/model.hpp"

namespace squeal::analysis {

/// Makes the systems of active sets. It stores the latest system, so that steady states and
/// vibrations share its factorisation. From the second set on, it also stores the projections with
/// all contact open, and takes the projections of each set from these as submatrices. This saves
/// time, since a product TᵀKT takes more than half as long as a factorisation. dropOpen() frees
/// these projections until they are needed again.
class CurrentSystem {
 public:
  /// Borrows the model during the life of the object.
  explicit CurrentSystem(const Model& model) : model_(model) {}
  /// Collective. Returns the system of an active set, borrowed until the next call. Its K0 is
  /// factorised on first use.
  const contact::CoupledSystem& of(const contact::ActiveSet& active);
  /// Collective. Returns the projections with all contact open, borrowed until dropOpen().
  const contact::OpenProjections& open();
  /// Collective. Frees the projections with all contact open.
  void dropOpen();
  /// Collective. Returns a new system of an active set.
  std::unique_ptr<contact::CoupledSystem> make(const contact::ActiveSet& active);

 private:
  const Model& model_;
  std::unique_ptr<contact::CoupledSystem> system_;
  std::optional<contact::OpenProjections> open_;
  int made_ = 0;
};

}  // namespace squeal::analysis
