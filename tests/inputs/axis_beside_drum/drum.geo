// SPDX-License-Identifier: BSD-2-Clause
// A round shoe in a drum about (x0, y0), with matching nodes on the circle between them.
SetFactory("OpenCASCADE");
DefineConstant[order = {2, Name "order"}, cells = {24, Name "cells"}];
x0 = 0.3; y0 = -0.2; a = 0.08; b = 0.1; c = 0.12;
Disk(1) = {x0, y0, 0, b}; Disk(2) = {x0, y0, 0, a};
BooleanDifference(3) = {Surface{1}; Delete;}{Surface{2}; Delete;};
Disk(4) = {x0, y0, 0, c}; Disk(5) = {x0, y0, 0, b};
BooleanDifference(6) = {Surface{4}; Delete;}{Surface{5}; Delete;};
shoe() = Boundary{Surface{3};}; drum() = Boundary{Surface{6};};
For k In {0:1}
  box() = BoundingBox Curve{shoe(k)};
  If(box(3) - box(0) > 2 * b - 1e-3) face = shoe(k); Else bore = shoe(k); EndIf
  box() = BoundingBox Curve{drum(k)};
  If(box(3) - box(0) > 2 * c - 1e-3) rim = drum(k); Else inner = drum(k); EndIf
EndFor
Transfinite Curve{bore, face, inner, rim} = cells + 1;
Mesh.MeshSizeMax = 0.02; Mesh.ElementOrder = order;
Physical Surface("shoe") = {3}; Physical Surface("drum") = {6};
Physical Curve("bore") = {bore}; Physical Curve("shoe_face") = {face};
Physical Curve("drum_face") = {inner}; Physical Curve("rim") = {rim};
