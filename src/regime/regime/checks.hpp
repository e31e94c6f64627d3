// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Checks of the settings and of the marches of a regime.
#include <mpi.h>

#include <span>

#include "eigen/pencil/settings.hpp"
#include "problem/terms/settings.hpp"
#include "regime/regime/full_model.hpp"
#include "regime/regime/settings.hpp"
#include "regime/regime/task.hpp"

namespace squeal::regime {

/// Throws Error for settings of the stage that no march can satisfy, and for settings of other
/// stages that it does not support. `terms` is null for matrices from files.
void checkOptions(const Settings& settings, const pencil::Settings& pencil,
                  const terms::Settings* terms);

/// Throws Error if there is no contact, and for convective terms and prestress, which are not
/// supported in time.
void requireSupported(const Settings& settings, const elasticity::Bodies& bodies,
                      const contact::Contact& contact);

/// Collective. Warns if steps are longer than is safe, and if a period has few of them.
void warnAboutSteps(MPI_Comm comm, const Settings& settings, std::span<const Task> tasks,
                    double stableStep);

/// Collective. Warns if the bodies are undamped.
void warnAboutDamping(const FullModel& full);

/// Collective. Throws Error for a friction law that slips of a massless boundary do not follow.
/// Warns if the law may make them alternate.
void checkLaw(MPI_Comm comm, const ReducedModel& model, std::span<const Task> tasks);

}  // namespace squeal::regime
