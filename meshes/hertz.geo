// SPDX-License-Identifier: BSD-2-Clause
// A cylinder on a block, the half x > 0 of both and the lower half of the cylinder, or a sphere on a block, a quarter of both.
// They are `lift` apart at the origin, lest gmsh unites the points there; y points from the block to the round body. Cells are
// fine near the contact, and the meshes do not match there. Lengths in mm, so that MPa and N go with them.
DefineConstant[
  order = {1, Name "order", Choices {1, 2}},              // 1 linear, 2 quadratic cells
  recombine = {0, Name "recombine", Choices {0, 1}},      // 1: quadrangles where possible, hexahedra and wedges of a slab, hexahedra of a sphere; else tetrahedra
  serendipity = {0, Name "serendipity", Choices {0, 1}},  // 1: quadratic cells without nodes inside faces and cells
  body = {0, Name "body", Choices {0, 1, 2}},             // 0 cylinder in the plane, 1 cylinder as a slab, 2 sphere
  radius = {50, Name "radius"},                           // of cylinder or sphere
  size = {100, Name "size"},                              // height of the block and half its width
  reach = {12, Name "reach"},                             // width of the surfaces that may touch, from the middle
  lift = {0.001, Name "lift"},                            // least distance
  h = {1, Name "h"},                                      // size of the cells of the block near the contact
  ratio = {1.4, Name "ratio"},                            // size of those of the round body over it
  depth = {2, Name "depth"},                              // length of the slab along z
  layers = {2, Name "layers", Min 1, Max 1000, Step 1}    // cells of a slab's block along z; one less in the round body
];

// Round body: centre 1, lowest point 2, end of the contact 3, top 4. Block: 11 below it, 12 end of the contact.
Point(1) = {0, lift + radius, 0};
Point(2) = {0, lift, 0};
Point(3) = {reach, lift + radius - Sqrt(radius^2 - reach^2), 0};
Point(4) = {radius, lift + radius, 0};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Line(3) = {4, 1};
Line(4) = {1, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Point(11) = {0, 0, 0};
Point(12) = {reach, 0, 0};
Point(13) = {size, 0, 0};
Point(14) = {size, -size, 0};
Point(15) = {0, -size, 0};
Line(11) = {12, 11};
Line(12) = {13, 12};
Line(13) = {14, 13};
Line(14) = {15, 14};
Line(15) = {11, 15};
Curve Loop(2) = {11, 15, 14, 13, 12};
Plane Surface(2) = {2};

Transfinite Curve {1} = Ceil(reach / (ratio * h)) + 1;
Transfinite Curve {11} = Ceil(reach / h) + 1;
Field[1] = Distance;
Field[1].PointsList = {2, 11};
Field[2] = Threshold;
Field[2].InField = 1;
Field[2].SizeMin = h;
Field[2].SizeMax = 20 * h;
Field[2].DistMin = reach / 2;
Field[2].DistMax = size;
Background Field = 2;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
If (recombine && body < 2)
  Recombine Surface {1, 2};
  Mesh.RecombinationAlgorithm = 0;
EndIf
If (recombine && body == 2)
  Mesh.SubdivisionAlgorithm = 2;  // four hexahedra of each tetrahedron, with half its edges
EndIf

If (body == 0)
  Physical Curve("round_face") = {1};
  Physical Curve("pressed") = {3};
  Physical Curve("block_face") = {11};
  Physical Curve("bottom") = {14};
  Physical Curve("middle") = {4, 15};
  Physical Surface("round") = {1};
  Physical Surface("block") = {2};
EndIf
For b In {1 : body > 0 ? 2 : 0}
  n = (b == 1) ? (layers > 1 ? layers - 1 : 1) : layers;
  If (body == 1 && recombine)
    out[] = Extrude {0, 0, depth} { Surface{b}; Layers{n}; Recombine; };
  EndIf
  If (body == 1 && !recombine)
    out[] = Extrude {0, 0, depth} { Surface{b}; Layers{n}; };
  EndIf
  If (body == 2)
    out[] = Extrude { {0, 1, 0}, {0, 0, 0}, -Pi / 2 } { Surface{b}; };
  EndIf
  ends[] += {b, out[0]};
  volumes[] += {out[1]};
  // The sides follow in the order of the curves; those on the axis of a sphere have none.
  sides[] += out[{2 : #out[] - 1}];
EndFor
If (body > 0)
  // Round body: curves 1, 2, 3 and for a slab 4. Block: 11, for a slab 15, 14, 13, 12.
  first = (body == 1) ? 4 : 3;
  Physical Surface("round_face") = {sides[0]};
  Physical Surface("pressed") = {sides[2]};
  Physical Surface("block_face") = {sides[first]};
  Physical Surface("bottom") = {sides[first + (body == 1 ? 2 : 1)]};
  If (body == 1)
    Physical Surface("middle") = {sides[3], sides[first + 1]};
  Else
    Physical Surface("middle") = {ends[1], ends[3]};
    Physical Surface("front") = {ends[0], ends[2]};
  EndIf
  Physical Volume("round") = {volumes[0]};
  Physical Volume("block") = {volumes[1]};
EndIf

Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = serendipity;
