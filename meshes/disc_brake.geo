// SPDX-License-Identifier: BSD-2-Clause
// Disc brake: friction ring and hat of the disc about the z axis, one pad (friction lining and steel back plate) on the upper face
// of the ring, its middle on the x axis. The disc turns about +z, so the matter under the pad moves along +y. Disc and lining share
// the nodes of the contact surface; the program gives each its own. With `apart` the disc has a mesh of its own there.
// Lengths in m, angles in degrees. Sources: README.md.
DefineConstant[
  order = {1, Name "order", Choices {1, 2}},              // 1 linear; 2 quadratic cells, half as many along each edge
  serendipity = {0, Name "serendipity", Choices {0, 1}},  // 1: quadratic cells without nodes inside faces and cells (hex20)
  // The disc: a ring with a hat below it, whose bottom plate is bolted to the hub.
  r_bore = {0.034, Name "r_bore"},    // hole of the hat's plate
  r_mount = {0.055, Name "r_mount"},  // outer radius of the mounting face
  r_hat = {0.070, Name "r_hat"},      // inside of the hat's wall
  r_ring = {0.080, Name "r_ring"},    // outside of the hat's wall
  r_out = {0.144, Name "r_out"},      // rim
  h_ring = {0.015, Name "h_ring"},    // thickness of the friction ring
  h_plate = {0.010, Name "h_plate"},  // thickness of the hat's plate
  hat = {0.030, Name "hat"},          // from the lower face of the ring down to the mounting face
  // The pad: its rubbing face is a sector of a ring; from there its four sides slope outwards, chamfered as linings are, to the
  // larger back plate. Without the slope the trailing corners of the lining lift off as soon as there is friction.
  r_pad_in = {0.090, Name "r_pad_in"},
  r_pad_out = {0.140, Name "r_pad_out"},
  pad_angle = {45, Name "pad_angle"},
  slope = {0.005, Name "slope"},  // by which the back plate juts out over the rubbing face, all round
  h_lining = {0.006, Name "h_lining"},
  h_back = {0.005, Name "h_back"},
  // The disc has nodes of its own under the lining, where its mesh need not match.
  apart = {0, Name "apart", Choices {0, 1}},
  disc_turn = {0, Name "disc_turn", Min 0, Max 5},  // angle by which the sectors of the disc are turned against the pad, if apart
  // Cells.
  n_pad_theta = {Ceil(24 / order), Name "n_pad_theta", Min 1, Max 100000, Step 1},    // along the pad
  n_disc_theta = {n_pad_theta, Name "n_disc_theta", Min 1, Max 100000, Step 1},       // along the disc under the pad, if apart
  n_disc_r = {Ceil(10 / order), Name "n_disc_r", Min 1, Max 100000, Step 1},          // across it there, if apart
  n_free_theta = {Ceil(41 / order), Name "n_free_theta", Min 1, Max 100000, Step 1},  // along each third of the disc's rest
  n_mount = {Ceil(3 / order), Name "n_mount", Min 1, Max 100000, Step 1},             // radially: bore to r_mount
  n_plate = {Ceil(3 / order), Name "n_plate", Min 1, Max 100000, Step 1},             // r_mount to r_hat
  n_wall = {Ceil(2 / order), Name "n_wall", Min 1, Max 100000, Step 1},               // through the hat's wall
  n_inside = {Ceil(2 / order), Name "n_inside", Min 1, Max 100000, Step 1},           // r_ring to r_pad_in
  n_pad_r = {Ceil(10 / order), Name "n_pad_r", Min 1, Max 100000, Step 1},            // across the pad
  n_outside = {1, Name "n_outside", Min 1, Max 100000, Step 1},                       // r_pad_out to r_out
  n_h_plate = {Ceil(2 / order), Name "n_h_plate", Min 1, Max 100000, Step 1},         // axially: hat's plate
  n_hat = {Ceil(4 / order), Name "n_hat", Min 1, Max 100000, Step 1},                 // hat's wall
  n_h_ring = {Ceil(4 / order), Name "n_h_ring", Min 1, Max 100000, Step 1},           // friction ring
  n_h_lining = {Ceil(2 / order), Name "n_h_lining", Min 1, Max 100000, Step 1},       // lining
  n_h_back = {1, Name "n_h_back", Min 1, Max 100000, Step 1}                          // each half of the back plate
];
Include "grid.inc";

r[] = {r_bore, r_mount, r_hat, r_ring, r_pad_in, r_pad_out, r_out};
z[] = {-hat, h_plate - hat, 0, h_ring, h_ring + h_lining, h_ring + h_lining + h_back / 2, h_ring + h_lining + h_back};
base = 0;
arc_centre = 9001;
count_3 = 4;
cells = 1;
pad = apart ? 10000 : 0;
div_1[] = {n_mount, n_plate, n_wall, n_inside, apart ? n_disc_r : n_pad_r, n_outside};
div_2[] = {n_h_plate, n_hat, n_h_ring, n_h_lining, n_h_back, n_h_back};
div_3[] = {apart ? n_disc_theta : n_pad_theta, n_free_theta, n_free_theta, n_free_theta};

// Radius, axis and angle are a right-handed system when the angle runs clockwise: sector 0 is the pad's, from its trailing end
// at +pad_angle / 2 to its leading end.
For j In {0 : 6}
  Point(arc_centre + j) = {0, 0, z[j]};
  jut = (j > 3) ? slope : 0;
  half = pad_angle / 2 + jut / (0.5 * (r_pad_in + r_pad_out)) * 180 / Pi;
  angle[] = {half, -half, -half - (360 - pad_angle) / 3, half + (360 - pad_angle) / 3};
  For k In {0 : 3}
    For i In {0 : 6}
      // The pad is only on sector 0, and the hat's plate ends at its wall.
      If ((j < 2 && i < 4) || ((j == 2 || j == 3) && i > 1) || (j > 3 && k < 2 && (i == 4 || i == 5)))
        radius = r[i] + (i == 4 ? -jut : (i == 5 ? jut : 0));
        turned = (angle[k] + (apart && j < 4 ? disc_turn : 0)) * Pi / 180;
        Point((j > 3 ? pad : 0) + 1 + i + 10 * j + 100 * k) = {radius * Cos(turned), radius * Sin(turned), z[j]};
        If (apart && j == 3 && k < 2 && (i == 4 || i == 5))
          Point(pad + 1 + i + 10 * j + 100 * k) = {radius * Cos(angle[k] * Pi / 180), radius * Sin(angle[k] * Pi / 180), z[j]};
        EndIf
      EndIf
    EndFor
  EndFor
EndFor

ring[] = {};
hat_volumes[] = {};
mounting[] = {};
For k In {0 : 3}
  j = 0;
  For i In {0 : 2}
    Call GridBlock;
    hat_volumes[] += {8000 + grid_0};
  EndFor
  mounting[] += {6001 + 100 * k};
  i = 2; j = 1;
  Call GridBlock;
  hat_volumes[] += {8000 + grid_0};
  j = 2;
  For i In {2 : 5}
    Call GridBlock;
    ring[] += {8000 + grid_0};
  EndFor
EndFor
base = pad;
div_1[4] = n_pad_r;
div_3[0] = n_pad_theta;
i = 4; k = 0;
For j In {3 : 5}
  Call GridBlock;
EndFor
// A turned sector is not that under the pad: the whole upper face of the ring may touch it.
disc_face[] = {6035};
If (apart)
  For k In {0 : 3}
    For i In {3 : 5}
      disc_face[] += {6031 + i + 100 * k};
    EndFor
  EndFor
  disc_face[] = Unique(disc_face[]);
EndIf

Physical Surface("mounting") = mounting[];
Physical Surface("disc_face") = disc_face[];
Physical Surface("lining_face") = {pad + 6035};
Physical Surface("pressed") = {pad + 6065};
// The ends of the back plate lie flat on the abutments; its inner side touches along its middle line and can tilt about it.
Physical Surface("guide_trailing") = {pad + 7045, pad + 7055};
Physical Surface("guide_leading") = {pad + 7145, pad + 7155};
Physical Curve("guide_radial") = {pad + 3055};
Physical Volume("disc") = ring[];
Physical Volume("hat") = hat_volumes[];
Physical Volume("lining") = {pad + 8035};
Physical Volume("back_plate") = {pad + 8045, pad + 8055};

Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = serendipity;
