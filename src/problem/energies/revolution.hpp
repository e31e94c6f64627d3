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

/// Collective. Returns true if the body looks the same at all angles about the axis, up to copies
/// such as vanes: for the harmonics n = 1 … 6,
///   |Σ m r² e^{inθ}| ≤ 0.1 Σ m r².
bool isRevolved(const mesh::Mesh& mesh, const LumpedBody& body, const Axis& axis);

/// Collective. Returns true if a body of revolution is longer than 3 of its radii.
bool isBar(const mesh::Mesh& mesh, const LumpedBody& body, const Axis& axis);

/// The name of the motion of a body.
struct NamedMotion {
  std::string name;  ///< such as "(0,4) out of plane"; empty if none is clear
  double share = 0;  ///< share of this motion in the kinetic energy of the body
};

/// The Fourier analysis of motions of a body of revolution. The cylindrical components of a motion
/// are fitted, for each number n of nodal diameters, by
///   Σ_ij P_i(ρ) P_j(ζ) (a_ij cos nθ + b_ij sin nθ)
/// with Legendre polynomials of the scaled radius, i ≤ 5, and of the scaled position along the
/// axis, j ≤ 1.
class Revolution {
 public:
  /// Collective. Borrows the mesh during the lifetime of the object.
  Revolution(const mesh::Mesh& mesh, LumpedBody body, const Axis& axis);
  /// Collective. Returns the name of the motion whose parts (real, or real and imaginary) have
  /// these nodal values, this rank's rows: "(m,n) out of plane" with m nodal circles and n nodal
  /// diameters, or "in plane, radial, n = …" or circumferential. Without a share of 0.6 it
  /// has no name.
  NamedMotion name(const std::vector<const double*>& parts) const;

 private:
  linalg::DenseMatrix harmonicsOf(std::size_t first, std::size_t count) const;
  std::vector<double> moments(const double* values) const;
  int circles(int diameters, const std::vector<std::vector<double>>& moments) const;

  const mesh::Mesh& mesh_;
  LumpedBody body_;
  std::array<Point, 3> axes_;          // e_x, e_y across the axis, and along it
  std::vector<double> cosine_, sine_;  // [node]
  linalg::DenseMatrix polynomials_;    // P_i(ρ) P_j(ζ), node × 12
  std::vector<int> ring_;              // [node] bin of the radius
  std::vector<WeightedFit> fits_;      // [n]
};

}  // namespace squeal::energies
