// SPDX-License-Identifier: BSD-2-Clause
// Two rings that are meshed apart and tied on a circle, one inside the other: rigid motions are
// free of strain, and frequencies converge to those of one body.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "eigen/modes/modes.hpp"
#include "exact/annulus.hpp"
#include "model/contact/coupled.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/model/blocks_apart.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace squeal::test {
namespace {

constexpr int tri3 = 2, quad4 = 3, tri6 = 9, quad9 = 10, quad8 = 16;
const exact::annulus::Annulus annulus{1, 0.3, 1, 1, 2};
constexpr double cut = 1.5, height = 0.1;

bool isPlane(int cell) {
  return std::find(planeCells.begin(), planeCells.end(), cell) != planeCells.end();
}

/// The cells around of both rings and the cells across each of them.
struct Cells {
  int inner, outer, across;
};

/// Returns the options of an annulus that is cut at r = 3/2; the outer ring is turned by a part of
/// a cell. `turned` turns both.
std::string rings(int cell, const Cells& cells, double turned = 0) {
  const auto ring = [&](double from, double turn) {
    return [=, plane = isPlane(cell)](const mesh::Point& x) {
      // Around, along the axis and outwards is a right-handed system; in the plane, clockwise and
      // outwards is one.
      const double angle = (plane ? -2 : 2) * std::numbers::pi * x[0] + turn, radius = from + x[2];
      const double a = radius * std::cos(angle), b = radius * std::sin(angle);
      return plane ? mesh::Point{a, 0, b} : mesh::Point{a, b, x[1]};
    };
  };
  BlockWriter writer;
  const auto add = [&](const std::string& name, int around, double from, double to, double turn) {
    writer.add(name, {cell,
                      {around, 1, cells.across},
                      {0, 0, 0},
                      {1, height, to - from},
                      0,
                      0,
                      ring(from, turn)});
  };
  add("disc", cells.inner, annulus.inner, cut, turned);
  add("pad", cells.outer, cut, annulus.outer, turned + 1.1 / cells.outer);
  return "-mesh_file " + writeFile("rings.msh", writer.text()) + material("disc", "1", "0.3", "1") +
         material("pad", "1", "0.3", "1") + " -elasticity_mass consistent ";
}
const std::string outerOnInner = "-tie_ring_slave pad_low -tie_ring_master disc_high ",
                  innerOnOuter = "-tie_ring_slave disc_high -tie_ring_master pad_low ",
                  unadjusted = "-tie_ring_adjust off ";

/// How far a rigid motion is from one that the tie allows, and its energy.
struct Rigid {
  double difference;  ///< of the displacements, relative to the largest one
  double energy;      ///< uᵀ K u / (|K| |u|²)
};

/// Collective.
Rigid turned(const std::string& options) {
  setOptions(options);
  const Model model = buildModel();
  const auto& mesh = *model.mesh;
  const contact::Transformation t = model.contact.transformation({});
  const double out = mesh.dimension == 2 ? 0 : 1;
  const OwnedVec rigid = nodalField(mesh, [&](const mesh::Point& x) {
    return mesh::Point{0.3 - 0.7 * x[1] + out * 0.2 * x[2], 0.1 + 0.7 * x[0] - out * 0.5 * x[2],
                       out * (-0.4 - 0.2 * x[0] + 0.5 * x[1])};
  });
  OwnedVec x, u = elasticity::nodalVector(mesh), inSprings = elasticity::nodalVector(mesh);
  check(MatCreateVecs(t.trial, x.out(), nullptr));
  check(MatMultTranspose(t.selection, rigid, x));  // all but the slaves
  check(MatMult(t.trial, x, u));
  PetscReal size = 0, difference = 0, norm = 0;
  check(VecNorm(rigid, NORM_INFINITY, &size));
  check(MatNorm(model.bodies.stiffness, NORM_INFINITY, &norm));
  check(MatMult(model.bodies.springs, u, inSprings));
  const double energy = form(u, model.bodies.stiffness, u) - dot(u, inSprings), square = dot(u, u);
  check(VecAXPY(u, -1, rigid));
  check(VecNorm(u, NORM_INFINITY, &difference));
  return {difference / size, std::abs(energy) / (norm * square)};
}

// The bodies rest on springs: a body that nothing holds is an error.
TEST(CurvedTies, RigidMotionsAreFree) {
  for (const int cell : {tri3, quad4, tri6, quad8, quad9, wedge6, hex8, wedge15, hex20, hex27})
    for (const std::string* tie : {&outerOnInner, &innerOnOuter}) {
      const std::string options =
          rings(cell, {11, 14, 1}, 0.3) + "-ground_disc_low_stiffness 1,1,1 " + *tie;
      const Rigid adjusted = turned(options);
      print("cell %d: difference %.1e, energy %.1e\n", cell, adjusted.difference, adjusted.energy);
      EXPECT_LT(adjusted.difference, 1e-12);  // rounding
      EXPECT_LT(adjusted.energy, 1e-15);
      if (tie == &innerOnOuter) continue;
      const Rigid asMeshed = turned(options + unadjusted);
      print("not adjusted: %.1e, %.1e\n", asMeshed.difference, asMeshed.energy);
      EXPECT_GT(asMeshed.difference, 1e-6);  // the meshes do not lie on each other
    }
}

/// The lowest frequencies of the annulus, held at the bore; waves around it come twice.
std::vector<Complex> exactFrequencies(std::size_t count) {
  std::vector<double> all;
  for (int order = 0; order < 10; ++order)
    for (const double omega : exact::annulus::turningFrequencies(annulus, order, 0))
      if (omega > 0) all.insert(all.end(), order == 0 ? 1 : 2, omega);
  std::sort(all.begin(), all.end());
  std::vector<Complex> found;
  for (std::size_t i = 0; i < count; ++i) found.emplace_back(0, all.at(i));
  return found;
}

double error(int cell, const Cells& cells, const std::string& tie) {
  // Solids are one cell high and periodic along the axis: plane strain. They also vibrate along the
  // axis, which the comparison leaves out.
  const std::string solid =
      "-constraint_disc_low_clamped xyz -constraint_disc_y1_image_of disc_y0 "
      "-constraint_pad_y1_image_of pad_y0 -modes_count 32 ";
  setOptions(rings(cell, cells) + tie +
             (isPlane(cell) ? "-constraint_disc_low_clamped xy -modes_count 16 " : solid));
  const Model model = buildModel();
  const contact::CoupledSystem system(model.bodies, model.contact, {});
  const auto found =
      errors(exactFrequencies(10), eigenvaluesOf(modes::compute(system, modes::Settings::given())))
          .relative;
  print("cell %d, %d:%d around: errors up to %.1e; moved %.1e\n", cell, cells.inner, cells.outer,
        worst(found), model.contact.interfaces.reports.at(0).largestAdjustment);
  return rootMeanSquare(found);
}

void expectOrder(int cell, double least, const Cells& coarse, const std::string& tie) {
  const Cells fine{2 * coarse.inner, 2 * coarse.outer, 2 * coarse.across};
  const double order = std::log2(error(cell, coarse, tie) / error(cell, fine, tie));
  print("cell %d, %s: order %.2f\n", cell, tie.c_str(), order);
  EXPECT_GT(order, least);
}

// The facets of linear faces are off the circle by O(h²), quadratic ones by O(h⁴) along their
// normals, so that the order is that of the elements.
TEST(CurvedTies, FrequenciesConvergeWithTheOrderOfTheElements) {
  for (const auto& tie : {outerOnInner, innerOnOuter}) {
    expectOrder(quad4, 1.9, {36, 48, 6}, tie);
    expectOrder(quad4, 1.9, {48, 36, 5}, tie);
    expectOrder(tri6, 3.5, {12, 18, 2}, tie);
    expectOrder(quad8, 3.5, {12, 18, 2}, tie);
    expectOrder(quad9, 3.5, {12, 18, 2}, tie);
  }
}

// Dual functions on faces with six or eight nodes reproduce constants, and linear functions no
// more: the energy error of the tie is O(h^{3/2}), that of frequencies O(h³).
TEST(CurvedTies, FrequenciesOfSolidsConverge) {
  for (const auto& tie : {outerOnInner, innerOnOuter}) {
    expectOrder(hex8, 1.9, {36, 48, 4}, tie);
    expectOrder(hex20, 2.7, {12, 18, 2}, tie);
    expectOrder(wedge15, 2.7, {12, 18, 2}, tie);
  }
}

}  // namespace
}  // namespace squeal::test
