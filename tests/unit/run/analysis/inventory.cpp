// SPDX-License-Identifier: BSD-2-Clause
// The list of supports, loads and joints: every option of them is in it.
#include "run/analysis/inventory.hpp"

#include <gtest/gtest.h>

#include "support/model/model.hpp"

namespace squeal {
namespace {

TEST(Inventory, HasAllItems) {
  test::setOptions(
      "-mesh_file meshes/beam.geo -mesh_set nx=4,Ly=0.4,Lz=0.3 " +
      test::material("beam", "2e11", "0.3", "8000") +
      "-constraint_clamped_clamped xyz -constraint_weight_clamped xy "
      "-constraint_weight_clamped_rotation xyz -ground_top_stiffness 1,2,3 "
      "-load_bottom_pressure 5 -load_bottom_hydraulic off -load_end_force 1,0,2 "
      "-load_end_moment 0,0,7 -load_gravity 0,0,-9.81 -load_beam_spin 2 "
      "-load_beam_acceleration 1,2,3 "
      "-reference_end_position 1,0,0 -reference_weight_position 1.5,0,0.25 "
      "-coupling_end_reference end -coupling_end_nodes tip -coupling_end_components xy "
      "-mass_weight_total 80 -mass_weight_inertia 1,1,1,0,0,0 -mass_right_total 3 "
      "-equation_lever 'end:z - 2*weight:z = 0' "
      "-spring_s_from end -spring_s_to weight -spring_s_stiffness 5 "
      "-bushing_b_from end -bushing_b_damping 1,2,3 -frame_f_axis 1,0,0 -frame_f_origin 0,5,5 "
      "-bushing_b_frame f ");
  const auto mesh = test::readMesh();
  std::vector<std::string> found;
  for (const auto& [kind, items] : analysis::inventory(mesh, analysis::ModelSettings::given()))
    for (const auto& item : items) found.push_back(kind + ": " + analysis::text(item));
  const std::vector<std::string> expected{
      "supports: clamped (9 nodes, clamped xyz)",
      "supports: top (15 nodes, stiffness_n_per_m 1,2,3)",
      "supports: weight (clamped xy, clamped_rotation xyz)",
      "loads: beam (acceleration_m_per_s2 1,2,3, spin_rad_per_s 2)",
      "loads: bottom (8 faces, pressure_pa 5, hydraulic off)",
      "loads: end (force_n 1,0,2, moment_n_m 0,0,7)",
      "loads: gravity (acceleration_m_per_s2 0,0,-9.81)",
      "references: end (position_m 1,0,0)",
      "references: weight (position_m 1.5,0,0.25)",
      "couplings: end (kind rigid, reference end, groups tip, 9 nodes, components xy)",
      "equations: lever (equation end:z - 2*weight:z = 0)",
      "springs: s (from end, to weight, stiffness_n_per_m 5, damping_n_s_per_m 0)",
      "bushings: b (from end, to the ground, stiffness 0,0,0, damping 1,2,3, frame f)",
      "masses: right (15 nodes, mass_kg 3)",
      "masses: weight (mass_kg 80, inertia_kg_m2 1,1,1,0,0,0)"};
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace squeal
