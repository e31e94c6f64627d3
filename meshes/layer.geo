// SPDX-License-Identifier: BSD-2-Clause
// One elastic layer, a cell of length Lx of a strip periodic in x; plane mesh, y = 0 is the sliding surface. Lengths in m.
DefineConstant[
  order = {1, Name "order", Choices {1, 2}},              // 1 linear, 2 quadratic cells
  recombine = {1, Name "recombine", Choices {0, 1}},      // 1 quadrangles, 0 triangles
  serendipity = {0, Name "serendipity", Choices {0, 1}},  // 1: quadratic cells without the node in the middle (quad8)
  nx = {36, Name "nx", Min 1, Max 100000, Step 1},        // cells along x
  ny = {12, Name "ny", Min 1, Max 100000, Step 1},        // cells across the thickness
  Lx = {3, Name "Lx"},                                    // period
  h = {1, Name "h"}                                       // thickness
];

Point(1) = {0, -h, 0};
Point(2) = {Lx, -h, 0};
Point(3) = {Lx, 0, 0};
Point(4) = {0, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = nx + 1;
Transfinite Curve {2, 4} = ny + 1;
Transfinite Surface {1};
If (recombine)
  Recombine Surface {1};
EndIf

Physical Curve("bottom") = {1};
Physical Curve("right") = {2};
Physical Curve("top") = {3};
Physical Curve("left") = {4};
Physical Surface("layer") = {1};

Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = serendipity;
