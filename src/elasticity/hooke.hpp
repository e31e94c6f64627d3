#pragma once
/// Hooke's laws, in their own axes and turned. No PETSc object is seen here. Not collective.
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "mesh/mesh.hpp"

namespace squeal::elasticity {

using mesh::Point;

/// Hooke's law σ = D ε with engineering shear strains; row-major, 3×3 (xx, yy, xy) or 6×6 (xx, yy,
/// zz, xy, yz, zx), Pa.
struct Hooke {
  int size = 6;
  std::vector<double> matrix;
  double operator()(int i, int j) const { return matrix[static_cast<std::size_t>(i * size + j)]; }
};
Hooke isotropic(double young, double poisson, int dimension, bool planeStress);

/// Moduli in Pa; νij: contraction along j per stretch along i in tension along i, so that νij/Ei =
/// νji/Ej.
struct EngineeringConstants {
  double e1, e2, e3, nu12, nu13, nu23, g12, g13, g23;
};
/// The first rule that these constants break if the strain energy is not positive for every strain;
/// empty if it is.
std::string brokenRule(const EngineeringConstants& constants);
/// 6×6 in the axes 1, 2, 3 of the material, from constants that break no rule.
Hooke orthotropic(const EngineeringConstants& constants);

/// Unit vectors of the material's axes 1, 2, 3, orthogonal and right-handed.
using Axes = std::array<Point, 3>;
/// 6×6 in the axes of the mesh, from 6×6 in the axes given.
Hooke rotated(const Hooke& hooke, const Axes& axes);

/// True if strains in the plane x, y cause no shear stress across it.
bool mirrorSymmetric(const Hooke& solid);
/// 3×3 from a mirror-symmetric 6×6: u_z = 0 in plane strain, σ_zz = σ_yz = σ_zx = 0 in plane
/// stress.
Hooke inPlane(const Hooke& solid, bool planeStress);

/// Hooke's law of a body.
struct Law {
  Hooke uniform;
  std::function<Hooke(const Point&)> varying;  ///< if not empty, the law at each point instead

  /// The law at x, in `storage` if it varies.
  const Hooke& at(const Point& x, Hooke& storage) const {
    return varying ? storage = varying(x) : uniform;
  }
};

}  // namespace squeal::elasticity
