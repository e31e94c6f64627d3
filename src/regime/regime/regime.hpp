// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The motion after flutter [§ 17]. A reduced model with stick, slip and separation at every
/// contact node is integrated in time, starting on an unstable mode. The resulting motion is
/// classified.
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

/// One time integration from one start.
struct Run {
  std::string start;          ///< the number of the unstable mode, or "all"
  Complex s;                  ///< eigenvalue of the mode; for "all" that of the fastest growing one
  std::string failure;        ///< why there are no results; empty: no failure
  Onset onset;                ///< first separation, stick or slip of a contact node
  Point onsetPosition{};      ///< m
  double onsetKinetic = NAN;  ///< largest kinetic energy of a cycle at the onset, J; NaN: unknown
  double step = NAN;          ///< time step, s; NaN: unknown
  Regime regime;
  Cycles cycles;  ///< periodic motions (`-regime_cycle`)
  sound::VisibleSurface surface;
};

/// The results at one point of the sweep.
struct Study {
  sweep::Parameters at;
  int unstable = 0;         ///< number of unstable modes there
  int modes = 0, rows = 0;  ///< numbers of modes and contact rows of the reduced model; 0: no model
  double modelError = NAN;  ///< largest relative error of the unstable eigenvalues of the model
  double stableStep = 0;    ///< stable time step with all contact nodes held, s
  double steadyPower = NAN;  ///< friction power of steady sliding, W
  std::vector<Node> nodes;
  /// [node] its index among the contact nodes of this rank; −1 if another rank has it
  std::vector<PetscInt> contactNode;
  std::vector<Run> runs;  ///< one per start
  /// Failures at the point, which have already been printed. Each names the point, the start and
  /// the remedy.
  std::vector<std::string> failures;
};

/// Collective. Returns the motion after flutter at one point. `free` contains the free modes as
/// nodal displacements, this rank's rows; `modes` contains the shapes of the unstable modes. An
/// Error, for example if the reduced model does not reproduce the certified eigenvalues, is not
/// thrown: it is printed and returned as a failure of the point or of one start. Throws Interrupted
/// within a second of a request to stop.
Study study(const FullModel& full, const Settings& settings, linalg::Block free,
            const pencil::ComplexModes& modes);

}  // namespace squeal::regime
