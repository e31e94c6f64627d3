// SPDX-License-Identifier: BSD-2-Clause
// Patch test in the plane: the unit square of 2 x 2 blocks whose corners are moved off the regular grid, so that every cell is
// distorted. Lengths in m.
DefineConstant[
  order = {1, Name "order", Choices {1, 2}},              // 1 linear, 2 quadratic cells
  recombine = {1, Name "recombine", Choices {0, 1}},      // 1 quadrangles, 0 triangles
  serendipity = {0, Name "serendipity", Choices {0, 1}},  // 1: quadratic cells without the node in the middle (quad8)
  n = {1, Name "n", Min 1, Max 100000, Step 1}            // cells along each side of a block
];

// Points 1 + i + 3 j: the ends of the sides stay, points on a side move along it, the one inside moves freely.
x[] = {0, 0.42, 1, 0, 0.56, 1, 0, 0.61, 1};
y[] = {0, 0, 0, 0.55, 0.41, 0.38, 1, 1, 1};
For p In {0 : 8}
  Point(1 + p) = {x[p], y[p], 0};
EndFor
For j In {0 : 2}
  For i In {0 : 1}
    Line(11 + i + 3 * j) = {1 + i + 3 * j, 2 + i + 3 * j};  // along x from point (i, j)
    Line(21 + 3 * i + j) = {1 + j + 3 * i, 4 + j + 3 * i};  // along y from point (j, i)
  EndFor
EndFor
For j In {0 : 1}
  For i In {0 : 1}
    s = 1 + i + 3 * j;
    Curve Loop(s) = {10 + s, 21 + s, -(13 + s), -(20 + s)};
    Plane Surface(s) = {s};
  EndFor
EndFor
Transfinite Curve {11, 12, 14, 15, 17, 18, 21 : 26} = n + 1;
Transfinite Surface {1, 2, 4, 5};
If (recombine)
  Recombine Surface {1, 2, 4, 5};
EndIf

Physical Curve("boundary") = {11, 12, 23, 26, 18, 17, 24, 21};
Physical Surface("body") = {1, 2, 4, 5};

Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = serendipity;
