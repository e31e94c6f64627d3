// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Checks of the settings and marches of the regime stage.
#include <mpi.h>

#include <span>

#include "eigen/pencil/settings.hpp"
#include "problem/terms/settings.hpp"
#include "regime/regime/full_model.hpp"
#include "regime/regime/settings.hpp"
#include "regime/regime/task.hpp"

namespace squeal::regime {

/// Throws Error for impossible settings of the stage, and for settings of other stages that it does
/// not support. `terms` is null for matrices from files.
void checkOptions(const Settings& settings, const pencil::Settings& pencil,
                  const terms::Settings* terms);

/// Throws Error if there is no contact, and for convective terms and prestress, which are not
/// supported in time.
void requireSupported(const Settings& settings, const elasticity::Bodies& bodies,
                      const contact::Contact& contact);

/// Collective. Warns if the time steps exceed the stable one, and if a period has few steps.
void warnAboutSteps(MPI_Comm comm, const Settings& settings, std::span<const Task> tasks,
                    double stableStep);

/// Collective. Warns if the bodies are undamped.
void warnAboutDamping(const FullModel& full);

/// Collective. Throws Error for a friction law that the slips of a massless boundary cannot follow.
/// Warns if the law may make them alternate.
void checkLaw(MPI_Comm comm, const ReducedModel& model, std::span<const Task> tasks);

}  // namespace squeal::regime
