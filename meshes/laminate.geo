// SPDX-License-Identifier: BSD-2-Clause
// Box of two plies, the lower and the upper one, which share the nodes between them: one body of two sections. Lengths in m.
DefineConstant[
  order = {1, Name "order", Choices {1, 2}},                 // 1 linear, 2 quadratic cells
  recombine = {1, Name "recombine", Choices {0, 1}},         // 1 hexahedra, 0 tetrahedra, or wedges:
  wedge = {0, Name "wedge", Choices {0, 1}},                 // 1, with recombine = 0: wedges
  serendipity = {0, Name "serendipity", Choices {0, 1}},     // 1: quadratic cells without nodes inside faces and cells (hex20)
  Lx = {1, Name "Lx"},                                       // length
  Ly = {0.8, Name "Ly"},                                     // width
  h_lower = {0.3, Name "h_lower"},                           // thickness of the lower ply, from z = 0
  h_upper = {0.5, Name "h_upper"},                           // and of the upper one on it
  nx = {4, Name "nx", Min 1, Max 100000, Step 1},            // cells along the length
  ny = {3, Name "ny", Min 1, Max 100000, Step 1},            // cells across the width
  n_lower = {2, Name "n_lower", Min 1, Max 100000, Step 1},  // cells through the lower ply
  n_upper = {3, Name "n_upper", Min 1, Max 100000, Step 1},  // cells through the upper ply
  turn = {0, Name "turn", Min -360, Max 360}                 // angle about the axis (1, 2, 2) by which all is turned, degrees
];
Include "grid.inc";

base = 0;
arc_centre = 0;
count_3 = 0;
cells = recombine ? 1 : (wedge ? 2 : 0);
div_1[] = {nx};
div_2[] = {ny};
div_3[] = {n_lower, n_upper};
height[] = {0, h_lower, h_lower + h_upper};
c = Cos(turn * Pi / 180);
s = Sin(turn * Pi / 180);
For k In {0 : 2}
  For j In {0 : 1}
    For i In {0 : 1}
      // Rodrigues: x cos + (n × x) sin + n (n · x) (1 − cos), n = (1, 2, 2)/3
      x = i * Lx;
      y = j * Ly;
      z = height[k];
      along = (x + 2 * y + 2 * z) / 9 * (1 - c);
      Point(1 + i + 10 * j + 100 * k) = {c * x + s * (2 * z - 2 * y) / 3 + along,
                                         c * y + s * (2 * x - z) / 3 + 2 * along,
                                         c * z + s * (y - 2 * x) / 3 + 2 * along};
    EndFor
  EndFor
EndFor
i = 0; j = 0;
For k In {0 : 1}
  Call GridBlock;
EndFor

Physical Surface("left") = {5001, 5101};
Physical Surface("right") = {5002, 5102};
Physical Surface("front") = {6001, 6101};
Physical Surface("back") = {6011, 6111};
Physical Surface("bottom") = {7001};
Physical Surface("between") = {7101};
Physical Surface("top") = {7201};
Physical Volume("lower") = {8001};
Physical Volume("upper") = {8101};

Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = serendipity;
