// SPDX-License-Identifier: BSD-2-Clause
// Patch test in space: the unit cube of 2 x 2 x 2 blocks whose corners are moved off the regular grid, so that every cell is
// distorted. The faces of the cube stay plane, those inside are warped. Lengths in m.
DefineConstant[
  order = {1, Name "order", Choices {1, 2}},              // 1 linear, 2 quadratic cells
  recombine = {1, Name "recombine", Choices {0, 1}},      // 1 hexahedra, 0 tetrahedra, or wedges:
  wedge = {0, Name "wedge", Choices {0, 1}},              // 1, with recombine = 0: wedges
  serendipity = {0, Name "serendipity", Choices {0, 1}},  // 1: quadratic cells without nodes inside faces and cells (hex20)
  n = {1, Name "n", Min 1, Max 100000, Step 1}            // cells along each edge of a block
];
Include "grid.inc";

base = 0;
arc_centre = 0;
count_3 = 0;
cells = recombine ? 1 : (wedge ? 2 : 0);
div_1[] = {n, n};
div_2[] = {n, n};
div_3[] = {n, n};

// The middle point of each row is moved by a different amount, always inside the face or edge it is on.
For k In {0 : 2}
  For j In {0 : 2}
    For i In {0 : 2}
      dx = (i == 1) ? 0.05 * Cos(1 + 2 * j + 5 * k) : 0;
      dy = (j == 1) ? 0.05 * Cos(2 + 3 * i + 4 * k) : 0;
      dz = (k == 1) ? 0.05 * Cos(3 + 7 * i + 2 * j) : 0;
      Point(1 + i + 10 * j + 100 * k) = {0.5 * i + dx, 0.5 * j + dy, 0.5 * k + dz};
    EndFor
  EndFor
EndFor
boundary[] = {};
body[] = {};
For k In {0 : 1}
  For j In {0 : 1}
    For i In {0 : 1}
      Call GridBlock;
      body[] += {8000 + grid_0};
      boundary[] += {5001 + 2 * i + 10 * j + 100 * k};
      boundary[] += {6001 + i + 20 * j + 100 * k};
      boundary[] += {7001 + i + 10 * j + 200 * k};
    EndFor
  EndFor
EndFor

Physical Surface("boundary") = boundary[];
Physical Volume("body") = body[];

Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = serendipity;
