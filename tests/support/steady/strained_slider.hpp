// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A pad on a disc layer that strains unevenly below it, so that convective terms turn the slip and
/// change its length; friction follows the speed.
#include <string>

#include "base/system/text.hpp"
#include "support/model/model.hpp"

namespace squeal::test::slider {

inline constexpr double speed = 0.05, step = 0.25;  // V, m/s; length of the cells along x
inline constexpr double staticRatio = 1.5, decaySpeed = 0.05;
inline const std::string law =
    formatted("-friction_law exponential -friction_static_ratio %g -friction_decay_speed %g ",
              staticRatio, decaySpeed);

/// A disc layer of three blocks in a row, periodic along x, 3 × 1, and a pad of length 1 on the
/// middle one; solid if `depth` > 0. Under the pad the strain is anything but uniform along x.
/// `side`: the middle block's face at z = 0, or in the plane the end of the pad.
inline std::string mesh(int order, double depth) {
  std::string text =
      formatted("n = %d; depth = %g;\n", static_cast<int>(1 / step) / order, depth) + R"(
For i In {0 : 3}
  Point(1 + i) = {i, -1, 0};
  Point(11 + i) = {i, 0, 0};
  Line(11 + i) = {1 + i, 11 + i};
EndFor
Point(21) = {1, 0.6, 0};
Point(22) = {2, 0.6, 0};
For i In {0 : 2}
  Line(1 + i) = {1 + i, 2 + i};
  Line(21 + i) = {11 + i, 12 + i};
  Curve Loop(1 + i) = {1 + i, 12 + i, -(21 + i), -(11 + i)};
  Plane Surface(1 + i) = {1 + i};
EndFor
Line(31) = {12, 21};
Line(32) = {13, 22};
Line(33) = {21, 22};
Curve Loop(4) = {22, 32, -33, -31};
Plane Surface(4) = {4};
Transfinite Curve {1 : 3, 21 : 23, 33} = n + 1;
Transfinite Curve {11 : 14, 31, 32} = 3;
Transfinite Surface {1 : 4};
Recombine Surface {1 : 4};
If (depth > 0)
  For i In {0 : 3}
    out[] = Extrude {0, 0, depth} { Surface{1 + i}; Layers{2}; Recombine; };
    volume[] += {out[1]};
    below[] += {out[2]};
    right[] += {out[3]};
    above[] += {out[4]};
    left[] += {out[5]};
  EndFor
  Physical Volume("disc") = {volume[0], volume[1], volume[2]};
  Physical Volume("pad") = {volume[3]};
  Physical Surface("disc_bottom") = {below[0], below[1], below[2]};
  Physical Surface("disc_left") = {left[0]};
  Physical Surface("disc_right") = {right[2]};
  Physical Surface("disc_face") = {above[1]};
  Physical Surface("pad_face") = {above[1]};
  Physical Surface("pad_top") = {above[3]};
  Physical Surface("side") = {2};
Else
  Physical Surface("disc") = {1 : 3};
  Physical Surface("pad") = {4};
  Physical Curve("disc_bottom") = {1 : 3};
  Physical Curve("disc_left") = {11};
  Physical Curve("disc_right") = {14};
  Physical Curve("disc_face") = {22};
  Physical Curve("pad_face") = {22};
  Physical Curve("pad_top") = {33};
  Physical Curve("side") = {31};
EndIf
)" + formatted("Mesh.ElementOrder = %d;\n", order);
  return writeFile(formatted("slider_%d_%g.geo", order, depth), text);
}

/// The pad is displaced down and aside; the pressure on `side` turns the slip of the solid disc.
inline std::string options(int order, double depth) {
  const std::string all = depth > 0 ? "xyz" : "xy";
  return "-mesh_file " + mesh(order, depth) + material("disc", "1", "0.3", "1") +
         material("pad", "0.4", "0.25", "0.6") +
         formatted("-motion_disc_velocity %g,0,0 -motion_convective on ", speed) + law +
         "-constraint_disc_bottom_clamped " + all + " -constraint_pad_top_clamped " + all +
         " -constraint_pad_top_displacement 0.1,-0.2," + (depth > 0 ? "0.05" : "0") +
         " -constraint_disc_right_image_of disc_left -contact_face_pad pad_face -contact_face_disc "
         "disc_face -load_side_pressure "
         "0.2 ";
}

}  // namespace squeal::test::slider
