// SPDX-License-Identifier: BSD-2-Clause
// Disc brake with a floating caliper: ventilated disc with hat, two pads (friction lining and steel back plate), piston, caliper, two
// guide pins and bracket. Every part is meshed for itself: where two touch, their faces lie on one another with a gap of zero but
// are different surfaces with cells of different size, so that no two meshes match. Booleans only join shapes of one part.
// The disc turns about +z; the pads' middle is on the x axis, where the disc moves along +y. -z is inboard: piston, hub and
// vehicle are there, the hat and the caliper's finger are outboard. Lengths in m, angles in degrees. Sources: README.md.
SetFactory("OpenCASCADE");
DefineConstant[
  order = {2, Name "order", Choices {1, 2}},                              // 1 linear, 2 quadratic tetrahedra
  size = {1, Name "size", Min 0.3, Max 2.5},                              // factor on the edge lengths of all parts
  quarter = {3, Name "quarter", Min 2, Max 20, Step 1},                   // edges along a quarter of pins and holes
  vanes = {30, Name "vanes", Min 3, Max 60, Step 1},                      // between the two friction rings of the disc
  bolts = {5, Name "bolts", Min 0, Max 6, Step 1},                        // holes of wheel bolts in the hat
  bolted = {0, Name "bolted", Choices {0, 1}},                            // 1: guide pins with a collar, a neck and a thread
  h_disc = {0.024, Name "h_disc", Min 0.018, Max 0.030},                  // thickness of the disc
  h_cheek = {0.008, Name "h_cheek", Min 0.005, Max 0.0085},               // of each of its friction rings
  h_lining = {0.010, Name "h_lining", Min 0.003, Max 0.012},              // of a lining
  h_plate = {0.006, Name "h_plate", Min 0.004, Max 0.008},                // of a back plate
  pad_angle = {48, Name "pad_angle", Min 30, Max 48},                     // sector of a lining
  chamfer_length = {0.010, Name "chamfer_length", Min 0.002, Max 0.015},  // of both ends of a lining, along the disc
  chamfer_depth = {0.004, Name "chamfer_depth", Min 0.001, Max 0.008},    // and away from it
  r_piston = {0.027, Name "r_piston", Min 0.022, Max 0.0275}              // piston and bore
];
If (chamfer_depth > 0.7 * h_lining)
  Error("chamfer_depth = %g: must be at most 0.7 h_lining = %g", chamfer_depth, 0.7 * h_lining);
EndIf
If (h_disc - 2 * h_cheek < 0.004)
  Error("h_disc = %g: must leave at least 0.004 for the vanes between two rings of h_cheek = %g", h_disc, h_cheek);
EndIf

// Edge lengths. Parts that touch have different ones.
size_disc = Min(0.0210 * size, 0.027);
size_lining = 0.0058 * size;
size_plate = 0.0075 * size;
size_piston = 0.0086 * size;
size_caliper = 0.0145 * size;
size_pin = 0.0050 * size;
size_bracket = 0.0140 * size;

// Distances from the middle plane of the disc, on both sides.
z_face = h_disc / 2;            // lining on disc
z_lining = z_face + h_lining;   // back plate on lining
z_plate = z_lining + h_plate;   // piston or finger on back plate
// The disc. The outboard friction ring goes on inwards to the hat's wall.
r_disc = 0.140;
r_ring = 0.085;                 // inner radius of the friction rings
r_hat = 0.076;                  // hat's wall, outside
r_hat_in = 0.068;               // and inside
r_bore = 0.0325;                // centring on the hub
r_bolts = 0.056;
z_hat = z_face + 0.032;         // outer face of the hat's plate
h_hat = 0.008;
// The pads. Ears at both ends of the back plate slide between the abutments of the bracket, on its rails.
r_lining_in = 0.092;
r_lining_out = 0.138;
margin_in = 0.006;              // by which the back plate juts out over the lining, inwards, so that it bears the whole rim of the
margin_out = 0.004;             // piston, and outwards
plate_angle = 50;               // the same for shorter linings: it bears the whole finger
x_ear = 0.112;                  // lower side of the ears, on the rails
x_ear_top = 0.128;
y_ear = 0.070;                  // ends of the ears, on the abutments
c_ear = 0.002;                  // chamfer between these sides, which would share nodes without it
y_tip = 0.061;                  // from here to y_ear the ears lie on the rails
// Piston, caliper, pins. A bolted pin has a collar on the bracket, a neck with the section of the bolt, and a thread.
x_piston = 0.114;
x_pin = 0.110;
y_pin = 0.086;
r_pin = 0.006;
r_collar = 0.010;
r_neck = 0.0045;
// The towers of the bracket on both sides of the disc, which hold abutments and rails; the pins go through the inboard ones.
z_tower = z_face + 0.004;
h_tower = z_plate + 0.006 - z_tower;
z_thread = -z_tower - h_tower / 2;  // from here on a bolted pin is screwed into the bracket

// In: volumes body[], box corners x0 … z1. Out: picked[], the surfaces on the boundary of the body that lie in the box, grown by e.
// Places of surfaces are known, numbers of surfaces after booleans are not; only those of one body are asked for, since the
// surfaces of its neighbour lie at the same places. Faces between the volumes of one body are not on its boundary.
e = 2e-4;
Macro Pick
  skin[] = Abs(CombinedBoundary{ Volume{body[]}; });
  found[] = Surface In BoundingBox{x0 - e, y0 - e, z0 - e, x1 + e, y1 + e, z1 + e};
  picked[] = {};
  For i_skin In {0 : #skin[] - 1}
    For i_found In {0 : #found[] - 1}
      If (skin[i_skin] == found[i_found])
        picked[] += {skin[i_skin]};
      EndIf
    EndFor
  EndFor
  If (#picked[] == 0)
    Error("a surface of the brake is not where it should be: these dimensions do not go together");
  EndIf
Return

// In: z_low, height, r_low, r_high, angle. Out: sector, a volume with its middle on the x axis.
Macro Sector
  sector = newv;
  Cylinder(sector) = {0, 0, z_low, 0, 0, height, r_high, angle * Pi / 180};
  Rotate{{0, 0, 1}, {0, 0, 0}, -angle / 2 * Pi / 180}{ Volume{sector}; }
  hole = newv;
  Cylinder(hole) = {0, 0, z_low - height, 0, 0, 3 * height, r_low};
  cut[] = BooleanDifference{ Volume{sector}; Delete; }{ Volume{hole}; Delete; };
  sector = cut[0];
Return

// In: points p, p + 1, p + 2, extrusion dx, dy, dz. Out: cutter, a volume.
Macro Cutter
  l = newl;
  Line(l) = {p, p + 1};
  Line(l + 1) = {p + 1, p + 2};
  Line(l + 2) = {p + 2, p};
  loop = newll;
  Curve Loop(loop) = {l, l + 1, l + 2};
  base = news;
  Plane Surface(base) = {loop};
  grown[] = Extrude{dx, dy, dz}{ Surface{base}; };
  cutter = grown[1];
Return

// In: x, y, radius, turn (of its seams about its axis, degrees), z_low, height. Out: rod, a cylinder whose wall is four surfaces.
Macro Rod
  p = newp;
  Point(p) = {x, y, z_low};
  For i_rod In {0 : 3}
    a_rod = turn * Pi / 180 + i_rod * Pi / 2;
    Point(p + 1 + i_rod) = {x + radius * Cos(a_rod), y + radius * Sin(a_rod), z_low};
  EndFor
  c = newl;
  For i_rod In {0 : 3}
    Circle(c + i_rod) = {p + 1 + i_rod, p, i_rod < 3 ? p + 2 + i_rod : p + 1};
  EndFor
  Delete{ Point{p}; }
  loop = newll;
  Curve Loop(loop) = {c : c + 3};
  base = news;
  Plane Surface(base) = {loop};
  grown[] = Extrude{0, 0, height}{ Surface{base}; };
  rod = grown[1];
Return

// In: picked[], the walls of a rod or of its hole, their box, edges along each quarter of a circle, n_arc, and along the axis,
// n_axis. Makes their triangles halves of a grid of rectangles: their normals, like those of the true cylinder, have no component
// along the axis, so that what slides there without friction slides freely.
Macro Grid
  arcs_low[] = Curve In BoundingBox{x0 - e, y0 - e, z0 - e, x1 + e, y1 + e, z0 + e};
  arcs_high[] = Curve In BoundingBox{x0 - e, y0 - e, z1 - e, x1 + e, y1 + e, z1 + e};
  For i_wall In {0 : #picked[] - 1}
    edges[] = Abs(Boundary{ Surface{picked[i_wall]}; });
    For i_edge In {0 : #edges[] - 1}
      n = n_axis;
      For i_found In {0 : #arcs_low[] - 1}
        n = (edges[i_edge] == arcs_low[i_found]) ? n_arc : n;
      EndFor
      For i_found In {0 : #arcs_high[] - 1}
        n = (edges[i_edge] == arcs_high[i_found]) ? n_arc : n;
      EndFor
      Transfinite Curve{edges[i_edge]} = n + 1;
    EndFor
    Transfinite Surface{picked[i_wall]};
  EndFor
Return

// Disc: two rings, vanes between them, neck and hat.
tools[] = {};
ring_in = newv; Cylinder(ring_in) = {0, 0, -z_face, 0, 0, h_cheek, r_disc};
hole = newv; Cylinder(hole) = {0, 0, -z_face - h_cheek, 0, 0, 3 * h_cheek, r_ring};
ring[] = BooleanDifference{ Volume{ring_in}; Delete; }{ Volume{hole}; Delete; };
cheek = newv; Cylinder(cheek) = {0, 0, z_face - h_cheek, 0, 0, h_cheek, r_disc};
hat = newv; Cylinder(hat) = {0, 0, z_face - h_cheek, 0, 0, z_hat - z_face + h_cheek, r_hat};
solid[] = BooleanUnion{ Volume{cheek}; Delete; }{ Volume{hat}; Delete; };
hole = newv; Cylinder(hole) = {0, 0, 0, 0, 0, z_hat - h_hat, r_hat_in};
tools[] += {hole};
hole = newv; Cylinder(hole) = {0, 0, 0, 0, 0, 2 * z_hat, r_bore};
tools[] += {hole};
outboard[] = BooleanDifference{ Volume{solid[]}; Delete; }{ Volume{tools[]}; Delete; };
tools[] = {outboard[]};
For i In {1 : vanes}
  vane = newv; Box(vane) = {r_ring + 0.006, -0.003, h_cheek - z_face, r_disc - r_ring - 0.012, 0.006, h_disc - 2 * h_cheek};
  Rotate{{0, 0, 1}, {0, 0, 0}, 2 * Pi * (i - 0.5) / vanes}{ Volume{vane}; }
  tools[] += {vane};
EndFor
disc[] = BooleanUnion{ Volume{ring[]}; Delete; }{ Volume{tools[]}; Delete; };
radius = 0.007; turn = 0; z_low = z_hat - 2 * h_hat; height = 3 * h_hat;
For i In {1 : bolts}
  a = 2 * Pi * i / bolts;
  x = r_bolts * Cos(a); y = r_bolts * Sin(a);
  Call Rod;
  disc[] = BooleanDifference{ Volume{disc[]}; Delete; }{ Volume{rod}; Delete; };
EndFor
MeshSize{ PointsOf{ Volume{disc[]}; } } = size_disc;
body[] = disc[];
For i In {1 : bolts}
  a = 2 * Pi * i / bolts;
  x0 = r_bolts * Cos(a) - 0.007; x1 = x0 + 0.014; y0 = r_bolts * Sin(a) - 0.007; y1 = y0 + 0.014;
  z0 = z_hat - h_hat; z1 = z_hat;
  Call Pick;
  n_arc = quarter; n_axis = quarter - 1;
  Call Grid;
EndFor
x0 = -r_disc; y0 = -r_disc; x1 = r_disc; y1 = r_disc;
z0 = -z_face; z1 = -z_face;
Call Pick;
Physical Surface("disc_ring_inner") = picked[];
z0 = z_face; z1 = z_face;
Call Pick;
Physical Surface("disc_ring_outer") = picked[];
x0 = -r_hat_in; y0 = -r_hat_in; x1 = r_hat_in; y1 = r_hat_in;
z0 = z_hat - h_hat; z1 = z_hat - h_hat;
Call Pick;
Physical Surface("hub_seat") = picked[];
Physical Volume("disc") = disc[];

// Pads: the inner one, with the piston, at z < 0, the outer one at z > 0.
For side In {0 : 1}
  s = side ? 1 : -1;
  pad = StrChoice(side, "outer", "inner");
  // The lining, with both ends chamfered by wedges whose hypotenuse goes through the edges of the chamfer.
  z_low = side ? z_face : -z_lining;
  height = h_lining; r_low = r_lining_in; r_high = r_lining_out; angle = pad_angle;
  Call Sector;
  tools[] = {};
  For end In {-1 : 1 : 2}
    a = end * pad_angle / 2 * Pi / 180;
    p = newp;
    For corner In {0 : 2}
      t = (corner == 0) ? 2 * chamfer_length : -chamfer_length;         // from the end of the lining towards its middle
      d = (corner == 1) ? 2 * chamfer_depth : -chamfer_depth;           // from the disc on
      Point(p + corner) = {r_lining_in / 2 * Cos(a) + end * t * Sin(a), r_lining_in / 2 * Sin(a) - end * t * Cos(a), s * (z_face + d)};
    EndFor
    dx = r_lining_out * Cos(a); dy = r_lining_out * Sin(a); dz = 0;
    Call Cutter;
    tools[] += {cutter};
  EndFor
  lining[] = BooleanDifference{ Volume{sector}; Delete; }{ Volume{tools[]}; Delete; };
  MeshSize{ PointsOf{ Volume{lining[]}; } } = size_lining;
  body[] = lining[];
  x0 = 0; y0 = -0.2; x1 = 0.2; y1 = 0.2;
  z0 = s * z_face; z1 = z0;
  Call Pick;
  Physical Surface(StrCat("lining_", pad, "_face")) = picked[];
  z0 = s * z_lining; z1 = z0;
  Call Pick;
  Physical Surface(StrCat("lining_", pad, "_back")) = picked[];
  Physical Volume(StrCat("lining_", pad)) = lining[];

  // The back plate. The tips of its ears are volumes of their own within it, so that the part of an ear's lower side that lies on
  // the rail is a surface of its own.
  z_low = side ? z_lining : -z_plate;
  height = h_plate; r_low = r_lining_in - margin_in; r_high = r_lining_out + margin_out; angle = plate_angle;
  Call Sector;
  tools[] = {};
  tips[] = {};
  For end In {-1 : 1 : 2}
    ear = newv; Box(ear) = {x_ear, end < 0 ? -y_tip : 0.03, z_low, x_ear_top - x_ear, y_tip - 0.03, h_plate};
    tools[] += {ear};
    tip = newv; Box(tip) = {x_ear, end < 0 ? -y_ear : y_tip, z_low, x_ear_top - x_ear, y_ear - y_tip, h_plate};
    p = newp;
    Point(p) = {x_ear - c_ear, end * (y_ear - 2 * c_ear), z_low - h_plate};
    Point(p + 1) = {x_ear + 2 * c_ear, end * (y_ear + c_ear), z_low - h_plate};
    Point(p + 2) = {x_ear - c_ear, end * (y_ear + c_ear), z_low - h_plate};
    dx = 0; dy = 0; dz = 3 * h_plate;
    Call Cutter;
    tips[] += BooleanDifference{ Volume{tip}; Delete; }{ Volume{cutter}; Delete; };
  EndFor
  middle[] = BooleanUnion{ Volume{sector}; Delete; }{ Volume{tools[]}; Delete; };
  plate[] = BooleanFragments{ Volume{middle[]}; Delete; }{ Volume{tips[]}; Delete; };
  MeshSize{ PointsOf{ Volume{plate[]}; } } = size_plate;
  body[] = plate[];
  x0 = 0; y0 = -y_tip; x1 = 0.2; y1 = y_tip;  // without the tips
  z0 = s * z_lining; z1 = z0;
  Call Pick;
  Physical Surface(StrCat("plate_", pad, "_front")) = picked[];
  z0 = s * z_plate; z1 = z0;
  Call Pick;
  Physical Surface(StrCat("plate_", pad, "_back")) = picked[];
  z0 = z_low; z1 = z_low + h_plate;
  y0 = -y_ear; y1 = y0;
  Call Pick;
  Physical Surface(StrCat("plate_", pad, "_leading")) = picked[];
  y0 = y_ear; y1 = y0;
  Call Pick;
  Physical Surface(StrCat("plate_", pad, "_trailing")) = picked[];
  x0 = x_ear; x1 = x0;
  y0 = -y_ear; y1 = -y_tip;
  Call Pick;
  Physical Surface(StrCat("plate_", pad, "_rail_leading")) = picked[];
  y0 = y_tip; y1 = y_ear;
  Call Pick;
  Physical Surface(StrCat("plate_", pad, "_rail_trailing")) = picked[];
  Physical Volume(StrCat("back_plate_", pad)) = plate[];
EndFor

// Piston: a cup, open towards the pad. Its rim, which stands out of the bore, is a volume of its own within it.
z_rim = -z_plate - 0.008;
z_bottom = -z_plate - 0.040;
x = x_piston; y = 0; turn = 0;
z_low = z_rim; height = -z_plate - z_rim;
radius = r_piston;
Call Rod;
rim = rod;
z_low = z_bottom; height = z_rim - z_bottom;
Call Rod;
cup = rod;
hole = newv; Cylinder(hole) = {x_piston, 0, z_bottom + 0.010, 0, 0, 0.05, r_piston - 0.007};
both[] = BooleanFragments{ Volume{rim}; Delete; }{ Volume{cup}; Delete; };
piston[] = BooleanDifference{ Volume{both[]}; Delete; }{ Volume{hole}; Delete; };
MeshSize{ PointsOf{ Volume{piston[]}; } } = size_piston;
body[] = piston[];
x0 = x_piston - r_piston; x1 = x_piston + r_piston; y0 = -r_piston; y1 = r_piston;
z0 = -z_plate; z1 = z0;
Call Pick;
Physical Surface("piston_rim") = picked[];
z0 = z_bottom; z1 = z0;
Call Pick;
Physical Surface("piston_bottom") = picked[];
bottom[] = picked[];
z1 = z_rim;
Call Pick;
guide[] = picked[];
guide[] -= bottom[];
// The box holds the cavity too, which has a box of its own.
x0 = x_piston - r_piston + 0.007; x1 = x_piston + r_piston - 0.007; y0 = 0.007 - r_piston; y1 = r_piston - 0.007;
Call Pick;
guide[] -= picked[];
picked[] = guide[];
x0 = x_piston - r_piston; x1 = x_piston + r_piston; y0 = -r_piston; y1 = r_piston;
n_arc = Max(4, Ceil(Pi / 2 * r_piston / size_piston)); n_axis = Ceil((z1 - z0) / size_piston);
Call Grid;
Physical Surface("piston_guide") = picked[];
Physical Volume("piston") = piston[];

// Caliper: cylinder, bridge over the rim of the disc, finger with a cut-out through which the bore is machined, ears for the pins.
z_front = -z_plate - 0.006;     // of the cylinder
z_end = -z_plate - 0.044;       // of the bore
z_back = -z_plate - 0.054;
z_ear = -z_plate - 0.038;
h_ear = 0.022;
x_bridge = 0.144;
x_top = 0.160;
caliper = newv; Cylinder(caliper) = {x_piston, 0, z_back, 0, 0, z_front - z_back, r_piston + 0.009};
tools[] = {};
part = newv; Box(part) = {x_piston, -0.030, z_back, x_top - x_piston, 0.060, z_front - z_back};
tools[] += {part};
part = newv; Box(part) = {x_bridge, -0.040, z_back, x_top - x_bridge, 0.080, z_plate + 0.016 - z_back};
tools[] += {part};
part = newv; Box(part) = {0.134, -0.036, z_plate + 0.004, x_bridge - 0.134, 0.072, 0.012};
tools[] += {part};
part = newv; Box(part) = {0.094, -0.036, z_plate, 0.040, 0.072, 0.016};
tools[] += {part};
part = newv; Box(part) = {x_pin - 0.012, -y_pin - 0.012, z_ear, 0.024, 2 * y_pin + 0.024, h_ear};
tools[] += {part};
whole[] = BooleanUnion{ Volume{caliper}; Delete; }{ Volume{tools[]}; Delete; };
tools[] = {};
x = x_piston; y = 0; radius = r_piston; turn = 20; z_low = z_end; height = -z_plate - z_end;
Call Rod;
tools[] += {rod};
part = newv; Cylinder(part) = {x_piston, 0, z_plate - 0.01, 0, 0, 0.04, 0.015};
tools[] += {part};
part = newv; Box(part) = {x_piston - 0.03, -0.015, z_plate - 0.01, 0.03, 0.030, 0.04};
tools[] += {part};
part = newv; Box(part) = {x_bridge - 0.01, -0.018, -z_face, 0.04, 0.036, 2 * z_face};
tools[] += {part};
For end In {-1 : 1 : 2}
  x = x_pin; y = end * y_pin; radius = r_pin; turn = 0; z_low = z_ear - 0.01; height = h_ear + 0.02;
  Call Rod;
  tools[] += {rod};
EndFor
caliper[] = BooleanDifference{ Volume{whole[]}; Delete; }{ Volume{tools[]}; Delete; };
MeshSize{ PointsOf{ Volume{caliper[]}; } } = size_caliper;
body[] = caliper[];
x0 = x_piston - r_piston; x1 = x_piston + r_piston; y0 = -r_piston; y1 = r_piston;
z0 = z_end; z1 = z0;
Call Pick;
Physical Surface("bore_bottom") = picked[];
bottom[] = picked[];
z1 = z_front;
Call Pick;
picked[] -= bottom[];
n_arc = Max(3, Ceil(Pi / 2 * r_piston / size_caliper)); n_axis = Ceil((z1 - z0) / size_caliper);
Call Grid;
Physical Surface("bore_wall") = picked[];
x0 = 0.094; x1 = 0.134; y0 = -0.036; y1 = 0.036; z0 = z_plate; z1 = z0;
Call Pick;
Physical Surface("finger_face") = picked[];
x0 = x_pin - r_pin; x1 = x_pin + r_pin; z0 = z_ear; z1 = z_ear + h_ear;
y0 = -y_pin - r_pin; y1 = -y_pin + r_pin;
Call Pick;
n_arc = quarter; n_axis = quarter + 1;
Call Grid;
Physical Surface("caliper_hole_leading") = picked[];
y0 = y_pin - r_pin; y1 = y_pin + r_pin;
Call Pick;
n_arc = quarter; n_axis = quarter + 1;
Call Grid;
Physical Surface("caliper_hole_trailing") = picked[];
Physical Volume("caliper") = caliper[];

// Guide pins: the shank sits in the bracket, the guide in the caliper; each is a volume of its own within the pin. The shank of a
// bolted pin is its thread. The collar lies on the bracket, around the hole.
z_step = -z_plate - 0.008;
For end In {-1 : 1 : 2}
  pin = StrChoice(end < 0, "leading", "trailing");
  x = x_pin; y = end * y_pin; radius = r_pin; turn = 45 / quarter;
  z_shank = bolted ? z_thread : z_step;
  z_low = z_shank; height = -z_face - 0.003 - z_shank;
  Call Rod;
  shank = rod;
  z_low = z_end; height = z_step - z_end;
  Call Rod;
  guide[] = {rod};
  If (bolted)
    z_low = z_step; height = -z_tower - h_tower - z_step;
    Call Rod;
    guide[] += {rod};
    radius = r_collar;
    Call Rod;
    guide[] += {rod};
    radius = r_neck; z_low = -z_tower - h_tower; height = h_tower / 4;
    Call Rod;
    guide[] += {rod};
    z_low = z_thread - height;
    Call Rod;
    guide[] += {rod};
    radius = r_pin;
  EndIf
  body[] = BooleanFragments{ Volume{shank}; Delete; }{ Volume{guide[]}; Delete; };
  MeshSize{ PointsOf{ Volume{body[]}; } } = size_pin;
  x0 = x_pin - r_pin; x1 = x_pin + r_pin; y0 = end * y_pin - r_pin; y1 = end * y_pin + r_pin;
  // The flat ends, which these boxes hold too, are left out.
  z0 = -z_face - 0.003; z1 = z0;
  Call Pick;
  bottom[] = picked[];
  If (bolted)
    z0 = z_thread; z1 = z0;
    Call Pick;
    bottom[] += picked[];
    z1 = -z_face - 0.003;
  EndIf
  z0 = z_shank;
  Call Pick;
  picked[] -= bottom[];
  n_arc = quarter; n_axis = bolted ? quarter : quarter + 2;
  Call Grid;
  Physical Surface(StrCat("pin_", pin, "_shank")) = picked[];
  z0 = z_end; z1 = z0;
  Call Pick;
  bottom[] = picked[];
  z1 = z_step;
  Call Pick;
  picked[] -= bottom[];
  n_axis = 2 * quarter + 1;
  Call Grid;
  Physical Surface(StrCat("pin_", pin, "_guide")) = picked[];
  If (bolted)
    // The ring of the collar, without the neck, whose root has a box of its own.
    z0 = -z_tower - h_tower; z1 = z0;
    x0 = x_pin - r_pin; x1 = x_pin + r_pin; y0 = end * y_pin - r_pin; y1 = end * y_pin + r_pin;
    Call Pick;
    bottom[] = picked[];
    x0 = x_pin - r_collar; x1 = x_pin + r_collar; y0 = end * y_pin - r_collar; y1 = end * y_pin + r_collar;
    Call Pick;
    picked[] -= bottom[];
    Physical Surface(StrCat("pin_", pin, "_collar")) = picked[];
    z0 = z_thread - h_tower / 4; z1 = z0;
    x0 = x_pin - r_neck; x1 = x_pin + r_neck; y0 = end * y_pin - r_neck; y1 = end * y_pin + r_neck;
    picked[] = Surface In BoundingBox{x0 - e, y0 - e, z0 - e, x1 + e, y1 + e, z1 + e};
    If (#picked[] != 1)
      Error("the neck of a guide pin has no section: these dimensions do not go together");
    EndIf
    Physical Surface(StrCat("pin_", pin, "_section")) = picked[];
  EndIf
  Physical Volume(StrCat("pin_", pin)) = body[];
EndFor

// Bracket: a bar inboard with the bolts to the knuckle; at either end a tower, an arm over the rim of the disc and a tower outboard;
// on each tower an abutment for the end of an ear and a rail below it.
y_tower = y_ear + 0.004;
y_end = 0.098;
x_foot = 0.052;
x_arm = 0.130;
x_arm_top = 0.146;
bracket = newv; Box(bracket) = {x_foot, -y_end, -z_tower - h_tower, 0.022, 2 * y_end, h_tower};
tools[] = {};
For end In {-1 : 1 : 2}
  y_low = (end < 0) ? -y_end : y_tower;
  part = newv; Box(part) = {x_foot, y_low, -z_tower - h_tower, x_arm_top - x_foot, y_end - y_tower, h_tower};
  tools[] += {part};
  part = newv; Box(part) = {x_arm, y_low, -z_tower - h_tower, x_arm_top - x_arm, y_end - y_tower, 2 * (z_tower + h_tower)};
  tools[] += {part};
  part = newv; Box(part) = {x_ear - 0.014, y_low, z_tower, x_arm_top - x_ear + 0.014, y_end - y_tower, h_tower};
  tools[] += {part};
  For side In {0 : 1}
    z_low = side ? z_tower : -z_tower - h_tower;
    y_low = (end < 0) ? -y_tower - 0.004 : y_ear;
    part = newv; Box(part) = {x_ear - 0.014, y_low, z_low, x_ear_top + 0.002 - x_ear + 0.014, y_tower + 0.004 - y_ear, h_tower};
    tools[] += {part};
    y_low = (end < 0) ? -y_ear - 0.004 : y_tip - 0.0015;
    part = newv; Box(part) = {x_ear - 0.014, y_low, z_low, 0.014, y_ear + 0.004 - y_tip + 0.0015, h_tower};
    tools[] += {part};
  EndFor
EndFor
whole[] = BooleanUnion{ Volume{bracket}; Delete; }{ Volume{tools[]}; Delete; };
tools[] = {};
For end In {-1 : 1 : 2}
  y = end * y_pin; x = x_pin; radius = r_pin; turn = 0; z_low = -z_tower - 2 * h_tower; height = 2 * h_tower + z_tower;
  If (bolted)
    z_low = z_thread; height = -z_thread;
    Call Rod;
    tools[] += {rod};
    z_low = -z_tower - 2 * h_tower; height = z_thread - z_low;
  EndIf
  Call Rod;
  tools[] += {rod};
  z_low = -z_tower - 2 * h_tower; height = 2 * h_tower + z_tower;
  y = end * 0.060; x = x_foot + 0.011;
  Call Rod;
  tools[] += {rod};
EndFor
bracket[] = BooleanDifference{ Volume{whole[]}; Delete; }{ Volume{tools[]}; Delete; };
MeshSize{ PointsOf{ Volume{bracket[]}; } } = size_bracket;
body[] = bracket[];
mounting[] = {};
For end In {-1 : 1 : 2}
  pin = StrChoice(end < 0, "leading", "trailing");
  z0 = -z_tower - h_tower; z1 = -z_tower;
  x0 = x_pin - r_pin; x1 = x_pin + r_pin; y0 = end * y_pin - r_pin; y1 = end * y_pin + r_pin;
  n_arc = quarter; n_axis = quarter + 1;
  If (bolted)
    n_axis = quarter - 1;
    z1 = z_thread;
    Call Pick;
    Call Grid;
    z0 = z_thread; z1 = -z_tower;
  EndIf
  Call Pick;
  Call Grid;
  z0 = -z_tower - h_tower;
  Physical Surface(StrCat("bracket_hole_", pin)) = picked[];
  x0 = x_foot + 0.005; x1 = x_foot + 0.017; y0 = end * 0.060 - 0.006; y1 = end * 0.060 + 0.006;
  Call Pick;
  n_axis = quarter;
  Call Grid;
  mounting[] += picked[];
  For side In {0 : 1}
    pad = StrChoice(side, "outer", "inner");
    z0 = side ? z_tower : -z_tower - h_tower;
    z1 = z0 + h_tower;
    x0 = x_ear; x1 = x_ear_top + 0.002; y0 = end * y_ear; y1 = y0;
    Call Pick;
    Physical Surface(StrCat("bracket_", pad, "_", pin)) = picked[];
    x1 = x_ear; y0 = (end < 0) ? -y_ear : y_tip - 0.0015; y1 = (end < 0) ? -y_tip + 0.0015 : y_ear;
    Call Pick;
    Physical Surface(StrCat("bracket_", pad, "_rail_", pin)) = picked[];
  EndFor
EndFor
Physical Surface("bracket_bolts") = mounting[];
If (bolted)
  x0 = x_foot; x1 = x_arm_top; y0 = -y_end; y1 = y_end; z0 = -z_tower - h_tower; z1 = z0;
  Call Pick;
  Physical Surface("bracket_seat") = picked[];
EndIf
Physical Volume("bracket") = bracket[];

Mesh.MinimumCirclePoints = 12;
Mesh.ElementOrder = order;
