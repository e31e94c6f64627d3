#pragma once
/// What the reduced and the direct solve have in common: the band, the verdict and the choice of shapes to keep.
#include <vector>

#include "pencil/complex_modes.hpp"

namespace squeal::flutter {

/// `-flutter_band`, rad/s; 0: not given.
double bandAsked();
/// Its end for free modes of these angular frequencies, ascending: by itself a little more than half up the list. It ends below the last
/// mode (unless all are the same): nothing would tell of an eigenvalue above that is missing, as corrections are those of eigenvalues
/// found.
double bandBelow(const std::vector<double>& frequencies);
/// `-flutter_band_damping`: largest damping ratio.
double bandDamping();

/// `-flutter_accuracy`: backward error up to which an eigenvalue is certified.
double accuracyAsked();

/// Marks unstable eigenvalues.
void judge(std::vector<Eigenvalue>& eigenvalues);

/// Indices of the `-flutter_shapes` fastest growing eigenvalues below `-flutter_shapes_below`, the fastest first.
std::vector<std::size_t> shapesWanted(const FrictionPoint& point);
/// Collective. Keeps the shapes of these eigenvalues; `modes` are theirs in the unknowns x, of any length.
void keepShapes(FrictionPoint& point, Mat trial, const std::vector<std::size_t>& indices, std::vector<ComplexVector> modes);

}  // namespace squeal::flutter
