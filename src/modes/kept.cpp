#include "modes/kept.hpp"

#include <memory>

#include "linalg/columns.hpp"

namespace squeal::modes {

void exchange(checkpoint::Archive& archive, Modes& modes, Mat like) {
  archive.common(modes.lambda, modes.angularFrequency, modes.relativeResidual, modes.iterations,
                 modes.countConfirmed, modes.inertiaCount, modes.inertiaShift, modes.rounding);
  bool has = static_cast<bool>(modes.vectors);
  archive.common(has);
  if (!has) return;
  if (archive.reads()) {
    linalg::DenseMatrix columns;
    archive.own(columns);
    modes.vectors = linalg::copiedColumns(like, columns);
  } else {
    const auto vectors = std::make_shared<const linalg::ReadColumns>(modes.vectors);
    archive.own.borrow(vectors->view(), vectors);
  }
}

}  // namespace squeal::modes
