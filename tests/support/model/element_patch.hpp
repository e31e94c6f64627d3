// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Patches of distorted cells of every element, with what a test of their matrices needs.
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/system/text.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/element/shape.hpp"
#include "support/model/model.hpp"

namespace squeal::test::patch {

inline constexpr double young = 2.0, poisson = 0.3, density = 1.7;

struct Element {
  const char *label, *names;  ///< names of its cells, with blanks between them
  int dimension;
  const char *parameters, *incompatible;
};
inline void PrintTo(const Element& element, std::ostream* out) { *out << element.label; }
inline const Element elements[] = {
    {"tri3", "tri3", 2, "recombine=0,n=2", "none"},
    {"tri6", "tri6", 2, "recombine=0,order=2", "none"},
    {"quad4", "quad4", 2, "n=2", "none"},
    {"quad4_incompatible", "quad4", 2, "n=2", "quad4"},
    {"quad8", "quad8", 2, "order=2,serendipity=1", "none"},
    {"quad9", "quad9", 2, "order=2", "none"},
    {"tet4", "tet4", 3, "recombine=0,n=2", "none"},
    {"tet10", "tet10", 3, "recombine=0,order=2", "none"},
    {"hex8", "hex8", 3, "n=2", "none"},
    {"hex8_incompatible", "hex8", 3, "n=2", "hex8"},
    {"hex20", "hex20", 3, "order=2,serendipity=1", "none"},
    {"hex20_reduced", "hex20", 3, "order=2,serendipity=1", "none"},
    {"hex27", "hex27", 3, "order=2", "none"},
    {"wedge6", "wedge6", 3, "recombine=0,wedge=1,n=2", "none"},
    {"wedge15", "wedge15", 3, "recombine=0,wedge=1,order=2,serendipity=1", "none"},
    {"wedge18", "wedge18", 3, "recombine=0,wedge=1,order=2", "none"},
    {"mixed", "hex8 pyramid5 tet4", 3, "", "none"},
    {"mixed_incompatible", "hex8 pyramid5 tet4", 3, "", "hex8"},
    {"mixed_serendipity", "hex20 pyramid13 tet10", 3, "order=2,serendipity=1", "none"},
    {"mixed_quadratic", "hex27 pyramid14 tet10", 3, "order=2", "none"},
};

inline std::string patchMesh(const Element& element) {
  const bool mixed = contains(element.label, "mixed");
  return std::string(" -mesh_file meshes/patch_") +
         (mixed                    ? "mixed"
          : element.dimension == 2 ? "2d"
                                   : "3d") +
         ".geo" + (*element.parameters ? std::string(" -mesh_set ") + element.parameters : "");
}

inline std::string patchOptions(const Element& element, const std::string& more = {}) {
  return patchMesh(element) +
         material("body", std::to_string(young), std::to_string(poisson), std::to_string(density)) +
         "-constraint_boundary_clamped " + (element.dimension == 2 ? "xy" : "xyz") +
         " -load_boundary_pressure 0 -elasticity_incompatible_modes " + element.incompatible + " " +
         (contains(element.label, "reduced") ? "-material_body_integration reduced " : "") + more;
}

/// The unit square or cube of distorted cells.
class Patch : public testing::TestWithParam<Element> {
 protected:
  void build(const std::string& more = {}) {
    setOptions(patchOptions(GetParam(), more));
    static std::map<std::string, mesh::Mesh>
        meshes;  // of all tests: gmsh takes longer than they do
    if (!meshes.count(GetParam().label)) meshes[GetParam().label] = readMesh();
    mesh = meshes[GetParam().label];
    bodies = assembleBodies(mesh);
    std::set<std::string> names;
    for (const auto& block : mesh.cells) names.insert(element::shapeTable(block.type).name);
    EXPECT_EQ(joined({names.begin(), names.end()}, " "), GetParam().names);
  }
  int dimension() const { return GetParam().dimension; }
  OwnedVec unit(int component) const {
    return nodalField(mesh, [&](const mesh::Point&) {
      mesh::Point e{};
      e[component] = 1;
      return e;
    });
  }
  /// Translations, then rotations e_k × (x − centre): 3 in the plane, 6 in space.
  std::vector<OwnedVec> rigidMotions() const {
    std::vector<OwnedVec> motions;
    for (int d = 0; d < dimension(); ++d) motions.push_back(unit(d));
    for (std::size_t k = dimension() == 2 ? 2 : 0; k < 3; ++k)
      motions.push_back(nodalField(mesh, [&](const mesh::Point& x) {
        const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
        mesh::Point u{};
        u[i] = -(x[j] - 0.5), u[j] = x[i] - 0.5;
        return u;
      }));
    return motions;
  }
  mesh::Mesh mesh;
  elasticity::Bodies bodies;
};

}  // namespace squeal::test::patch
