// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The periodic motions after flutter, stable or not. The first is found by shooting from a time
/// integration, the others by continuation with friction as the parameter [M.77, M.78].
#include <string>
#include <vector>

#include "base/session/stages.hpp"
#include "regime/cycles/branch.hpp"
#include "regime/cycles/section.hpp"
#include "regime/cycles/shooting.hpp"
#include "regime/regime/settings.hpp"

namespace squeal::regime {

/// A periodic motion.
struct PeriodicMotion {
  double friction = 0;  ///< swept coefficient of friction
  double period = 0;    ///< s
  bool converged = false;
  double change = 0;  ///< relative change over a period after Newton's method
  cycles::Measures measures;
  /// Floquet multipliers with a modulus of at least 0.1, by descending modulus; empty unless
  /// converged.
  cycles::Multipliers multipliers;
  Complex trivialMultiplier() const { return multipliers.values[multipliers.trivial]; }
  /// Returns the largest multiplier except the trivial one; 0 if there is none.
  Complex largestMultiplier() const;
  bool stable() const { return std::abs(largestMultiplier()) < 1; }
};

/// The periodic motions found from one time integration.
struct Cycles {
  std::vector<PeriodicMotion> motions;  ///< first the one found by shooting, then the branch
  /// The two parts of the branch: from the first motion towards smaller and towards larger
  /// friction.
  std::vector<cycles::Route> routes;
  /// The error that ended the search, with the option and the remedy; empty: none.
  std::string failure;
};

/// Stores the passes of a time integration through a Poincaré section, window by window.
class SectionRecord {
 public:
  /// Borrows the model.
  SectionRecord(const march::ReducedModel& model, const march::LinearMode& mode);
  /// Has no effect unless the scheme is massless.
  void inspect(const march::Scheme& scheme);
  void endWindow() { windows_.push_back(section_.take()); }
  /// Returns the passes of the last `windows` windows.
  cycles::Passes last(std::size_t windows) const;

 private:
  cycles::Section section_;
  std::vector<cycles::Passes> windows_;
};

/// The data from which shooting starts.
struct CycleStart {
  double friction = 0;           ///< swept coefficient of friction of the model
  const cycles::Passes& passes;  ///< passes of a time integration; borrowed
  double step = 0;               ///< its time step, s
};

/// Collective. Returns the periodic motions of the model. An Error ends the search, and its message
/// is returned in Cycles::failure.
Cycles findCycles(MPI_Comm comm, const march::ReducedModel& model, const CycleSettings& settings,
                  const CycleStart& start, Stage& stage);

}  // namespace squeal::regime
