#pragma once
/// The friction-perturbed problem from files: every matrix with its role M, Z or K, a factor and
/// exponents of friction and speed. What other programs export, and published models, run through
/// the same reduction and certification as the models of meshes.
#include <filesystem>
#include <string>
#include <vector>

#include "modes/associated.hpp"
#include "pencil/complex_modes.hpp"
#include "pencil/pencil.hpp"
#include "sweep/sweep.hpp"

namespace squeal::matrices {

/// A `-matrices_<name>_file` is given. Error: options of the stages of a mesh are given as well.
bool wanted();

/// Collective. A square matrix from a file of any known format (found out by its content),
/// distributed by rows, AIJ; `dataset` names a variable or object within the file, empty: the only
/// matrix there. Rank 0 reads the whole file, except for PETSc's binary format, of which each rank
/// reads its rows. Errors (all ranks), naming file and cause: as formats.hpp documents them; not
/// square; entries that are not finite.
OwnedMat read(MPI_Comm comm, const std::filesystem::path& path, const std::string& dataset = {});

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

/// The associated system of matrices from files: sums of the stiffness and of the mass terms
/// without friction and speed. The friction that such a stiffness may hold stays in the pencil.
struct SymmetricPart {
  modes::AssociatedSystem system;  ///< K0 is the symmetric part of the sum
  double asymmetry;                ///< ‖K − Kᵀ‖ / ‖K‖ of the sum; 0: to printed digits
};

/// Collective. Errors, naming matrices: no such term; an unsymmetric mass; a mass or a stiffness
/// that is not positive definite to within rounding (massless unknowns; a loose body).
SymmetricPart symmetricPart(const std::vector<NamedTerm>& terms);

/// `-report_matrices` is given.
bool exportWanted();

/// Collective, before work begins. Error: the folder of `-report_matrices` cannot be written, or
/// something in it is in the way.
void requireExportFolder(MPI_Comm comm, const std::filesystem::path& results);
/// Collective. Writes the matrices of the pencil to the folder of `-report_matrices`, and
/// options.txt, an -options_file that solves it again. Terms that belong to one point of the
/// parameters, made with its steady forces, are frozen at it. `steadyPoints`: how many steady
/// states of the sweep the pencil is for. Errors: not for all; such terms and a sweep of several
/// points; the folder or a file cannot be written.
void exportPencil(const pencil::Pencil& pencil, const sweep::Sweep& sweep,
                  std::size_t steadyPoints);

}  // namespace squeal::matrices
