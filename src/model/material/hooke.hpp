// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Hooke's laws, in the axes of the material and of the mesh, without PETSc objects. Not
/// collective.
#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "model/mesh/mesh.hpp"

namespace squeal::material {

using mesh::Point;

/// The law σ = D ε with engineering shear strains. Its matrix D is row-major, 3×3 (xx, yy, xy) or
/// 6×6 (xx, yy, zz, xy, yz, zx), Pa.
struct Hooke {
  int size = 6;
  std::vector<double> matrix;
  double operator()(int i, int j) const { return matrix[i * size + j]; }
};
/// Returns the law of an isotropic material in this dimension. `young` is in Pa.
Hooke isotropic(double young, double poisson, int dimension, bool planeStress);

/// The engineering constants of an orthotropic material, moduli in Pa. νij is the contraction along
/// j divided by the stretch along i, under tension along i, so νij/Ei = νji/Ej.
struct EngineeringConstants {
  double e1, e2, e3, nu12, nu13, nu23, g12, g13, g23;
};
/// Returns the first violated rule if the strain energy is not positive for every strain; otherwise
/// an empty text.
std::string violatedRule(const EngineeringConstants& constants);
/// Returns the law, 6×6, in the axes 1, 2, 3 of the material, from constants that violate no rule.
Hooke orthotropic(const EngineeringConstants& constants);

/// Returns the law, 6×6, in the axes of the material, from the upper triangle of its matrix, Pa.
/// The triangle is given column by column, with rows and columns in the order 11, 22, 33, 12, 13,
/// 23: D1111, D1122, D2222, D1133, …, D2323. `constants` are all 21 constants or, for an
/// orthotropic material, the nine that are not zero: D1111, D1122, D2222, D1133, D2233, D3333,
/// D1212, D1313, D2323.
Hooke anisotropic(std::span<const double> constants);
/// Returns the first violated rule if the strain energy of a 6×6 law is not positive for every
/// strain; otherwise an empty text.
std::string violatedRule(const Hooke& solid);

/// The unit vectors of the axes 1, 2, 3 of a material, orthogonal and right-handed.
using Axes = std::array<Point, 3>;
/// Returns the law in the axes of the mesh, 6×6, from the law in the given axes, 6×6.
Hooke rotated(const Hooke& hooke, const Axes& axes);

/// Returns true if strains in the plane x, y and along z cause no shear stresses σ_yz and σ_zx,
/// within 1e-9 of the largest modulus.
bool mirrorSymmetric(const Hooke& solid);
/// Returns the 3×3 law for plane problems from a mirror-symmetric 6×6 law, with u_z = 0 in plane
/// strain, and σ_zz = σ_yz = σ_zx = 0 in plane stress.
Hooke inPlane(const Hooke& solid, bool planeStress);

/// Hooke's law of a material.
struct Law {
  Hooke uniform;
  std::function<Hooke(const Point&)> varying;  ///< if not empty, the law at each point instead

  /// Returns the law at x. A law that varies is evaluated into `storage`.
  const Hooke& at(const Point& x, Hooke& storage) const {
    return varying ? storage = varying(x) : uniform;
  }
};

}  // namespace squeal::material
