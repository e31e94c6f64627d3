// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The settings of the terms of the pencil.

namespace squeal::terms {

struct Settings {
  /// If true, the friction force turns with the relative velocity and follows the friction law. If
  /// false, it changes only with the normal force: R_T* = −f φ R_N* τ.
  bool frictionDamping = true;

  /// Returns the settings that the options give.
  static Settings given();
};

}  // namespace squeal::terms
