#pragma once
/// What the reduced and the direct solve have in common: the verdict and the choice of shapes to keep.
#include <functional>

#include "flutter/flutter.hpp"

namespace squeal::flutter {

/// `-flutter_accuracy`: backward error up to which an eigenvalue is certified.
double accuracyAsked();

/// Marks unstable eigenvalues.
void judge(std::vector<Eigenvalue>& eigenvalues);

/// Collective. Keeps the `-flutter_shapes` fastest growing shapes of `point`; `unknowns` gives the modes of these eigenvalues in the
/// unknowns x, of any length.
void keepShapes(FrictionPoint& point, Mat trial,
                const std::function<std::vector<ComplexVector>(const std::vector<std::size_t>&)>& unknowns);

}  // namespace squeal::flutter
