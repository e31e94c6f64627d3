// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Settings of contact. Not collective.
#include "model/contact/friction.hpp"

namespace squeal::contact {

struct Settings {
  FrictionLaw law;

  /// Reads the options `-friction_*`. Throws Error for a table that is empty, whose lists differ in
  /// length or whose speeds do not ascend, and for options of a law that is not selected.
  static Settings given();
};

}  // namespace squeal::contact
