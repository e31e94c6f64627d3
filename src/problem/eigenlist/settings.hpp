// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of a list of eigenvalues from another program.
#include <optional>
#include <string>

namespace squeal::eigenlist {

/// The programs whose lists can be read. `columns` is a table of real and imaginary parts.
enum class Format { automatic, columns, abaqus, calculix, nastran, ansys };

/// The unit of eigenvalues: s itself, or s / 2π.
enum class Unit { radians, hertz };

struct Settings {
  std::string file;  ///< `-referee_list`
  Format format = Format::automatic;
  std::optional<Unit> unit;  ///< `-referee_unit`; none: the unit that the list states

  /// Returns the settings that the options give; none without `-referee_list`. Throws Error if
  /// another option of the list is given without `-referee_list`.
  static std::optional<Settings> given();
};

/// Returns the option for the list, with its dash, for messages.
std::string listOption();

}  // namespace squeal::eigenlist
