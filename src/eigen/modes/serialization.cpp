// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/modes/serialization.hpp"

#include <memory>

#include "algebra/linalg/columns.hpp"
#include "algebra/linalg/serialization.hpp"

namespace squeal::modes {

void serialise(checkpoint::Archive& archive, Modes& modes, Mat like) {
  // This lists all members: a new one does not compile until it is added here.
  auto& [lambda, angularFrequency, relativeResidual, vectors, iterations, countConfirmed,
         inertiaCount, inertiaShift, rounding] = modes;
  archive.common(lambda, angularFrequency, relativeResidual, iterations, countConfirmed,
                 inertiaCount, inertiaShift, rounding);
  bool has = static_cast<bool>(vectors);
  archive.common(has);
  if (!has) return;
  if (archive.reads()) {
    linalg::DenseMatrix columns;
    archive.own(columns);
    vectors = linalg::copiedColumns(like, columns);
  } else {
    const auto columns = std::make_shared<const linalg::ReadColumns>(vectors);
    linalg::borrow(archive.own, columns->view(), columns);
  }
}

}  // namespace squeal::modes
