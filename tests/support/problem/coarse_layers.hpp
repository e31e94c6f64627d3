// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Two layers that slide on each other, on a coarse mesh: 156 unknowns, few enough for dense
/// matrices of the full order.
#include <memory>
#include <string>
#include <vector>

#include "eigen/modes/modes.hpp"
#include "model/contact/coupled.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal::test {

struct Layers {
  Model model;
  std::unique_ptr<contact::CoupledSystem> system;
  explicit Layers(const std::string& options = {}) {
    setCase("two_layers", "-mesh_set nx=12,ny_disc=4,ny_pad=3 " + options);
    model = buildModel();
    system = std::make_unique<contact::CoupledSystem>(
        model.bodies, model.contact,
        contact::ActiveSet::bonded(model.contact.interfaces.nodes.size()));
  }
  modes::Modes modes() const { return modes::compute(*system, modes::Settings::given()); }
};

}  // namespace squeal::test
