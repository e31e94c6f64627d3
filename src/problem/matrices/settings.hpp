// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of problems that are given by matrices: the files to read, and the folder to which
/// the matrices of a problem are exported.
#include <map>
#include <string>

namespace squeal::matrices {

/// The settings of one matrix, `-matrices_<name>_*`.
struct MatrixSettings {
  std::string file;          ///< path
  std::string dataset;       ///< variable or object in the file; empty: the only matrix there
  int power = 0;             ///< of s
  double factor = 1;         ///< on the matrix
  int frictionExponent = 0;  ///< of the coefficient of friction
  int speedExponent = 0;     ///< of the speed factor
  int dampingExponent = 0;   ///< of the damping factor
  bool ofFriction = false;   ///< it contains a fixed friction term
};

enum class ExportFormat { petsc, matrixMarket };

/// The settings of the export, `-report_matrices*`.
struct ExportSettings {
  std::string folder;         ///< empty: no export
  bool folderOfCase = false;  ///< an options file names the folder
  ExportFormat format = ExportFormat::petsc;
  bool wanted() const { return !folder.empty(); }

  /// Returns the settings that the options give.
  static ExportSettings given();
};

struct Settings {
  std::map<std::string, MatrixSettings> files;  ///< by <name>; empty: the problem is of a mesh
  bool ofMesh() const { return files.empty(); }

  /// Returns the settings that the options give. Throws Error if options of the stages of a mesh
  /// are given as well, and for another `-matrices_<name>_*` option of a name without a file.
  static Settings given();
};

/// Returns the option for the file of a matrix, with its dash, for messages.
std::string fileOptionOf(const std::string& name);

}  // namespace squeal::matrices
