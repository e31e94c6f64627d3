// SPDX-License-Identifier: BSD-2-Clause
// The layer of layer.geo as a solid slab one cell thick in z. Clamp z on the group `layer` for plane strain. Lengths in m.
DefineConstant[
  order = {1, Name "order", Choices {1, 2}},              // 1 linear, 2 quadratic cells
  recombine = {1, Name "recombine", Choices {0, 1}},      // 1 hexahedra, 0 wedges whose triangles lie in planes z = constant
  shape = {recombine ? 1 : 2, Name "shape", Choices {0, 1, 2, 3}},  // 0 tetrahedra, 1 hexahedra, 2 wedges as above, 3 wedges whose triangles face y
  serendipity = {0, Name "serendipity", Choices {0, 1}},  // 1: quadratic cells without nodes inside faces and cells (hex20)
  nx = {36, Name "nx", Min 1, Max 100000, Step 1},        // cells along x
  ny = {12, Name "ny", Min 1, Max 100000, Step 1},        // cells across the thickness
  nz = {1, Name "nz", Min 1, Max 100000, Step 1},         // cells along z
  Lx = {3, Name "Lx"},                                    // period
  h = {1, Name "h"},                                      // thickness
  depth = {Lx / nx, Name "depth"}                         // length along z
];
Include "grid.inc";

base = 0;
arc_centre = 0;
count_3 = 0;
cells = shape;
div_1[] = {nx};
div_2[] = {ny};
div_3[] = {nz};
For k In {0 : 1}
  For j In {0 : 1}
    For i In {0 : 1}
      Point(1 + i + 10 * j + 100 * k) = {i * Lx, (j - 1) * h, k * depth};
    EndFor
  EndFor
EndFor
i = 0; j = 0; k = 0;
Call GridBlock;

Physical Surface("left") = {5001};
Physical Surface("right") = {5002};
Physical Surface("bottom") = {6001};
Physical Surface("top") = {6011};
Physical Surface("back") = {7001};
Physical Surface("front") = {7101};
Physical Volume("layer") = {8001};

Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = serendipity;
