// SPDX-License-Identifier: BSD-2-Clause
// The two layers of two_layers.geo as solid slabs one cell thick in z: clamp z on both bodies for plane strain, or x and y, with
// front an image of back, for anti-plane motion. Lengths in m.
DefineConstant[
  order = {1, Name "order", Choices {1, 2}},                  // 1 linear, 2 quadratic cells
  recombine = {1, Name "recombine", Choices {0, 1}},          // 1 hexahedra, 0 wedges whose triangles lie in planes z = constant
  shape = {recombine ? 1 : 2, Name "shape", Choices {0, 1, 2, 3}},  // 0 tetrahedra, 1 hexahedra, 2 wedges as above, 3 wedges whose triangles face y
  serendipity = {0, Name "serendipity", Choices {0, 1}},      // 1: quadratic cells without nodes inside faces and cells (hex20)
  shared = {0, Name "shared", Choices {0, 1}},                // 1: both slabs own the interface nodes, 0: each has its own there
  nx = {36, Name "nx", Min 1, Max 100000, Step 1},            // cells along x
  nx_pad = {nx, Name "nx_pad", Min 1, Max 100000, Step 1},    // cells of the pad along x, where nodes are not shared
  ny_disc = {12, Name "ny_disc", Min 1, Max 100000, Step 1},  // cells across the disc layer
  ny_pad = {7, Name "ny_pad", Min 1, Max 100000, Step 1},     // cells across the pad layer
  nz = {1, Name "nz", Min 1, Max 100000, Step 1},             // cells along z
  nz_pad = {nz, Name "nz_pad", Min 1, Max 100000, Step 1},    // cells of the pad along z, where nodes are not shared
  Lx = {3, Name "Lx"},                                        // period
  h_disc = {1, Name "h_disc"},                                // thickness of the disc layer
  h_pad = {0.6, Name "h_pad"},                                // thickness of the pad layer
  depth = {Lx / nx, Name "depth"}                             // length along z
];
Include "grid.inc";

arc_centre = 0;
count_3 = 0;
cells = shape;
div_1[] = {nx};
div_2[] = {ny_disc, ny_pad};
div_3[] = {nz};
y[] = {-h_disc, 0, h_pad};
pad = shared ? 0 : 10000;
For body In {0 : shared ? 0 : 1}
  For k In {0 : 1}
    For j In {shared ? 0 : body : shared ? 2 : body + 1}
      For i In {0 : 1}
        Point(10000 * body + 1 + i + 10 * j + 100 * k) = {i * Lx, y[j], k * depth};
      EndFor
    EndFor
  EndFor
EndFor
i = 0; k = 0;
base = 0; j = 0;
Call GridBlock;
base = pad; j = 1;
If (!shared)
  div_1[] = {nx_pad};
  div_3[] = {nz_pad};
EndIf
Call GridBlock;

Physical Surface("disc_left") = {5001};
Physical Surface("disc_right") = {5002};
Physical Surface("disc_bottom") = {6001};
Physical Surface("disc_face") = {6011};
Physical Surface("disc_back") = {7001};
Physical Surface("disc_front") = {7101};
Physical Surface("pad_left") = {pad + 5011};
Physical Surface("pad_right") = {pad + 5012};
Physical Surface("pad_face") = {pad + 6011};
Physical Surface("pad_top") = {pad + 6021};
Physical Surface("pad_back") = {pad + 7011};
Physical Surface("pad_front") = {pad + 7111};
Physical Volume("disc") = {8001};
Physical Volume("pad") = {pad + 8011};

Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = serendipity;
