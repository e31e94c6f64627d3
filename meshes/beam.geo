// SPDX-License-Identifier: BSD-2-Clause
// Cantilever along x with a rectangular section, also a plain box for other checks. Lengths in m.
DefineConstant[
  order = {1, Name "order", Choices {1, 2}},              // 1 linear, 2 quadratic cells
  recombine = {1, Name "recombine", Choices {0, 1}},      // 1 hexahedra, 0 tetrahedra
  serendipity = {0, Name "serendipity", Choices {0, 1}},  // 1: quadratic cells without nodes inside faces and cells (hex20)
  Lx = {1, Name "Lx"},                                    // length
  Ly = {0.04, Name "Ly"},                                 // width
  Lz = {0.02, Name "Lz"},                                 // height; unlike the width, so that no two bending modes coincide
  nx = {40, Name "nx", Min 1, Max 100000, Step 1},        // cells along the length
  ny = {2, Name "ny", Min 1, Max 100000, Step 1},         // cells across the width
  nz = {2, Name "nz", Min 1, Max 100000, Step 1}          // cells across the height
];
Include "grid.inc";

base = 0;
arc_centre = 0;
count_3 = 0;
cells = recombine;
div_1[] = {nx};
div_2[] = {ny};
div_3[] = {nz};
For k In {0 : 1}
  For j In {0 : 1}
    For i In {0 : 1}
      Point(1 + i + 10 * j + 100 * k) = {i * Lx, (j - 0.5) * Ly, (k - 0.5) * Lz};
    EndFor
  EndFor
EndFor
i = 0; j = 0; k = 0;
Call GridBlock;

Physical Surface("clamped") = {5001};
Physical Surface("tip") = {5002};
Physical Surface("right") = {6001};
Physical Surface("left") = {6011};
Physical Surface("bottom") = {7001};
Physical Surface("top") = {7101};
Physical Volume("beam") = {8001};

Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = serendipity;
