// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The periodic motions after flutter, stable or not: by shooting from a march, and by continuation
/// over the friction [M.77, M.78].
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
  double friction = 0;  ///< the swept coefficient
  double period = 0;    ///< s
  bool converged = false;
  double change = 0;  ///< over a period, at the end of Newton's method
  cycles::Measures measures;
  /// By descending modulus, all above a tenth; empty unless it has converged.
  cycles::Multipliers multipliers;
  Complex trivialMultiplier() const { return multipliers.values[multipliers.trivial]; }
  /// Returns the largest multiplier except the trivial one; 0 if there is none.
  Complex largestMultiplier() const;
  bool stable() const { return std::abs(largestMultiplier()) < 1; }
};

/// The periodic motions from one march.
struct Cycles {
  std::vector<PeriodicMotion> motions;  ///< the first at the friction of the march, then the branch
  /// The branch from the first motion towards smaller and towards larger friction.
  std::vector<cycles::Route> routes;
  /// The error that ended the search, with option and remedy; empty: none.
  std::string failure;
};

/// Stores the passes of a march through a section, window by window.
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

/// The start of shooting.
struct CycleStart {
  double friction = 0;           ///< at which the model was made
  const cycles::Passes& passes;  ///< of a march; borrowed
  double step = 0;               ///< of that march, s
};

/// Collective. Returns the periodic motions of the model. An Error ends the search and is returned
/// in the result.
Cycles findCycles(MPI_Comm comm, const march::ReducedModel& model, const CycleSettings& settings,
                  const CycleStart& start, Stage& stage);

}  // namespace squeal::regime
