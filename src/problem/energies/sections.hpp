// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Motions of a body in which its cross-sections move rigidly: bending, torsion, stretching.
#include <array>
#include <vector>

#include "model/mesh/mesh.hpp"
#include "problem/energies/revolution.hpp"
#include "problem/energies/weighted_fit.hpp"

namespace squeal::energies {

/// The principal axes and values of Σ m r rᵀ of a body, with r from its centre of mass.
struct Principal {
  std::array<double, 3> values;  ///< descending, kg m²
  std::array<Point, 3> axes;     ///< unit
};

/// The fit of motions of a long or flat body by rigid motions of its cross-sections,
///   bending    u = p(ζ) a + q(ζ) (a·X) e,
///   torsion    u = p(ζ) (e × X),
///   axial      u = p(ζ) e,
/// with polynomials p and q of degree 9 in the scaled position ζ along e, and the position X
/// relative to the centre. The principal axes are numbered 1 to 3 in the order of Principal. The
/// names are
///   bending            e = 1, a = 3, or, unless the body is flat, a combination of 2 and 3,
///   in-plane bending   e = 1, a = 2, of a flat body,
///   cross bending      e = 2, a = 3,
///   torsion            e = 1,
///   cross torsion      e = 2; if its number is 1, it is called torsion 1,
///   axial              e = 1.
/// A body is flat if its radius of gyration along axis 3 is less than 0.4 of that along axis 2.
class Sections {
 public:
  /// Collective. Borrows the mesh during the lifetime of the object.
  Sections(const mesh::Mesh& mesh, LumpedBody body, const Point& centre, const Principal& axes);
  /// Collective. Returns the name of an elastic motion, such as "bending 1", and the share of the
  /// motion that the fit explains. `values` are its nodal values, this rank's rows. The number in
  /// the name is the number of nodal sections, minus one for bending, so that it is 1 for the
  /// lowest mode of a free bar. The name is empty if the largest share is below 0.7.
  NamedMotion name(const double* values) const;

 private:
  /// The motions of one kind, with cross-sections perpendicular to one axis.
  struct Family {
    enum class Kind { bending, torsion, axial } kind;
    std::string name;
    std::size_t along = 0;                 ///< index of e
    std::vector<std::size_t> across = {};  ///< indices of the directions a of bending
    WeightedFit fit = {};
    std::size_t size() const;
  };
  std::vector<Point> motionsAt(const Family& family, std::size_t node) const;
  std::vector<double> moments(const double* values) const;
  int order(const Family& family, const std::vector<double>& coefficients) const;

  const mesh::Mesh& mesh_;
  LumpedBody body_;
  Principal axes_;
  std::vector<Point> fromCentre_;                   // [node]
  std::array<double, 2> lengths_{};                 // [axis] m
  std::array<std::vector<double>, 2> polynomials_;  // [axis][node][degree]
  std::vector<Family> families_;
};

}  // namespace squeal::energies
