#include "regime/sound/outside.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "base/session/stages.hpp"
#include "base/system/concatenation.hpp"
#include "model/mesh/vector.hpp"
#include "regime/sound/spectrum.hpp"

namespace squeal::sound {
namespace {

/// Collective. Returns the mean of v vᵀ over the samples of the rank `root`; zero without samples.
DenseMatrix meanSquaresOf(MPI_Comm comm, int root, const Trace& trace, PetscInt modes) {
  int rank = 0;
  check(MPI_Comm_rank(comm, &rank));
  DenseMatrix result(modes, modes);
  if (rank == root && trace.velocities.rows() > 0) {
    result = linalg::transposedProduct(trace.velocities, trace.velocities);
    for (double& entry : result.entries()) entry /= trace.velocities.rows();
  }
  check(MPI_Bcast(result.data(), result.size(), MPI_DOUBLE, root, comm));
  return result;
}

double trace(const DenseMatrix& a, const DenseMatrix& b) {
  return std::inner_product(a.entries().begin(), a.entries().end(), b.entries().begin(), 0.0);
}

}  // namespace

Observer::Observer(const contact::Contact& contact, const Shapes& shapes, const Settings& settings)
    : contact_(contact),
      shapes_(shapes),
      settings_(settings),
      surface_(visibleSurface(*contact.mesh, contact)) {
  linalg::Block product(shapes.modes.rows());
  linalg::appendProduct(surface_.normalMass, shapes.modes, product);
  radiation_ = linalg::transposedProduct(contact.mesh->comm, shapes.modes, product);
  if (surface_.area == 0)
    complain(contact.mesh->comm,
             "warning: no face of the bodies is visible after flutter: all are in contact, tied, "
             "cut or held; there is no sound, and no spectrum at a point");
}

/// Returns the estimate of the sound power [M.76],
///   W = ρc ∫ ⟨v_n²⟩ dA = ρc tr(S ⟨v vᵀ⟩).
Sound Observer::soundOf(const DenseMatrix& meanSquares) const {
  Sound sound;
  sound.area = surface_.area;
  const double integral = trace(radiation_, meanSquares);
  if (!(integral > 0)) return sound;  // no samples, or nothing to be seen
  sound.meanSquareVelocity = integral / sound.area;
  sound.power = settings_.airImpedance * integral;
  sound.level = 10 * std::log10(sound.power / 1e-12);
  return sound;
}

/// Returns the rows of V of some owned nodes, all components of a node after each other.
DenseMatrix Observer::rowsOf(std::span<const PetscInt> nodes) const {
  const int dimension = contact_.mesh->dimension;
  DenseMatrix rows(std::ssize(nodes) * dimension, shapes_.modes.columns());
  for (PetscInt j = 0; j < rows.columns(); ++j)
    for (PetscInt i = 0; i < rows.rows(); ++i)
      rows(i, j) = shapes_.modes(dimension * nodes[i / dimension] + i % dimension, j);
  return rows;
}

/// Returns the nodes of the surface on this rank with minus their mean square velocities.
std::vector<Observer::Choice> Observer::byVelocity(const DenseMatrix& meanSquares) const {
  constexpr std::size_t atOnce = 512;
  const auto& mesh = *contact_.mesh;
  std::vector<PetscInt> nodes;
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    if (surface_.has(node)) nodes.push_back(node);
  std::vector<Choice> result;
  for (std::size_t begin = 0; begin < nodes.size(); begin += atOnce) {
    const auto some = std::span(nodes).subspan(begin, std::min(atOnce, nodes.size() - begin));
    const DenseMatrix rows = rowsOf(some), products = linalg::product(rows, meanSquares);
    std::vector<double> sums(some.size());
    for (PetscInt j = 0; j < rows.columns(); ++j)
      for (PetscInt i = 0; i < rows.rows(); ++i)
        sums[i / mesh.dimension] += rows(i, j) * products(i, j);
    for (std::size_t i = 0; i < some.size(); ++i)
      result.push_back({-sums[i], mesh.coordinates[some[i]], some[i]});
  }
  return result;
}

/// Returns the nodes of the surface on this rank with their distances from a place.
std::vector<Observer::Choice> Observer::byDistance(const Point& place) const {
  const auto& mesh = *contact_.mesh;
  std::vector<Choice> result;
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    if (surface_.has(node)) {
      const Point& x = mesh.coordinates[node];
      result.push_back({mesh::length(mesh::minus(x, place)), x, node});
    }
  return result;
}

/// Collective. Returns the node of the smallest measure of all ranks and sets its rows of V. Of
/// those that are equal up to rounding, the first by its coordinates is taken, so that the number
/// of ranks does not matter.
SurfacePoint Observer::pointOf(const std::vector<Choice>& own, double tolerance,
                               const DenseMatrix& meanSquares, DenseMatrix& shape) const {
  const auto& mesh = *contact_.mesh;
  double least = INFINITY;
  for (const auto& choice : own) least = std::min(least, choice.measure);
  check(MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE, MPI_MIN, mesh.comm));
  std::vector<Choice> best;
  for (const auto& choice : own) {
    if (choice.measure > least + tolerance * std::abs(least)) continue;
    if (best.empty())
      best.push_back(choice);
    else if (choice.position < best[0].position)
      best[0] = choice;
  }
  const Concatenation ranks(mesh.comm, best.size());
  const auto all = ranks.gathered(best);
  SurfacePoint point;
  shape = DenseMatrix(mesh.dimension, shapes_.modes.columns());
  const auto first = std::ranges::min_element(all, {}, &Choice::position);
  point.position = first->position;
  if (first - all.begin() == ranks.ownBegin() && !best.empty()) {
    point.normal = surface_.normals[best[0].node];
    shape = rowsOf(std::span(&best[0].node, 1));
  }
  // The others have zeros.
  check(MPI_Allreduce(MPI_IN_PLACE, point.normal.data(), 3, MPI_DOUBLE, MPI_SUM, mesh.comm));
  check(MPI_Allreduce(MPI_IN_PLACE, shape.data(), shape.size(), MPI_DOUBLE, MPI_SUM, mesh.comm));
  point.meanSquareVelocity = trace(shape, linalg::product(shape, meanSquares));
  return point;
}

/// Collective. Sets the points with their spectra, which the rank `root` makes.
void Observer::addSpectra(int root, const Trace& trace, const DenseMatrix& meanSquares,
                          std::vector<SurfacePoint>& points) const {
  const MPI_Comm comm = contact_.mesh->comm;
  const int dimension = contact_.mesh->dimension;
  const auto& wanted = settings_.spectrumPoints;
  if (surface_.area == 0) return;
  for (std::size_t i = 0; i < std::max<std::size_t>(1, wanted.size()); ++i) {
    DenseMatrix shape;
    points.push_back(wanted.empty() ? pointOf(byVelocity(meanSquares), 1e-6, meanSquares, shape)
                                    : pointOf(byDistance(wanted[i]), 1e-9, meanSquares, shape));
    SurfacePoint& point = points.back();
    point.name = wanted.empty() ? "largest" : std::to_string(i + 1);
    std::vector<double> signal[4];
    PetscInt lines = 0;
    if (const PetscInt count = trace.velocities.rows(); count > 0) {
      lines = count / 2 + 1;
      for (auto& component : signal) component.assign(count, 0);
      for (PetscInt j = 0; j < trace.velocities.columns(); ++j)
        for (int d = 0; d < dimension; ++d)
          for (PetscInt t = 0; t < count; ++t) signal[d][t] += shape(d, j) * trace.velocities(t, j);
      for (int d = 0; d < dimension; ++d)
        for (PetscInt t = 0; t < count; ++t) signal[3][t] += point.normal[d] * signal[d][t];
    }
    check(MPI_Bcast(&lines, 1, MPIU_INT, root, comm));
    point.amplitude.resize(lines);
    if (trace.velocities.rows() > 0)
      for (int c = 0; c < 4; ++c) {
        const auto line = amplitudes(signal[c]);
        for (PetscInt k = 0; k < lines; ++k) point.amplitude[k][c] = line[k];
      }
    check(MPI_Bcast(point.amplitude.data(), 4 * lines, MPI_DOUBLE, root, comm));
  }
}

/// Collective. Returns displacements, gaps and pressures of samples that all ranks have.
Frames Observer::framesOf(const std::vector<Sample>& samples) const {
  Frames frames;
  DenseMatrix q(shapes_.modes.columns()), z(shapes_.responses.columns());
  for (const Sample& sample : samples) {
    frames.time.push_back(sample.time);
    q.append(std::span<const double>(sample.q));
    z.append(std::span<const double>(sample.z));
    std::vector<double> gap(contact_.nodes.size()), pressure(contact_.nodes.size());
    for (std::size_t i = 0; i < shapes_.contactNode.size(); ++i)
      if (const PetscInt own = shapes_.contactNode[i]; own >= 0) {
        gap[own] = sample.gap[i];
        pressure[own] = sample.force[i] / contact_.nodes[own].area;
      }
    frames.gap.push_back(contact_.nodalGap(gap));
    frames.pressure.push_back(std::move(pressure));
  }
  if (samples.empty()) return frames;
  frames.displacement = linalg::product(shapes_.modes, q);
  linalg::multiplyAdd(shapes_.responses, z, frames.displacement);
  return frames;
}

Outside Observer::of(int root, const Trace& trace) const {
  const MPI_Comm comm = contact_.mesh->comm;
  Outside outside;
  const auto meanSquares = meanSquaresOf(comm, root, trace, shapes_.modes.columns());
  outside.sound = soundOf(meanSquares);
  addSpectra(root, trace, meanSquares, outside.points);
  auto samples = trace.samples;
  share(comm, root, samples);
  outside.frames = framesOf(samples);
  return outside;
}

}  // namespace squeal::sound
