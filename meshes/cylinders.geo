// SPDX-License-Identifier: BSD-2-Clause
// Two concentric cylinders in contact on the circle r = b, in plane strain: pressure on the bore presses the inner one against the
// outer one (Lamé's solution). Matching meshes, each cylinder with its own interface nodes, or one connected body. Lengths in m.
// The whole circle is meshed: at the ends of a quarter the normals of a faceted circle would lean out of the symmetry planes.
DefineConstant[
  order = {1, Name "order", Choices {1, 2}},                         // 1 linear, 2 quadratic cells
  recombine = {1, Name "recombine", Choices {0, 1}},                 // 1 quadrangles, 0 triangles
  serendipity = {0, Name "serendipity", Choices {0, 1}},             // 1: quadratic cells without the node in the middle (quad8)
  shared = {0, Name "shared", Choices {0, 1}},                       // 1: both cylinders have the same interface nodes
  a = {0.05, Name "a"},                                              // radius of the bore
  b = {0.08, Name "b"},                                              // radius of the interface
  c = {0.12, Name "c"},                                              // radius of the rim
  n_inner = {6 / order, Name "n_inner", Min 1, Max 100000, Step 1},  // cells through the inner cylinder
  n_outer = {8 / order, Name "n_outer", Min 1, Max 100000, Step 1},  // cells through the outer cylinder
  n_theta = {64 / order, Name "n_theta", Min 4, Max 100000, Step 4}  // cells along the circle, a multiple of 4
];
If (n_theta != 4 * Floor(n_theta / 4))
  Error("n_theta = %g: must be a multiple of 4", n_theta);
EndIf

Point(1) = {0, 0, 0};
radii[] = {a, b, b, c};
radial[] = {n_inner, n_outer};
// Body 0, 1; quarter q from the axis q on. Tags of body 0: points 10 + q inside, 20 + q outside; curves 10 + q radial, 20 + q inner
// arc, 30 + q outer arc; surfaces 10 + q. Body 1: 100 more; if nodes are shared, it has the points 20 + q and arcs 30 + q inside.
For body In {0 : 1}
  p = 100 * body;
  joined = shared * body;
  inside = joined ? 20 : p + 10;
  arc = joined ? 30 : p + 20;
  For q In {0 : 3}
    For side In {joined : 1}
      r = radii[2 * body + side];
      Point(p + 10 + 10 * side + q) = {(q == 0 ? r : (q == 2 ? -r : 0)), (q == 1 ? r : (q == 3 ? -r : 0)), 0};
    EndFor
  EndFor
  For q In {0 : 3}
    next = (q == 3) ? 0 : q + 1;
    Line(p + 10 + q) = {inside + q, p + 20 + q};
    If (!joined)
      Circle(arc + q) = {inside + q, 1, inside + next};
    EndIf
    Circle(p + 30 + q) = {p + 20 + q, 1, p + 20 + next};
    Transfinite Curve {p + 10 + q} = radial[body] + 1;
    Transfinite Curve {arc + q, p + 30 + q} = n_theta / 4 + 1;
  EndFor
  For q In {0 : 3}
    next = (q == 3) ? 0 : q + 1;
    Curve Loop(p + 10 + q) = {p + 10 + q, p + 30 + q, -(p + 10 + next), -(arc + q)};
    Plane Surface(p + 10 + q) = {p + 10 + q};
    Transfinite Surface {p + 10 + q};
    If (recombine)
      Recombine Surface {p + 10 + q};
    EndIf
  EndFor
EndFor

Physical Curve("inner_bore") = {20 : 23};
Physical Curve("inner_face") = {30 : 33};
If (shared)
  Physical Curve("outer_face") = {30 : 33};
Else
  Physical Curve("outer_face") = {120 : 123};
EndIf
Physical Curve("outer_rim") = {130 : 133};
Physical Curve("sym_x") = {11, 13, 111, 113};  // lines inside the bodies on the plane x = 0: clamp x
Physical Curve("sym_y") = {10, 12, 110, 112};  // and on the plane y = 0: clamp y
Physical Surface("inner") = {10 : 13};
Physical Surface("outer") = {110 : 113};

Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = serendipity;
