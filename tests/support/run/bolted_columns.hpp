// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A bolt and a sleeve between two rigid plates.
#include <string>

#include "base/system/text.hpp"
#include "run/analysis/tightening.hpp"
#include "support/harness/scratch_folder.hpp"
#include "support/model/model.hpp"

namespace squeal::test::bolted {

/// Bars of length 1 along z with Poisson's ratio 0, so that they are springs: the bolt with the
/// area 1, cut by `section` at its middle, and the sleeve with the area 2, of two halves that touch
/// there.
inline const char* const column = R"(
Geometry.AutoCoherence = 0;  // the halves of the sleeve touch, they are not joined
Macro Column  // x0, w, z0, h -> s (bottom), top, volume
  p = newp;
  Point(p) = {x0, 0, z0}; Point(p+1) = {x0+w, 0, z0};
  Point(p+2) = {x0+w, 1, z0}; Point(p+3) = {x0, 1, z0};
  l = newl;
  Line(l) = {p, p+1}; Line(l+1) = {p+1, p+2}; Line(l+2) = {p+2, p+3}; Line(l+3) = {p+3, p};
  Transfinite Curve{l:l+3} = 3;
  k = newll; Curve Loop(k) = {l:l+3};
  s = news; Plane Surface(s) = {k}; Transfinite Surface{s}; Recombine Surface{s};
  e[] = Extrude{0, 0, h}{ Surface{s}; Layers{2}; Recombine; };
  top = e[0]; volume = e[1];
Return
)";

/// @ begins the names of the assembly.
inline const char* const columns = R"(
x0 = X; w = 1; z0 = 0; h = 0.5; Call Column;
bottom = s; middle = top; lower = volume;
e[] = Extrude{0, 0, 0.5}{ Surface{middle}; Layers{2}; Recombine; };
Physical Surface("@bolt_low") = {bottom};
Physical Surface("@bolt_high") = {e[0]};
Physical Surface("@section") = {middle};
Physical Volume("@bolt") = {lower, e[1]};
x0 = X + 3; w = 2; z0 = 0; h = 0.5; Call Column;
Physical Surface("@sleeve_low") = {s};
Physical Surface("@joint_low") = {top};
Physical Volume("@sleeve_a") = {volume};
z0 = 0.5; Call Column;
Physical Surface("@joint_high") = {s};
Physical Surface("@sleeve_high") = {top};
Physical Volume("@sleeve_b") = {volume};
)";

constexpr double boltStiffness = 2e9, sleeveStiffness = 4e9;  // N/m

/// Returns the text with a beginning of all names in place of @.
inline std::string named(std::string text, const std::string& beginning) {
  for (std::size_t at = 0; (at = text.find('@', at)) != std::string::npos; at += beginning.size())
    text.replace(at, 1, beginning);
  return text;
}

/// Returns the geometry of an assembly at X, with this beginning of names.
inline std::string geometryAt(int x, const std::string& beginning) {
  return formatted("X = %d;", x) + named(columns, beginning);
}

inline const std::string geometry = column + geometryAt(0, "");

/// Returns the options of an assembly. The plates are reference nodes: `low` is held, `high` moves
/// along z.
inline std::string optionsOf(const std::string& beginning) {
  std::string options;
  for (const std::string body : {"bolt", "sleeve_a", "sleeve_b"})
    options += material(beginning + body, "2e9", "0", "1000");
  return options + named(
                       "-reference_@low_position 1,0.5,0 -coupling_@low_reference @low "
                       "-coupling_@low_nodes @bolt_low,@sleeve_low -constraint_@low_clamped xyz "
                       "-constraint_@low_clamped_rotation xyz "
                       "-reference_@high_position 1,0.5,1 -coupling_@high_reference @high "
                       "-coupling_@high_nodes @bolt_high,@sleeve_high "
                       "-constraint_@high_clamped xy -constraint_@high_clamped_rotation xyz "
                       "-contact_@joint_pad @joint_high -contact_@joint_disc @joint_low "
                       "-contact_@joint_role frictionless -bolt_@b_section @section ",
                       beginning);
}

/// Collective. Returns the options of one assembly with its mesh, which it writes to a file.
inline std::string assembly(const std::string& file = "bolt.geo") {
  return "-mesh_file " + writeFile(file, geometry) + optionsOf("");
}

/// Collective. Returns the model of the options in force with tightened bolts.
inline analysis::Model tightenedModel() {
  const auto settings = analysis::ModelSettings::given();
  auto model = analysis::buildModel(PETSC_COMM_WORLD, settings);
  analysis::requireSupports(model);
  analysis::tightenBolts(model, settings.constraints);
  return model;
}

}  // namespace squeal::test::bolted
