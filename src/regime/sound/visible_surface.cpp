// SPDX-License-Identifier: BSD-2-Clause
#include "regime/sound/visible_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "base/session/stages.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/mpi.hpp"
#include "model/mesh/vector.hpp"
#include "regime/sound/spectrum.hpp"

namespace squeal::sound {
namespace {

/// Collective. Returns the mean of v vᵀ over the samples of the rank `root`; zero without samples.
DenseMatrix meanSquaresOf(MPI_Comm comm, int root, const Trace& trace, PetscInt modes) {
  DenseMatrix result(modes, modes);
  if (mpi::rank(comm) == root && trace.velocities.rows() > 0) {
    result = linalg::transposedProduct(trace.velocities, trace.velocities);
    for (double& entry : result.entries()) entry /= trace.velocities.rows();
  }
  mpi::broadcastBytes(comm, result.data(), result.size() * sizeof(double), root);
  return result;
}

/// Returns tr(Aᵀ B).
double contraction(const DenseMatrix& a, const DenseMatrix& b) {
  return std::inner_product(a.entries().begin(), a.entries().end(), b.entries().begin(), 0.0);
}

}  // namespace

Observer::Observer(const contact::Contact& contact, const Shapes& shapes, const Settings& settings)
    : contact_(contact),
      shapes_(shapes),
      settings_(settings),
      surface_(radiatingSurface(*contact.mesh, contact)) {
  linalg::Block product(shapes.modes.rows());
  linalg::appendProduct(surface_.normalMass, shapes.modes, product);
  radiation_ = linalg::transposedProduct(contact.mesh->comm, shapes.modes, product);
  if (surface_.area == 0)
    printWarning(
        contact.mesh->comm,
        "warning: no face of the bodies is visible after flutter: all are in contact, tied, "
        "cut or held; the sound power and the spectra at points are omitted");
}

/// Returns the estimate of the sound power [M.76],
///   W = ρc ∫ ⟨v_n²⟩ dA = ρc tr(S ⟨v vᵀ⟩).
Sound Observer::soundOf(const DenseMatrix& meanSquares) const {
  Sound sound;
  sound.area = surface_.area;
  const double integral = contraction(radiation_, meanSquares);
  if (!(integral > 0)) return sound;  // no samples, or no visible surface
  sound.meanSquareVelocity = integral / sound.area;
  sound.power = settings_.airImpedance * integral;
  sound.level = 10 * std::log10(sound.power / 1e-12);
  return sound;
}

/// Returns the rows of V of some owned nodes, node by node.
DenseMatrix Observer::rowsOf(std::span<const PetscInt> nodes) const {
  const int dimension = contact_.mesh->dimension;
  DenseMatrix rows(std::ssize(nodes) * dimension, shapes_.modes.columns());
  for (PetscInt j = 0; j < rows.columns(); ++j)
    for (PetscInt i = 0; i < rows.rows(); ++i)
      rows(i, j) = shapes_.modes(dimension * nodes[i / dimension] + i % dimension, j);
  return rows;
}

/// Returns the surface nodes of this rank with their negative mean square velocities.
std::vector<Observer::Candidate> Observer::byVelocity(const DenseMatrix& meanSquares) const {
  constexpr std::size_t atOnce = 512;
  const auto& mesh = *contact_.mesh;
  std::vector<PetscInt> nodes;
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    if (surface_.has(node)) nodes.push_back(node);
  std::vector<Candidate> result;
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

/// Returns the surface nodes of this rank with their distances from a place.
std::vector<Observer::Candidate> Observer::byDistance(const Point& place) const {
  const auto& mesh = *contact_.mesh;
  std::vector<Candidate> result;
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    if (surface_.has(node)) {
      const Point& x = mesh.coordinates[node];
      result.push_back({mesh::length(mesh::minus(x, place)), x, node});
    }
  return result;
}

/// Collective. Returns the node with the smallest measure of all ranks, with its rows of V. Of
/// nodes that are equal within round-off, it returns the first by coordinates, independent of the
/// number of ranks.
Observer::Observed Observer::observed(const std::vector<Candidate>& own, double tolerance) const {
  const auto& mesh = *contact_.mesh;
  double least = INFINITY;
  for (const auto& candidate : own) least = std::min(least, candidate.measure);
  least = mpi::min(mesh.comm, least);
  std::vector<Candidate> best;
  for (const auto& candidate : own) {
    if (candidate.measure > least + tolerance * std::abs(least)) continue;
    if (best.empty())
      best.push_back(candidate);
    else if (candidate.position < best[0].position)
      best[0] = candidate;
  }
  const Concatenation ranks(mesh.comm, best.size());
  const auto all = ranks.gathered(best);
  const auto first = std::ranges::min_element(all, {}, &Candidate::position);
  Observed result{.point = {.position = first->position},
                  .shape = DenseMatrix(mesh.dimension, shapes_.modes.columns())};
  if (first - all.begin() == ranks.ownBegin() && !best.empty()) {
    result.point.normal = surface_.normals[best[0].node];
    result.shape = rowsOf(std::span(&best[0].node, 1));
  }
  mpi::reduce<double>(mesh.comm, result.point.normal, MPI_SUM);
  mpi::reduce<double>(mesh.comm, result.shape.entries(), MPI_SUM);
  return result;
}

/// Returns the spectrum of the velocity at a node, [line]; empty without samples.
std::vector<Amplitudes> Observer::spectrum(const Observed& node,
                                           const DenseMatrix& velocities) const {
  const PetscInt count = velocities.rows();
  if (count == 0) return {};
  const int dimension = contact_.mesh->dimension;
  std::array<std::vector<double>, 4> signal;  // x, y, z and along the normal
  for (auto& component : signal) component.assign(count, 0);
  for (PetscInt j = 0; j < velocities.columns(); ++j)
    for (int d = 0; d < dimension; ++d)
      for (PetscInt t = 0; t < count; ++t) signal[d][t] += node.shape(d, j) * velocities(t, j);
  for (int d = 0; d < dimension; ++d)
    for (PetscInt t = 0; t < count; ++t) signal[3][t] += node.point.normal[d] * signal[d][t];
  std::vector<Amplitudes> result(count / 2 + 1);
  for (int c = 0; c < 4; ++c) {
    const auto line = amplitudes(signal[c]);
    for (std::size_t k = 0; k < result.size(); ++k) result[k][c] = line[k];
  }
  return result;
}

/// Collective. Returns the points with their spectra, which the rank `root` computes.
std::vector<SpectrumPoint> Observer::spectrumPoints(int root, const Trace& trace,
                                                    const DenseMatrix& meanSquares) const {
  std::vector<SpectrumPoint> points;
  if (surface_.area == 0) return points;
  const auto& places = settings_.spectrumPoints;
  for (std::size_t i = 0; i < std::max<std::size_t>(1, places.size()); ++i) {
    Observed node = places.empty() ? observed(byVelocity(meanSquares), 1e-6)
                                   : observed(byDistance(places[i]), 1e-9);
    node.point.name = places.empty() ? "largest" : std::to_string(i + 1);
    node.point.meanSquareVelocity =
        contraction(node.shape, linalg::product(node.shape, meanSquares));
    node.point.amplitude = spectrum(node, trace.velocities);
    mpi::broadcast(contact_.mesh->comm, node.point.amplitude, root);
    points.push_back(std::move(node.point));
  }
  return points;
}

/// Collective. Returns displacements, gaps and pressures of samples that all ranks have.
Frames Observer::framesOf(const std::vector<Sample>& samples) const {
  Frames frames;
  DenseMatrix q(shapes_.modes.columns()), z(shapes_.responses.columns());
  for (const Sample& sample : samples) {
    frames.time.push_back(sample.time);
    q.append(std::span<const double>(sample.q));
    z.append(std::span<const double>(sample.z));
    std::vector<double> gap(contact_.interfaces.nodes.size()),
        pressure(contact_.interfaces.nodes.size());
    for (std::size_t i = 0; i < shapes_.contactNode.size(); ++i)
      if (const PetscInt own = shapes_.contactNode[i]; own >= 0) {
        gap[own] = sample.gap[i];
        pressure[own] = sample.force[i] / contact_.interfaces.nodes[own].area;
      }
    frames.gap.push_back(contact_.nodalGap(gap));
    frames.pressure.push_back(std::move(pressure));
  }
  if (samples.empty()) return frames;
  frames.displacement = linalg::product(shapes_.modes, q);
  linalg::multiplyAdd(shapes_.responses, z, frames.displacement);
  return frames;
}

VisibleSurface Observer::of(int root, const Trace& trace) const {
  const MPI_Comm comm = contact_.mesh->comm;
  const auto meanSquares = meanSquaresOf(comm, root, trace, shapes_.modes.columns());
  auto samples = trace.samples;
  VisibleSurface result{.sound = soundOf(meanSquares),
                        .points = spectrumPoints(root, trace, meanSquares)};
  broadcast(comm, samples, root);
  result.frames = framesOf(samples);
  return result;
}

}  // namespace squeal::sound
