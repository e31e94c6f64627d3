// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The condensed contact of small models.
#include <string>
#include <vector>

#include "model/contact/coupled.hpp"
#include "steady/condensed/condensed_problem.hpp"
#include "steady/impedance/contact_solver.hpp"
#include "support/model/model.hpp"

namespace squeal::test {

/// Two pads on a disc, one of which the contact and a spring along it alone hold: without friction
/// the Newton method of SNES opens all its nodes and stops there.
inline const std::string floatingPad =
    "-mesh_file tests/inputs/floating_pad/pads.msh -elasticity_plane stress -contact_main_pad "
    "pad_y0"
    " -contact_main_disc disc_y1 -contact_main_slave disc -motion_disc_velocity 4.8,0,0"
    " -contact_other_pad second_y1 -contact_other_disc disc_y0 -constraint_disc_x0_clamped xy"
    " -constraint_disc_x1_clamped xy -constraint_pad_y1_clamped x"
    " -ground_second_stiffness 1.1e8,0,0 -load_pad_y1_part_pressure 1.9e6"
    " -load_second_y0_part_pressure 8e6 -material_pad_density 6000 -material_pad_young 1.1e10"
    " -material_pad_poisson 0.23 -material_disc_density 2500 -material_disc_young 7.8e9"
    " -material_disc_poisson 0.06 -material_second_density 2400 -material_second_young 4.4e10"
    " -material_second_poisson 0.21";

/// The condensed problem of a model, with what it needs to exist.
struct Condensed {
  explicit Condensed(const std::string& options)
      : model((setOptions(options), buildModel())),
        closed(model.bodies, model.contact, {allClosed(), {}}),
        problem(*model.mesh, model.bodies, model.contact),
        impedance(model.contact, problem.transformation(), model.bodies.stiffness,
                  model.contact.slipRows(problem.transformation(), unitSlip(), allClosed(), 0),
                  closed),
        solver(impedance) {}
  std::vector<unsigned char> allClosed() const {
    return std::vector<unsigned char>(model.contact.interfaces.nodes.size(), 1);
  }
  std::vector<contact::Slip> unitSlip() const {
    auto slips = model.contact.slip(1, nullptr);
    for (auto& slip : slips) slip.coefficient = {1, 0}, slip.law = 1;
    return slips;
  }
  /// Returns the problem of the gaps at a friction, with the forces of the closed contact.
  impedance::ContactCase contactCase(double friction) {
    condensed::CondensedProblem whole(problem, closed);
    impedance::ContactCase one;
    one.given = whole.onSet({{0}, allClosed(), steady::Sticking::allHeld(model.contact)}).effects;
    for (const auto& slip : model.contact.slip(1, nullptr))
      one.conditions.coefficient.push_back(slip.friction(friction));
    one.conditions.free.assign(impedance.nodeOf().size(), 0);
    return one;
  }
  decltype(buildModel()) model;
  contact::CoupledSystem closed;
  steady::Problem problem;
  impedance::Impedance impedance;
  impedance::ContactSolver solver;
};

}  // namespace squeal::test
