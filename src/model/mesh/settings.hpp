// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Settings of the mesh. Not collective.

namespace squeal::mesh {

/// The curved cells whose edges are straightened.
enum class Straightening { none, folded, all };

struct Settings {
  Straightening straightening = Straightening::none;

  static Settings given();
};

}  // namespace squeal::mesh
