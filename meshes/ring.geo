// SPDX-License-Identifier: BSD-2-Clause
// Free circular ring of rectangular section about the z axis, for comparison with the theory of thin rings. Lengths in m.
DefineConstant[
  order = {1, Name "order", Choices {1, 2}},                          // 1 linear, 2 quadratic cells
  serendipity = {0, Name "serendipity", Choices {0, 1}},              // 1: quadratic cells without nodes inside faces and cells (hex20)
  R = {0.1, Name "R"},                                                // radius of the middle line
  thickness = {0.002, Name "thickness"},                              // radial
  width = {0.003, Name "width"},                                      // axial
  n_theta = {96 / order, Name "n_theta", Min 4, Max 100000, Step 4},  // cells around, a multiple of 4
  n_r = {1, Name "n_r", Min 1, Max 100000, Step 1},                   // cells through the thickness
  n_z = {1, Name "n_z", Min 1, Max 100000, Step 1}                    // cells across the width
];
If (n_theta != 4 * Floor(n_theta / 4))
  Error("n_theta = %g: must be a multiple of 4", n_theta);
EndIf
Include "grid.inc";

base = 0;
arc_centre = 9001;
count_3 = 4;
cells = 1;
div_1[] = {n_r};
div_2[] = {n_z};
div_3[] = {n_theta / 4, n_theta / 4, n_theta / 4, n_theta / 4};
inner[] = {};
outer[] = {};
bottom[] = {};
top[] = {};
ring[] = {};
For j In {0 : 1}
  Point(arc_centre + j) = {0, 0, (j - 0.5) * width};
EndFor
// Radius, axis and angle are a right-handed system when the angle runs clockwise.
For k In {0 : 3}
  For j In {0 : 1}
    For i In {0 : 1}
      r = R + (i - 0.5) * thickness;
      Point(1 + i + 10 * j + 100 * k) = {r * Cos(Pi / 2 * k), -r * Sin(Pi / 2 * k), (j - 0.5) * width};
    EndFor
  EndFor
EndFor
i = 0; j = 0;
For k In {0 : 3}
  Call GridBlock;
  inner[] += {5001 + 100 * k};
  outer[] += {5002 + 100 * k};
  bottom[] += {6001 + 100 * k};
  top[] += {6011 + 100 * k};
  ring[] += {8001 + 100 * k};
EndFor

Physical Surface("inner") = inner[];
Physical Surface("outer") = outer[];
Physical Surface("bottom") = bottom[];
Physical Surface("top") = top[];
Physical Volume("ring") = ring[];

Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = serendipity;
