// SPDX-License-Identifier: BSD-2-Clause
// Patch test with three kinds of cells: hexahedra below, tetrahedra above, and pyramids between them on the faces of the hexahedra.
// The surface where they meet is warped. Lengths in m.
DefineConstant[
  order = {1, Name "order", Choices {1, 2}},              // 1 linear, 2 quadratic cells
  serendipity = {0, Name "serendipity", Choices {0, 1}},  // 1: quadratic cells without nodes inside faces and cells
  n = {2, Name "n", Min 1, Max 100000, Step 1}            // cells along each edge of both halves
];

// Corner i of level k: the unit square at z = 0, the warped surface, the unit square at z = 1.
middle[] = {0.45, 0.55, 0.4, 0.5};
For i In {0 : 3}
  x = (i == 1 || i == 2) ? 1 : 0;
  y = (i >= 2) ? 1 : 0;
  Point(1 + i) = {x, y, 0};
  Point(5 + i) = {x, y, middle[i]};
  Point(9 + i) = {x, y, 1};
EndFor
For k In {0 : 2}
  For i In {0 : 3}
    Line(1 + i + 10 * k) = {1 + i + 4 * k, 1 + (i + 1) % 4 + 4 * k};
    If (k < 2)
      Line(101 + i + 10 * k) = {1 + i + 4 * k, 5 + i + 4 * k};
    EndIf
  EndFor
  Curve Loop(1 + k) = {1 + 10 * k, 2 + 10 * k, 3 + 10 * k, 4 + 10 * k};
  Surface(1 + k) = {1 + k};
EndFor
For k In {0 : 1}
  For i In {0 : 3}
    Curve Loop(11 + i + 10 * k) = {1 + i + 10 * k, 101 + (i + 1) % 4 + 10 * k, -(11 + i + 10 * k), -(101 + i + 10 * k)};
    Plane Surface(11 + i + 10 * k) = {11 + i + 10 * k};
  EndFor
  Surface Loop(1 + k) = {1 + k, 2 + k, 11 + 10 * k, 12 + 10 * k, 13 + 10 * k, 14 + 10 * k};
  Volume(1 + k) = {1 + k};
EndFor
Transfinite Curve {:} = n + 1;
Transfinite Surface {:};
Recombine Surface {1, 2, 11 : 14};
Transfinite Volume {1};

Physical Surface("boundary") = {1, 3, 11 : 14, 21 : 24};
Physical Volume("body") = {1, 2};

Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = serendipity;
