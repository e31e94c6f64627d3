// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep_solver/settings.hpp"

namespace squeal::sweep_solver {

Settings Settings::given() {
  const auto problem = pencil::Settings::given();
  Settings settings;
  settings.modalDamping = problem.modalDamping;
  settings.stability = stability::Settings::given();
  settings.sensitivity = sensitivity::Settings::given();
  if (problem.method == pencil::Method::direct)
    settings.direct = direct::Settings::given();
  else
    settings.reduction = reduction::Settings::given();
  // With the direct method, left vectors start from the free modes.
  if (settings.reduction || settings.sensitivity.wanted) settings.modes = modes::Settings::given();
  return settings;
}

}  // namespace squeal::sweep_solver
