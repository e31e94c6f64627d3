// SPDX-License-Identifier: BSD-2-Clause
// Two elastic layers on each other, a cell of length Lx of strips periodic in x; plane mesh, y = 0 is the sliding surface.
// The meshes match on it unless nx_pad is given. Lengths in m.
DefineConstant[
  order = {1, Name "order", Choices {1, 2}},                  // 1 linear, 2 quadratic cells
  recombine = {1, Name "recombine", Choices {0, 1}},          // 1 quadrangles, 0 triangles
  serendipity = {0, Name "serendipity", Choices {0, 1}},      // 1: quadratic cells without the node in the middle (quad8)
  shared = {0, Name "shared", Choices {0, 1}},                // 1: both layers own the interface nodes, 0: each has its own there
  nx = {36, Name "nx", Min 1, Max 100000, Step 1},            // cells along x
  nx_pad = {nx, Name "nx_pad", Min 1, Max 100000, Step 1},  // cells of the pad along x, where nodes are not shared
  ny_disc = {12, Name "ny_disc", Min 1, Max 100000, Step 1},  // cells across the disc layer
  ny_pad = {7, Name "ny_pad", Min 1, Max 100000, Step 1},     // cells across the pad layer
  Lx = {3, Name "Lx"},                                        // period
  h_disc = {1, Name "h_disc"},                                // thickness of the disc layer
  h_pad = {0.6, Name "h_pad"},                                // thickness of the pad layer
  h_soft = {0, Name "h_soft"}                                 // thickness of a layer, one cell, between pad and disc, on the pad (shared=0)
];

// Disc layer: curves 1 bottom, 2 right, 3 face, 4 left.
Point(1) = {0, -h_disc, 0};
Point(2) = {Lx, -h_disc, 0};
Point(3) = {Lx, 0, 0};
Point(4) = {0, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {4, 3};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, -3, 4};
Plane Surface(1) = {1};

// Pad layer: curves 13 (or 3) face, 12 right, 11 top, 14 left.
Point(11) = {0, h_soft + h_pad, 0};
Point(12) = {Lx, h_soft + h_pad, 0};
If (shared)
  start = 4;
  end = 3;
  face = 3;
Else
  start = 14;
  end = 13;
  face = 13;
  Point(start) = {0, h_soft, 0};
  Point(end) = {Lx, h_soft, 0};
  Line(face) = {start, end};
EndIf
Line(12) = {end, 12};
Line(11) = {12, 11};
Line(14) = {11, start};
Curve Loop(2) = {face, 12, 11, 14};
Plane Surface(2) = {2};

// Soft layer: curves 23 face, 22 right, 24 left.
pad_face = face;
left() = {14};
right() = {12};
surfaces() = {1, 2};
If (h_soft > 0)
  Point(21) = {0, 0, 0};
  Point(22) = {Lx, 0, 0};
  Line(23) = {21, 22};
  Line(22) = {22, end};
  Line(24) = {start, 21};
  Curve Loop(3) = {23, 22, -face, 24};
  Plane Surface(3) = {3};
  Transfinite Curve {22, 24} = 2;
  Transfinite Curve {23} = nx_pad + 1;
  pad_face = 23;
  left() += {24};
  right() += {22};
  surfaces() += {3};
  Physical Surface("soft") = {3};
EndIf

Transfinite Curve {1, 3} = nx + 1;
Transfinite Curve {11, face} = (shared ? nx : nx_pad) + 1;
Transfinite Curve {2, 4} = ny_disc + 1;
Transfinite Curve {12, 14} = ny_pad + 1;
Transfinite Surface {surfaces()};
If (recombine)
  Recombine Surface {surfaces()};
EndIf

Physical Curve("disc_bottom") = {1};
Physical Curve("disc_right") = {2};
Physical Curve("disc_face") = {3};
Physical Curve("disc_left") = {4};
Physical Curve("pad_face") = {pad_face};
Physical Curve("pad_right") = {right()};
Physical Curve("pad_top") = {11};
Physical Curve("pad_left") = {left()};
Physical Surface("disc") = {1};
Physical Surface("pad") = {2};

Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = serendipity;
