// SPDX-License-Identifier: BSD-2-Clause
// Disc between two pads, unstructured tetrahedra as a mesher makes them of CAD parts. Disc and pads share the nodes of the contact
// surfaces; the program gives each its own. Axis z, angles from the x axis; lengths in m.
SetFactory("OpenCASCADE");
DefineConstant[
  order = {2, Min 1, Max 2, Step 1, Name "order"},           // 1 linear, 2 quadratic tetrahedra
  size = {0.022, Min 0.002, Max 0.05, Name "size"},          // edge length of the tetrahedra
  r_in = {0.06, Min 0.01, Max 0.08, Name "r_in"},            // disc, held at its bore
  r_out = {0.15, Min 0.146, Max 0.5, Name "r_out"},
  h_disc = {0.02, Min 0.002, Max 0.1, Name "h_disc"},
  r_pad_in = {0.085, Min 0.081, Max 0.12, Name "r_pad_in"},  // pads: sectors of a ring, from angle 0 on
  r_pad_out = {0.145, Min 0.125, Max 0.1455, Name "r_pad_out"},
  pad_angle = {60, Min 10, Max 170, Name "pad_angle"},       // degrees
  h_pad = {0.015, Min 0.001, Max 0.1, Name "h_pad"}
];
Cylinder(1) = {0, 0, 0, 0, 0, h_disc, r_out};
Cylinder(2) = {0, 0, -h_disc, 0, 0, 3 * h_disc, r_in};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
For side In {0 : 1}
  z = side ? -h_pad : h_disc;
  Cylinder(4 + 3 * side) = {0, 0, z, 0, 0, h_pad, r_pad_out, pad_angle * Pi / 180};
  Cylinder(5 + 3 * side) = {0, 0, z - h_pad, 0, 0, 3 * h_pad, r_pad_in};
  BooleanDifference(6 + 3 * side) = { Volume{4 + 3 * side}; Delete; }{ Volume{5 + 3 * side}; Delete; };
EndFor
BooleanFragments{ Volume{3}; Delete; }{ Volume{6, 9}; Delete; }

e = 1e-4;  // of the boxes that find surfaces by their place
upper_pad[] = Boundary{ Volume{6}; };
lower_pad[] = Boundary{ Volume{9}; };
disc[] = Boundary{ Volume{3}; };
upper_back() = Surface In BoundingBox{-r_out, -r_out, h_disc + h_pad - e, r_out, r_out, h_disc + h_pad + e};
lower_back() = Surface In BoundingBox{-r_out, -r_out, -h_pad - e, r_out, r_out, -h_pad + e};
bore() = Surface In BoundingBox{-r_in - e, -r_in - e, -e, r_in + e, r_in + e, h_disc + e};
upper_face[] = {};
lower_face[] = {};
For i In {0 : #disc[] - 1}
  For j In {0 : #upper_pad[] - 1}
    If (disc[i] == upper_pad[j])
      upper_face[] += {disc[i]};
    EndIf
  EndFor
  For j In {0 : #lower_pad[] - 1}
    If (disc[i] == lower_pad[j])
      lower_face[] += {disc[i]};
    EndIf
  EndFor
EndFor
Physical Volume("disc") = {3};
Physical Volume("upper") = {6};
Physical Volume("lower") = {9};
Physical Surface("bore") = bore();
Physical Surface("upper_back") = upper_back();
Physical Surface("lower_back") = lower_back();
Physical Surface("upper_face") = upper_face[];
Physical Surface("lower_face") = lower_face[];

Mesh.CharacteristicLengthMin = size;
Mesh.CharacteristicLengthMax = size;
Mesh.ElementOrder = order;
