// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Small cases of contact on plane, cylindrical and spherical faces.
#include <cerrno>
#include <string>

#include "support/model/model.hpp"

namespace squeal::test::contact_cases {

/// Two layers, options for their case file.
inline const std::string layers = "-mesh_set nx=6,ny_disc=3,ny_pad=2";
/// Two cylinders, the inner one turning: contact on a circle.
inline const std::string cylinders = "-mesh_file meshes/cylinders.geo " +
                                     material("inner", "1", "0.3", "1") +
                                     material("outer", "1", "0.3", "1") +
                                     "-contact_ring_pad outer_face -contact_ring_disc inner_face "
                                     "-constraint_sym_x_clamped x -constraint_sym_y_clamped y ";

/// A ball turning in a shell that rests, its surface shared: contact on a sphere, frames in all
/// directions. The poles are nodes. Test programs run at the same time: each writes a file of its
/// own.
inline std::string ballInShell(int order) {
  const auto file = writeFile(program_invocation_short_name + std::string("_ball.geo"), R"(
SetFactory("OpenCASCADE");
DefineConstant[order = {1, Name "order"}];
Sphere(1) = {0, 0, 0, 1};
Sphere(2) = {0, 0, 0, 2};
BooleanFragments{ Volume{2}; Delete; }{ Volume{1}; Delete; }
inner() = Boundary{ Volume{1}; };
outer() = Boundary{ Volume{2}; };
outer() -= {Abs(inner(0))};
Physical Volume("ball") = {1};
Physical Volume("shell") = {2};
Physical Surface("face") = {Abs(inner(0))};
Physical Surface("skin") = {outer()};
MeshSize{ : } = 0.7;
Mesh.ElementOrder = order;
)");
  return "-mesh_file " + file + " -mesh_set order=" + std::to_string(order) +
         material("ball", "1", "0.3", "1") + material("shell", "1", "0.3", "1") +
         "-motion_ball_speed 3 -contact_ring_pad face -contact_ring_disc face "
         "-constraint_ball_clamped xyz "
         "-constraint_skin_clamped xyz ";
}

inline void setLayers() { setCase("two_layers", layers); }
inline void setCylinders() {
  setOptions(cylinders + "-mesh_set n_inner=2,n_outer=2,n_theta=16,order=2 -motion_inner_speed 2");
}

}  // namespace squeal::test::contact_cases
