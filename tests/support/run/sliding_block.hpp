// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A block clamped at its foot and pressed at its top by a sliding plate. Friction bends it, and
/// its five contact nodes lift one after the other.
#include <string>

namespace squeal::test {

inline const std::string block =
    "-mesh_file meshes/layer.geo -mesh_set Lx=0.5,nx=4,ny=8 -material_layer_young 1e9 "
    "-material_layer_poisson 0.3 "
    "-material_layer_density 1000"
    " -constraint_bottom_clamped xy -contact_plate_pad top -contact_plate_obstacle_velocity 1,0,0 "
    "-contact_plate_obstacle_displacement 0,-0.001,0"
    " -report_fields off ";

}  // namespace squeal::test
