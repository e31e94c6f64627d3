// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Bodies of revolution, and the Fourier analysis of their motions.
#include <array>
#include <string>
#include <vector>

#include "model/mesh/mesh.hpp"
#include "model/mesh/vector.hpp"
#include "problem/energies/weighted_fit.hpp"

namespace squeal::energies {

using mesh::Point;

/// The nodes of a body on this rank, with lumped masses.
struct LumpedBody {
  std::vector<PetscInt> nodes;  ///< owned local nodes
  std::vector<double> mass;     ///< [node] kg
};

/// A line in space.
struct Axis {
  Point origin;     ///< m
  Point direction;  ///< unit
};

/// Collective. Returns true if the body looks the same at all angles about the axis, except for
/// repeated features such as vanes. The criterion is, for the harmonics n = 1 … 6,
///   |Σ m r² e^{inθ}| ≤ 0.1 Σ m r².
bool isRevolved(const mesh::Mesh& mesh, const LumpedBody& body, const Axis& axis);

/// Collective. Returns true if a body of revolution is longer than three times its outer radius.
bool isBar(const mesh::Mesh& mesh, const LumpedBody& body, const Axis& axis);

/// The name of the motion of a body.
struct NamedMotion {
  std::string name;  ///< such as "(0,4) out of plane"; empty if no motion dominates
  double share = 0;  ///< share of the named motion in the kinetic energy of the body
};

/// The Fourier analysis of motions of a body of revolution. For each number n of nodal diameters,
/// the cylindrical components of a motion are fitted by
///   Σ_ij P_i(ρ) P_j(ζ) (a_ij cos nθ + b_ij sin nθ)
/// with the Legendre polynomials P_i of the scaled radius ρ, i ≤ 5, and P_j of the scaled position
/// ζ along the axis, j ≤ 1.
class Revolution {
 public:
  /// Collective. Borrows the mesh during the lifetime of the object.
  Revolution(const mesh::Mesh& mesh, LumpedBody body, const Axis& axis);
  /// Collective. Returns the name of a motion. `parts` are its real, or its real and its imaginary
  /// nodal values, this rank's rows. The name is "(m,n) out of plane" with m nodal circles and n
  /// nodal diameters, "in plane, radial, n = …" or "in plane, circumferential, n = …". It is empty
  /// if the largest share is below 0.6.
  NamedMotion name(const std::vector<const double*>& parts) const;

 private:
  linalg::DenseMatrix harmonicsOf(std::size_t first, std::size_t count) const;
  std::vector<double> moments(const double* values) const;
  int circles(int diameters, const std::vector<std::vector<double>>& moments) const;

  const mesh::Mesh& mesh_;
  LumpedBody body_;
  std::array<Point, 3> axes_;          // two unit vectors across the axis, and one along it
  std::vector<double> cosine_, sine_;  // [node]
  linalg::DenseMatrix polynomials_;    // P_i(ρ) P_j(ζ), node × 12
  std::vector<int> ring_;              // [node] bin of the radius
  std::vector<WeightedFit> fits_;      // [n]
};

}  // namespace squeal::energies
