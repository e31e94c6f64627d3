// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Programs that are installed together with this one. Not collective.
#include <string>

namespace squeal {

/// Returns the path of a program that belongs to this installation: next to the executable or the
/// shared library that contains this function, or in the installation's folder for internal
/// programs. An installation may be moved as a whole. Throws Error, naming the folders, if the
/// program is in neither.
std::string installedProgram(const std::string& name);

}  // namespace squeal
