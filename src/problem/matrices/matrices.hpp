// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The eigenvalue problem with friction, given by matrices from files. Each matrix has a role (M, Z
/// or K: the factor of s², s or 1), a factor, and exponents of friction, speed and damping [M.23].
/// Matrices exported by other programs, and published models, are reduced and certified like models
/// made from a mesh.
#include <string>
#include <vector>

#include "eigen/pencil/pencil.hpp"
#include "problem/matrices/settings.hpp"

namespace squeal::matrices {

/// A term of the pencil and its name.
struct NamedTerm {
  std::string name;  ///< the <name> in its options
  pencil::Term term;
};

/// Collective. Returns the terms of all options `-matrices_<name>_file`. Throws Error as read()
/// does, naming the option, and if the matrices have different sizes.
std::vector<NamedTerm> readTerms(MPI_Comm comm, const Settings& settings);

/// Collective. Returns the relative departure from symmetry in the Frobenius norm,
///   ‖A − Aᵀ‖ / ‖A‖,
/// which is 0 for a matrix of zeros.
double asymmetry(Mat matrix);

}  // namespace squeal::matrices
