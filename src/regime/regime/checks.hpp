// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Checks of the settings and of the planned time integrations of the stage `regime`.
#include <mpi.h>

#include <span>

#include "eigen/pencil/settings.hpp"
#include "problem/terms/settings.hpp"
#include "regime/regime/full_model.hpp"
#include "regime/regime/settings.hpp"
#include "regime/regime/task.hpp"

namespace squeal::regime {

/// Throws Error for contradictory settings of this stage, and for settings of other stages that
/// this stage does not support. `terms` is null for matrices from files.
void checkOptions(const Settings& settings, const pencil::Settings& pencil,
                  const terms::Settings* terms);

/// Throws Error for a model without contact, and for properties that the time integration does not
/// support: convective terms, prestress, interfaces that cannot separate, and a friction law
/// together with periodic motions.
void requireSupported(const Settings& settings, const elasticity::Bodies& bodies,
                      const contact::Contact& contact);

/// Collective. Warns if the boundary is massless and a time step exceeds `stableStep`, s, and if a
/// period has fewer steps than the number of frames requested.
void warnAboutSteps(MPI_Comm comm, const Settings& settings, std::span<const Task> tasks,
                    double stableStep);

/// Collective. Warns if the bodies are undamped.
void warnAboutDamping(const FullModel& full);

/// Collective. Throws Error if the friction law makes the slips of a massless boundary unstable
/// (lawGain()). Warns if they may be unstable near the steepest part of the law, or would be
/// unstable with sufficiently short time steps.
void checkLaw(MPI_Comm comm, const ReducedModel& model, std::span<const Task> tasks);

}  // namespace squeal::regime
