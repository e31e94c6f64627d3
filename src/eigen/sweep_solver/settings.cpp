// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep_solver/settings.hpp"

namespace squeal::sweep_solver {

Settings Settings::given(const pencil::Settings& problem) {
  Settings settings;
  settings.modalDamping = problem.modalDamping;
  settings.stability = stability::Settings::given(problem);
  settings.sensitivity = sensitivity::Settings::given();
  if (problem.method == pencil::Method::direct)
    settings.direct = direct::Settings::given(problem);
  else
    settings.reduction = reduction::Settings::given(problem);
  if (settings.reduction) settings.proof = completeness::Settings::given();
  // With the direct method, left vectors start from the free modes.
  if (settings.reduction || settings.sensitivity.wanted) settings.modes = modes::Settings::given();
  return settings;
}

}  // namespace squeal::sweep_solver
