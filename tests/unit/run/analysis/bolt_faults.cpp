// SPDX-License-Identifier: BSD-2-Clause
// Mistakes in bolts: sections that do not cut their body, options that exclude each other, and
// shortenings too large for small strains.
#include <gtest/gtest.h>

#include "base/system/text.hpp"
#include "support/harness/messages.hpp"
#include "support/harness/scratch_folder.hpp"
#include "support/model/model.hpp"
#include "support/run/bolted_columns.hpp"

namespace squeal::test::bolted {
namespace {

TEST(Bolts, SectionMustCutThroughItsBody) {
  // A bar of 2 × 1 cells in two layers, with a section below one of the two cells above it.
  const std::string file = writeFile("notch.geo", R"(
Point(1) = {0, 0, 0}; Point(2) = {0, 1, 0}; Line(1) = {1, 2}; Transfinite Curve{1} = 2;
a[] = Extrude{1, 0, 0}{ Line{1}; Layers{1}; Recombine; };
b[] = Extrude{1, 0, 0}{ Line{a[0]}; Layers{1}; Recombine; };
c[] = Extrude{0, 0, 1}{ Surface{a[1]}; Layers{1}; Recombine; };
d[] = Extrude{0, 0, 1}{ Surface{b[1]}; Layers{1}; Recombine; };
e[] = Extrude{0, 0, 1}{ Surface{c[0]}; Layers{1}; Recombine; };
f[] = Extrude{0, 0, 1}{ Surface{d[0]}; Layers{1}; Recombine; };
Physical Volume("bolt") = {c[1], d[1], e[1], f[1]};
Physical Surface("low") = {a[1], b[1]};
Physical Surface("notch") = {c[0]};
Physical Surface("section") = {c[0], d[0]};
)");
  const auto message = [&](const std::string& section) {
    setOptions("-mesh_file " + file + material("bolt", "1e9", "0.3", "1000") +
               "-constraint_low_clamped xyz -bolt_b_force 1 -bolt_b_section " + section);
    return errorOf([] { tightenedModel(); });
  };
  EXPECT_NE(message("notch").find("option -bolt_b_section notch: the section does not cut through "
                                  "its body: cells on both sides of it share the node at"),
            std::string::npos)
      << message("notch");
  // Cut through, the upper half is loose: nothing holds the bolt against its force.
  EXPECT_NE(message("section").find("body 'bolt' can move rigidly"), std::string::npos)
      << message("section");
  EXPECT_NE(message("section").find("as the section of bolt 'b' opens, so the part of the body on "
                                    "one side of it is loose"),
            std::string::npos)
      << message("section");
}

// A bar of three cells, clamped at its ends: the part between two sections is loose.
TEST(Bolts, InSeriesAreNamed) {
  setOptions("-mesh_file " + writeFile("series.geo", R"(
Point(1) = {0, 0, 0}; Point(2) = {0, 1, 0}; Line(1) = {1, 2}; Transfinite Curve{1} = 2;
a[] = Extrude{1, 0, 0}{ Line{1}; Layers{1}; Recombine; };
b[] = Extrude{0, 0, 1}{ Surface{a[1]}; Layers{1}; Recombine; };
c[] = Extrude{0, 0, 1}{ Surface{b[0]}; Layers{1}; Recombine; };
d[] = Extrude{0, 0, 1}{ Surface{c[0]}; Layers{1}; Recombine; };
Physical Volume("bolt") = {b[1], c[1], d[1]};
Physical Surface("low") = {a[1]};
Physical Surface("high") = {d[0]};
Physical Surface("one") = {b[0]};
Physical Surface("two") = {c[0]};
)") + material("bolt", "1e9", "0.3", "1000") +
             "-constraint_low_clamped xyz -constraint_high_clamped xyz -bolt_b_section one "
             "-bolt_b_force 1 -bolt_c_section two -bolt_c_force 1");
  const std::string found = errorOf([] { tightenedModel(); });
  EXPECT_TRUE(contains(found, "body 'bolt' can move rigidly")) << found;
  EXPECT_TRUE(contains(found,
                       "as the sections of bolts 'b' and 'c' open, so the parts between "
                       "or beyond them are loose"))
      << found;
}

// The bolt is 1 m long: a tenth of it is the limit of small strains.
TEST(Bolts, LargeShorteningIsReported) {
  const auto warnings = [](const std::string& options) {
    setOptions(assembly("bolt_faults.geo") + options);
    return warningsOf([] { tightenedModel(); });
  };
  EXPECT_EQ(warnings("-bolt_b_shortening 0.099"), "");
  const std::string given = warnings("-bolt_b_shortening 0.2"),
                    found = warnings(formatted("-bolt_b_force %g", 0.3 * boltStiffness));
  EXPECT_TRUE(contains(given,
                       "bolt 'b' becomes 0.2 m shorter, 0.2 times the length of its "
                       "body 'bolt' along it, 1 m"))
      << given;
  EXPECT_TRUE(contains(given, "-bolt_b_shortening")) << given;
  // The bolt and the sleeve are springs: F (1/k_b + 1/k_s), k_s = 2 k_b, gives 0.45 m.
  EXPECT_TRUE(contains(found, "bolt 'b' becomes 0.45 m shorter")) << found;
  EXPECT_TRUE(contains(found, "-bolt_b_force")) << found;
}

TEST(Bolts, FaultsAreNamed) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"-bolt_b_shortening 1 -bolt_under_pressure on",
       "option -bolt_under_pressure needs -bolt_<name>_force"},
      {"", "option -bolt_b_section: give either -bolt_b_force or -bolt_b_shortening"},
      {"-bolt_b_force 1 -bolt_b_shortening 1",
       "option -bolt_b_section: give either -bolt_b_force or -bolt_b_shortening"},
      {"-bolt_b_force 1 -bolt_c_force 1", "option -bolt_c_force needs -bolt_c_section"},
      {"-bolt_b_force 1 -bolt_c_force 1 -bolt_c_section nothing",
       "option -bolt_c_section nothing names group 'nothing', which is not in the mesh"},
      {"-bolt_b_force 1 -bolt_c_force 1 -bolt_c_section bolt_low",
       "option -bolt_c_section bolt_low: a face of the section has 0 cells of a body below and 1 "
       "above"},
      {"-bolt_b_force 1 -bolt_c_force 1 -bolt_c_section bolt",
       "group 'bolt' has dimension 3; a boundary of dimension 2 is wanted"},
      {"-bolt_b_force 1 -bolt_b_axis 0,0,0", "option -bolt_b_axis: must not be zero"},
      {"-bolt_b_force 1 -bolt_b_axis 1,0,0.05",
       "option -bolt_b_axis: the axis lies across the normal of the section, (0, 0, 1)"},
      {"-bolt_b_force 1 -bolt_c_force 1 -bolt_c_section section",
       "option -bolt_c_section section: the bolt 'b' has this section already"},
  };
  for (const auto& [options, message] : faults) {
    const std::string found = errorOf([&, &text = options] {
      setOptions(assembly("bolt_faults.geo") + text);
      tightenedModel();
    });
    EXPECT_NE(found.find(message), std::string::npos) << options << "\n  " << found;
  }
}

// The nodes of a section are doubled: for other options its group would mean its lower side.
TEST(Bolts, OnlyTheBoltUsesItsSection) {
  const std::string rule = "(-bolt_b_section section), whose nodes are doubled";
  for (const std::string option :
       {"-constraint_section_clamped z", "-load_section_pressure 1", "-load_section_force 0,0,1",
        "-ground_section_stiffness 0,0,1", "-mass_section_total 1",
        "-contact_c_pad section -contact_c_disc sleeve_low",
        "-tie_t_slave sleeve_high -tie_t_master section"}) {
    const std::string found = errorOf([&] {
      setOptions(assembly("bolt_faults.geo") + "-bolt_b_force 1 " + option);
      tightenedModel();
    });
    EXPECT_TRUE(contains(found, "group 'section' is the section of the bolt 'b' " + rule))
        << option << ": " << found;
    EXPECT_TRUE(contains(found, "option " + option.substr(0, option.find('_')))) << found;
  }
  // The same faces under another name.
  std::string again = geometry;
  again.insert(again.find("Physical Volume"), "Physical Surface(\"copy\") = {middle};\n");
  const auto message = [&](const std::string& options) {
    return errorOf([&] {
      setOptions("-mesh_file " + writeFile("copy.geo", again) + optionsOf("") + "-bolt_b_force 1 " +
                 options);
      tightenedModel();
    });
  };
  EXPECT_TRUE(contains(message("-constraint_copy_clamped z"),
                       "option -constraint_copy_clamped: group 'copy' has a face of the "
                       "section of the bolt 'b' " +
                           rule));
  // A position means both sides.
  EXPECT_EQ(message("-reference_r_centre_of copy -coupling_c_reference high -coupling_c_nodes r"),
            "");
}

}  // namespace
}  // namespace squeal::test::bolted
