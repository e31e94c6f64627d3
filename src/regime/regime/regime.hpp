// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The motion after flutter [§ 17]: time integration from a growing unstable mode, on a reduced
/// model with stick, slip and separation at every contact node, and the kind of the motion.
#include <cmath>
#include <string>
#include <vector>

#include "algebra/linalg/block.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "regime/regime/checks.hpp"
#include "regime/regime/cycle.hpp"
#include "regime/regime/mode_onset.hpp"
#include "regime/regime/record.hpp"
#include "regime/regime/reduced_model.hpp"
#include "regime/regime/settings.hpp"
#include "regime/sound/visible_surface.hpp"

namespace squeal::regime {

/// One march from one start.
struct Run {
  std::string start;          ///< the number of the unstable mode, or "all"
  Complex s;                  ///< of the mode, or of the fastest growing one
  std::string failure;        ///< the reason if nothing was measured; empty: none
  Onset onset;                ///< first contact node that separates, sticks or slides
  Point onsetPosition{};      ///< m
  double onsetKinetic = NAN;  ///< largest kinetic energy over a cycle there, J; NaN: not known
  double step = NAN;          ///< s; NaN: not known
  Regime regime;
  Cycles cycles;  ///< with `-regime_cycle`
  sound::VisibleSurface surface;
};

/// The results at one point of the sweep.
struct Study {
  sweep::Parameters at;
  int unstable = 0;          ///< modes that are unstable there
  int modes = 0, rows = 0;   ///< of the reduced model, its contact rows; 0: no such model
  double modelError = NAN;   ///< largest |δs|/|s| of its eigenvalues from the certified ones
  double stableStep = 0;     ///< with all contact nodes held, s
  double steadyPower = NAN;  ///< heat of friction of steady sliding, W
  std::vector<Node> nodes;
  /// [node] its index among the contact nodes of this rank; −1 on other ranks
  std::vector<PetscInt> contactNode;
  std::vector<Run> runs;  ///< of all starts
  /// Failures at the point, already printed, each with the names of point and start and the remedy.
  std::vector<std::string> failures;
};

/// Collective. Returns the regime at one point. `free` contains the free modes as nodal
/// displacements, this rank's rows; `modes` contains the shapes of the unstable modes. An Error,
/// for example if the reduced model does not reproduce the certified eigenvalues, counts as a
/// failure of the point or of one start: it is printed and returned, not thrown. Throws Interrupted
/// within a second of a request to stop.
Study study(const FullModel& full, const Settings& settings, linalg::Block free,
            const pencil::ComplexModes& modes);

}  // namespace squeal::regime
