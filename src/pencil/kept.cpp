#include "pencil/kept.hpp"

namespace squeal::pencil {

/// The streams find these two by their arguments.
void fields(checkpoint::Stream& stream, Derivative& derivative);
void fields(checkpoint::Stream& stream, Sensitivity& found);

void fields(checkpoint::Stream& stream, Derivative& derivative) {
  stream(derivative.parameter, derivative.value);
}

void fields(checkpoint::Stream& stream, Sensitivity& found) {
  stream(found.condition, found.separation, found.leftBackwardError, found.derivatives);
}

void exchange(checkpoint::Archive& archive, ComplexModes& point) {
  archive.common(point.at, point.eigenvalues, point.sensitivities, point.bandTop,
                 point.freeModesInBand, point.damped, point.accuracy, point.tolerance,
                 point.askedTo, point.coveredTo);
  std::size_t shapes = point.shapes.size();
  archive.common(shapes);
  point.shapes.resize(shapes);
  for (auto& shape : point.shapes) {
    archive.common(shape.index);
    archive.vector(shape.real);
    archive.vector(shape.imaginary);
    archive.vector(shape.unknowns);
    archive.own(shape.frictionWork);
  }
}

}  // namespace squeal::pencil
