// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The associated system of one active set at a time.
#include <memory>

#include "model/contact/active_set.hpp"
#include "model/contact/coupled.hpp"
#include "run/analysis/model.hpp"

namespace squeal::analysis {

/// Stores the system of the active set that was asked for last, so that steady states and
/// vibrations share its factorisation.
class CurrentSystem {
 public:
  /// Borrows the model during the life of the object.
  explicit CurrentSystem(const Model& model) : model_(model) {}
  /// Collective. Returns the system of an active set, borrowed until the next call. Its K0 is
  /// factorised on first use.
  const contact::CoupledSystem& of(const contact::ActiveSet& active);

 private:
  const Model& model_;
  std::unique_ptr<contact::CoupledSystem> system_;
};

}  // namespace squeal::analysis
