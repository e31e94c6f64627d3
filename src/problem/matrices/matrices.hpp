// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The friction-perturbed problem from files: each matrix has a role M, Z or K, a factor, and
/// exponents of friction, speed and damping [M.23]. Exports of other programs and published models
/// are reduced and certified like the models of meshes.
#include <string>
#include <vector>

#include "eigen/pencil/pencil.hpp"
#include "problem/matrices/settings.hpp"

namespace squeal::matrices {

/// A term of the pencil and its name.
struct NamedTerm {
  std::string name;  ///< <name> of its options
  pencil::Term term;
};

/// Collective. Returns the terms of all `-matrices_<name>_file`. Throws Error as read() does,
/// naming the option, and for matrices of different sizes.
std::vector<NamedTerm> readTerms(MPI_Comm comm, const Settings& settings);

/// Collective. Returns the relative departure from symmetry in the Frobenius norm,
///   ‖A − Aᵀ‖ / ‖A‖,
/// which is 0 for a matrix of zeros.
double asymmetry(Mat matrix);

}  // namespace squeal::matrices
