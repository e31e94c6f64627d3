// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of the matrices of a problem: the files to read them from, and the folder to export
/// them to.
#include <map>
#include <string>

namespace squeal::matrices {

/// The settings of one matrix, `-matrices_<name>_*`.
struct MatrixSettings {
  std::string file;          ///< path
  std::string dataset;       ///< variable or object in the file; empty: the only matrix there
  int power = 0;             ///< power of s that multiplies the matrix
  double factor = 1;         ///< number that multiplies the matrix
  int frictionExponent = 0;  ///< power of the coefficient of friction
  int speedExponent = 0;     ///< power of the speed factor
  int dampingExponent = 0;   ///< power of the damping factor
  bool ofFriction = false;   ///< the matrix contains a fixed friction term
};

enum class ExportFormat { petsc, matrixMarket };

/// The settings of the export, `-report_matrices*`.
struct ExportSettings {
  std::string folder;         ///< empty: no export
  bool folderOfCase = false;  ///< the folder was named by an options file
  ExportFormat format = ExportFormat::petsc;
  bool wanted() const { return !folder.empty(); }

  /// Returns the settings that the options give.
  static ExportSettings given();
};

struct Settings {
  std::map<std::string, MatrixSettings> files;  ///< by <name>; empty: a mesh is given
  bool ofMesh() const { return files.empty(); }

  /// Returns the settings that the options give. Throws Error if matrices and options that need a
  /// mesh are given together, and for an option `-matrices_<name>_*` of a name that has no file.
  static Settings given();
};

/// Returns the option for the file of a matrix, with its dash, for messages.
std::string fileOptionOf(const std::string& name);

}  // namespace squeal::matrices
