// SPDX-License-Identifier: BSD-2-Clause
// The findings of the audit: on rotations and on cells, none on sound cases, and their page.
#include <gtest/gtest.h>

#include <cmath>

#include "run/audit/audit.hpp"
#include "support/run/audited_blocks.hpp"

namespace squeal {
namespace {

using test::missingIn;

TEST(Clean, CasesHaveNoFinding) {
  for (const char* name : {"layer", "two_layers", "two_layers_antiplane"}) {
    test::setCase(name);
    EXPECT_EQ(test::linesOf(test::auditInForce()), "") << name;
  }
  test::setCase("two_layers", "-mesh_set shared=1");
  EXPECT_EQ(test::linesOf(test::auditInForce()), "");
}

TEST(Rotation, AxisFarFromTheBody) {
  const auto options = test::twoBlocks("audit_axis.msh", 0) + test::blockContact +
                       " -motion_disc_speed 5 -motion_disc_axis 0,0,1 ";
  EXPECT_EQ(missingIn(test::audited(options + "-motion_disc_origin 0.05,0.05,0"), 0, {}), "");
  EXPECT_EQ(
      missingIn(test::audited(options + "-motion_disc_origin 50,0.05,0"), 1,
                {"axis of rotation (warning)", "body 'disc', (0.05, 0.05, -0.025)", "49.95 m away",
                 "through (50, 0.05, 0) along (0, 0, 1)", "-motion_disc_origin"}),
      "");
  EXPECT_EQ(missingIn(test::audited(options + "-motion_disc_origin 0.06,0.05,0"), 1,
                      {"axis of rotation (note)", "0.01 m away"}),
            "");
}

// Ring and hat of the disc turn at 10 rpm about the z axis. Their moments of inertia about it are
// the sum of ρ π h (R⁴ − r⁴) / 2 over three hollow cylinders; facets make them smaller by 1 %.
TEST(Rotation, OfABodyThatACouplingHolds) {
  const double pi = std::acos(-1.0), speed = 10 * 2 * pi / 60;
  const auto cylinder = [&](double inner, double outer, double height) {
    return 7200 * pi * height * (std::pow(outer, 4) - std::pow(inner, 4)) / 2;
  };
  const double axial =
      cylinder(0.08, 0.144, 0.015) + cylinder(0.07, 0.08, 0.045) + cylinder(0.034, 0.07, 0.01);
  const auto stiffness = [&](const std::string& options) {
    test::setCase("disc_brake_rotating",
                  "-mesh_set n_pad_theta=4,n_free_theta=8,n_pad_r=2,n_mount=1 "
                  "-reference_hub_centre_of mounting -coupling_hub_reference hub "
                  "-coupling_hub_nodes mounting -bushing_hub_from hub "
                  "-bushing_hub_stiffness 1e8,1e8,1e8,1e5,1e5,1e5 " +
                      options);
    removeOption("constraint_mounting_clamped");
    const std::string lines = test::linesOf(test::auditInForce()), words = "like a spring of ";
    const auto at = lines.find(words);
    return at == std::string::npos ? 0 : std::stod(lines.substr(at + words.size()));
  };
  const double expected = -speed * speed * axial / 2;
  EXPECT_NEAR(stiffness(""), expected, 0.03 * std::abs(expected));
  EXPECT_EQ(stiffness("-motion_convective off"), 0);
  EXPECT_EQ(stiffness("-elasticity_prestress on -coupling_hub_kind distributed"), 0);
}

TEST(Cells, SmallJacobian) {
  const auto text = test::changed(test::quadranglesMsh2(), "\n6 2 1 0\n", "\n6 1.4 0.4 0\n");
  const auto found =
      test::audited("-mesh_file " + test::writeFile("audit_folded.msh", text) +
                    test::material("layer", "1", "0.3", "1") + "-constraint_bottom_clamped xy");
  // det J is linear from 1 at the first corner to −0.2 at the last one: at the Gauss points
  // 0.4 ∓ 0.6/√3.
  EXPECT_NEAR(found.cells.at(0).jacobian.value,
              (0.4 - 0.6 / std::sqrt(3)) / (0.4 + 0.6 / std::sqrt(3)), 1e-12);
  EXPECT_EQ(missingIn(found, 1,
                      {"distorted cells (note)", "in 1 cell of body 'layer'",
                       "at worst to 0.072 in cell 6 (quad4) at (1.35, 0.35, 0)"}),
            "");
}

TEST(Cells, LongCells) {
  const auto found =
      test::audited(test::oneBlock("audit_long.msh", {0.5, 0.5, 0.001}, "2e11", "7800"));
  // ‖J‖ ‖J⁻¹‖/3 of a box with the sides a, a, b and k = a/b: √((2 k² + 1)(2 k⁻² + 1))/3.
  const double k = 500;
  EXPECT_NEAR(found.cells.at(0).aspect.value, std::sqrt((2 * k * k + 1) * (2 / (k * k) + 1)) / 3,
              1e-6);
  EXPECT_EQ(missingIn(found, 1,
                      {"distorted cells (note)", "8 flat or long cells of body 'box'", "in cell"}),
            "");
}

TEST(Locking, LinearCellsOfAnIncompressibleBody) {
  const auto options = test::oneBlock("audit_lock.msh", {0.1, 0.05, 0.01}, "2e9", "1200", "0.4999");
  EXPECT_EQ(missingIn(test::audited(options), 0, {}), "");  // hex8 has incompatible modes
  EXPECT_EQ(missingIn(test::audited(options + "-elasticity_incompatible_modes none"), 1,
                      {"locking (warning)", "body 'box'", "8 linear cells"}),
            "");
}

TEST(Markdown, ListsFindingsMassesAndSupports) {
  const auto found = test::audited(test::twoBlocks("audit_markdown.msh", 0));
  const std::string text = audit::markdown(found);
  for (const char* piece :
       {"# Audit of the model\n", "1. **Warning, faces without an interface**: body '",
        "*Remedy:* if the parts touch there", "| disc | 4 | 0.0005 | (0.05, 0.05, -0.025) |",
        "| total | 8 | 0.001 | (0.05, 0.05, 0) |", "| disc | support 'disc_low': 9 | supported |"})
    EXPECT_NE(text.find(piece), std::string::npos) << piece << "\n" << text;
  EXPECT_EQ(audit::summaryOf(found), "1 warning");
}

}  // namespace
}  // namespace squeal
