// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/pencil/friction_factors.hpp"

#include <algorithm>

#include "base/system/error.hpp"

namespace squeal::pencil {

Mat FrictionFactors::normalOf(int power) const {
  const auto found = std::ranges::find_if(
      normal, [&](const Term& term) { return term.isAssociated() && term.power == power; });
  ensure(found != normal.end(), "the factors of friction contain those of stiffness and mass");
  return found->matrix;
}

}  // namespace squeal::pencil
