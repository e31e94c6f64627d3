// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/pencil/serialization.hpp"

#include "algebra/linalg/serialization.hpp"

namespace squeal::pencil {

/// The streams find both by argument-dependent lookup.
void fields(Stream& stream, Derivative& derivative);
void fields(Stream& stream, Sensitivity& found);
void fields(Stream& stream, Component& component);
void fields(Stream& stream, CriticalDerivative& derivative);

// These list all members: a new one does not compile until it is added here.

void fields(Stream& stream, Derivative& derivative) {
  auto& [parameter, value, second] = derivative;
  stream(parameter, value, second);
}

void fields(Stream& stream, Sensitivity& found) {
  auto& [condition, separation, leftBackwardError, derivatives] = found;
  stream(condition, separation, leftBackwardError, derivatives);
}

void fields(Stream& stream, Component& component) {
  auto& [kind, name, strain, kinetic, motion, motionShare, growth] = component;
  stream(kind, name, strain, kinetic, motion, motionShare, growth);
}

void fields(Stream& stream, CriticalDerivative& derivative) {
  auto& [parameter, value] = derivative;
  stream(parameter, value);
}

void fields(Stream& stream, CriticalMode& found) {
  auto& [name, participations, rightBackwardError, leftBackwardError, derivatives] = found;
  stream(name, participations, rightBackwardError, leftBackwardError, derivatives);
}

void fields(Stream& stream, Completeness& found) {
  auto& [proved, count, top, left, definiteness, ratio, place, discs, reason, missing, spurious,
         undecided] = found;
  stream(proved, count, top, left, definiteness, ratio, place, discs, reason, missing, spurious,
         undecided);
}

void serialiseProof(checkpoint::Archive& archive, ComplexModes& point) {
  archive.common(point.eigenvalues, point.completeness);
}

void serialise(checkpoint::Archive& archive, ComplexModes& point) {
  auto& [at, eigenvalues, shapes, sensitivities, bandTop, freeModesInBand, damped, accuracy,
         tolerance, directBandTop, coveredTo, completeness] = point;
  archive.common(at, eigenvalues, sensitivities, bandTop, freeModesInBand, damped, accuracy,
                 tolerance, directBandTop, coveredTo, completeness);
  std::size_t count = shapes.size();
  archive.common(count);
  shapes.resize(count);
  for (auto& [index, real, imaginary, unknowns, frictionWork, components, participations,
              correlations] : shapes) {
    archive.common(index);
    archive.vector(real);
    archive.vector(imaginary);
    linalg::serialise(archive, unknowns);
    archive.own(frictionWork);
    archive.common(components);
    // These are from the free modes, once all points are solved.
    participations.clear();
    correlations.clear();
  }
}

}  // namespace squeal::pencil
