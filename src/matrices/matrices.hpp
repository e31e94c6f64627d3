#pragma once
/// The friction-perturbed problem from files: every matrix with its role M, Z or K, a factor and
/// exponents of friction and speed. What other programs export, and published models, run through
/// the same reduction and certification as the models of meshes.
#include <string>
#include <vector>

#include "pencil/pencil.hpp"

namespace squeal::matrices {

/// A `-matrices_<name>_file` is given. Error: options of the stages of a mesh are given as well.
bool wanted();

/// A term of the pencil and where it comes from.
struct NamedTerm {
  std::string name;
  pencil::Term term;
};

/// Collective. The terms of all `-matrices_<name>_*`. Errors: as read(), with the option; matrices
/// of different sizes; no mass or no stiffness.
std::vector<NamedTerm> readTerms(MPI_Comm comm);

/// Relative departure from symmetry, ‖A − Aᵀ‖ / ‖A‖ (Frobenius). Collective.
double asymmetry(Mat matrix);

}  // namespace squeal::matrices
