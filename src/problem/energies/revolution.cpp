// SPDX-License-Identifier: BSD-2-Clause
#include "problem/energies/revolution.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "problem/energies/legendre.hpp"
#include "problem/energies/profile.hpp"

namespace squeal::energies {
namespace {

constexpr int mostDiameters = 12;
constexpr std::size_t functions = 12, degrees = 6;  // of ρ and ζ together; of ρ
constexpr int rings = 24;
constexpr double clear = 0.6;         // share from which a name is given
constexpr std::size_t together = 64;  // nodes: factors of products stay in the cache

/// Returns the vectors across the axis, and the one along it.
std::array<Point, 3> axesOf(const Axis& axis) {
  const Point x = mesh::across(axis.direction);
  return {x, mesh::cross(axis.direction, x), axis.direction};
}

/// Returns the number of functions for n nodal diameters: with cos nθ, and with sin nθ.
std::size_t sizeOf(int n) { return n == 0 ? functions : 2 * functions; }

/// Returns the place of the moments of a component for n nodal diameters in their list.
std::size_t placeOf(int n, std::size_t component) {
  const std::size_t before = n == 0 ? 0 : 3 * (functions + 2 * functions * (n - 1));
  return before + component * sizeOf(n);
}

/// The extent of a body about an axis, m.
struct Limits {
  double inner, outer, bottom, top;  // radii, positions along the axis
};

/// Collective.
Limits limitsOf(const mesh::Mesh& mesh, const LumpedBody& body, const Axis& axis) {
  std::array<double, 4> limits{-INFINITY, -INFINITY, -INFINITY, -INFINITY};
  for (const PetscInt node : body.nodes) {
    const Point x = mesh::minus(mesh.coordinates[node], axis.origin);
    const double z = mesh::dot(x, axis.direction),
                 r = mesh::length(mesh::tangential(x, axis.direction));
    limits = {std::max(limits[0], -r), std::max(limits[1], r), std::max(limits[2], -z),
              std::max(limits[3], z)};
  }
  mpi::reduce<double>(mesh.comm, limits, MPI_MAX);
  return {-limits[0], limits[1], -limits[2], limits[3]};
}

}  // namespace

bool isBar(const mesh::Mesh& mesh, const LumpedBody& body, const Axis& axis) {
  const Limits limits = limitsOf(mesh, body, axis);
  return limits.top - limits.bottom > 3 * limits.outer;
}

bool isRevolved(const mesh::Mesh& mesh, const LumpedBody& body, const Axis& axis) {
  const auto axes = axesOf(axis);
  std::array<double, 14> sums{};  // real and imaginary parts for n = 0 … 6
  for (std::size_t k = 0; k < body.nodes.size(); ++k) {
    const Point x = mesh::minus(mesh.coordinates[body.nodes[k]], axis.origin);
    const std::complex<double> arm(mesh::dot(x, axes[0]), mesh::dot(x, axes[1]));
    const double radius = std::abs(arm);
    if (radius == 0) continue;
    std::complex<double> turn = body.mass[k] * radius * radius;
    for (int n = 0; n < 7; ++n, turn *= arm / radius)
      sums[2 * n] += turn.real(), sums[2 * n + 1] += turn.imag();
  }
  mpi::sumAlike(mesh.comm, sums);
  for (int n = 1; n < 7; ++n)
    if (!(std::hypot(sums[2 * n], sums[2 * n + 1]) <= 0.1 * sums[0])) return false;
  return true;
}

Revolution::Revolution(const mesh::Mesh& mesh, LumpedBody body, const Axis& axis)
    : mesh_(mesh), body_(std::move(body)), axes_(axesOf(axis)) {
  std::vector<std::pair<double, double>> meridian;  // radius, position along the axis
  for (const PetscInt node : body_.nodes) {
    const Point x = mesh::minus(mesh.coordinates[node], axis.origin);
    const double a = mesh::dot(x, axes_[0]), b = mesh::dot(x, axes_[1]), r = std::hypot(a, b);
    meridian.emplace_back(r, mesh::dot(x, axes_[2]));
    cosine_.push_back(r > 0 ? a / r : 1);
    sine_.push_back(r > 0 ? b / r : 0);
  }
  const auto [inner, outer, bottom, top] = limitsOf(mesh, body_, axis);
  const auto scaled = [](double x, double from, double to) {
    return to > from ? (2 * x - from - to) / (to - from) : 0.0;
  };
  polynomials_ = linalg::DenseMatrix(meridian.size(), functions);
  for (std::size_t k = 0; k < meridian.size(); ++k) {
    const double rho = scaled(meridian[k].first, inner, outer),
                 zeta = scaled(meridian[k].second, bottom, top);
    const auto p = legendre<degrees>(rho);
    for (std::size_t i = 0; i < degrees; ++i)
      polynomials_(k, i) = p[i], polynomials_(k, degrees + i) = p[i] * zeta;
    ring_.push_back(std::min(rings - 1, int((rho + 1) / 2 * rings)));
  }
  std::vector<linalg::DenseMatrix> grams;
  for (int n = 0; n <= mostDiameters; ++n) grams.emplace_back(sizeOf(n), sizeOf(n));
  for (std::size_t first = 0; first < meridian.size(); first += together) {
    const std::size_t count = std::min(together, meridian.size() - first);
    const auto harmonics = harmonicsOf(first, count);
    for (int n = 0; n <= mostDiameters; ++n) {
      linalg::DenseMatrix values(count, sizeOf(n)), weighted(count, sizeOf(n));
      for (std::size_t i = 0; i < sizeOf(n); ++i)
        for (std::size_t k = 0; k < count; ++k) {
          values(k, i) =
              polynomials_(first + k, i % functions) * harmonics(k, 2 * n + i / functions);
          weighted(k, i) = body_.mass[first + k] * values(k, i);
        }
      linalg::addScaled(grams[n], 1, linalg::transposedProduct(values, weighted));
    }
  }
  for (int n = 0; n <= mostDiameters; ++n) {
    mpi::sumAlike(mesh.comm, {grams[n].data(), sizeOf(n) * sizeOf(n)});
    fits_.emplace_back(std::move(grams[n]));
  }
}

/// Returns cos nθ and sin nθ of some nodes, node × [n][cos, sin].
linalg::DenseMatrix Revolution::harmonicsOf(std::size_t first, std::size_t count) const {
  linalg::DenseMatrix harmonics(count, 2 * mostDiameters + 2);
  const double *cosine = &cosine_[first], *sine = &sine_[first];
  std::ranges::fill(harmonics.column(0), 1.0);
  for (int n = 1; n <= mostDiameters; ++n) {
    const double *c = harmonics.column(2 * n - 2).data(), *s = harmonics.column(2 * n - 1).data();
    double *nextC = harmonics.column(2 * n).data(), *nextS = harmonics.column(2 * n + 1).data();
    for (std::size_t k = 0; k < count; ++k) {
      nextC[k] = c[k] * cosine[k] - s[k] * sine[k];
      nextS[k] = s[k] * cosine[k] + c[k] * sine[k];
    }
  }
  return harmonics;
}

/// Collective. Returns Σ m f u of all functions f and cylindrical components u, and at the end
/// Σ m |u|². The sums over some nodes are a product of matrices: of cos nθ and sin nθ with m p u.
std::vector<double> Revolution::moments(const double* values) const {
  linalg::DenseMatrix products(2 * mostDiameters + 2, 3 * functions);  // [cos, sin of n][u][p]
  double square = 0;
  for (std::size_t first = 0; first < body_.nodes.size(); first += together) {
    const std::size_t count = std::min(together, body_.nodes.size() - first);
    const double *cosine = &cosine_[first], *sine = &sine_[first];
    const auto harmonics = harmonicsOf(first, count);
    linalg::DenseMatrix weighted(count, products.columns()), along(count, 3);  // m u
    for (std::size_t k = 0; k < count; ++k) {
      const double mass = body_.mass[first + k];
      const double* u = values + 3 * body_.nodes[first + k];
      const Point motion{u[0], u[1], u[2]};
      const double a = mesh::dot(motion, axes_[0]), b = mesh::dot(motion, axes_[1]);
      along(k, 0) = mass * (cosine[k] * a + sine[k] * b);
      along(k, 1) = mass * (cosine[k] * b - sine[k] * a);
      along(k, 2) = mass * mesh::dot(motion, axes_[2]);
      square += mass * mesh::dot(motion, motion);
    }
    for (std::size_t component = 0; component < 3; ++component)
      for (std::size_t i = 0; i < functions; ++i) {
        const double *u = along.column(component).data(),
                     *p = polynomials_.column(i).data() + first;
        double* product = weighted.column(functions * component + i).data();
        for (std::size_t k = 0; k < count; ++k) product[k] = u[k] * p[k];
      }
    linalg::addScaled(products, 1, linalg::transposedProduct(harmonics, weighted));
  }
  std::vector<double> sums(placeOf(mostDiameters + 1, 0), 0.0);
  for (int n = 0; n <= mostDiameters; ++n)
    for (std::size_t component = 0; component < 3; ++component)
      for (std::size_t i = 0; i < sizeOf(n); ++i)
        sums[placeOf(n, component) + i] =
            products(2 * n + i / functions, functions * component + i % functions);
  sums.push_back(square);
  mpi::sumAlike(mesh_.comm, sums);
  return sums;
}

/// Collective. Returns the number of nodal circles of the motion along the axis with n nodal
/// diameters, from its mean over rings.
int Revolution::circles(int diameters, const std::vector<std::vector<double>>& moments) const {
  std::vector<double> best;  // coefficients over the meridian at the angle with most motion
  double largest = 0;
  for (const auto& part : moments) {
    const std::size_t first = placeOf(diameters, 2), size = sizeOf(diameters);
    const auto c = fits_[diameters].coefficients(std::span(part).subspan(first, size));
    for (std::size_t begin = 0; begin < size; begin += functions) {
      double square = 0;
      for (std::size_t i = 0; i < functions; ++i) square += c[begin + i] * c[begin + i];
      if (square <= largest) continue;
      largest = square;
      best.assign(c.begin() + begin, c.begin() + begin + functions);
    }
  }
  if (best.empty()) return 0;
  std::array<double, 2 * rings> sums{};  // Σ m u, Σ m
  for (std::size_t k = 0; k < ring_.size(); ++k) {
    double u = 0;
    for (std::size_t i = 0; i < functions; ++i) u += best[i] * polynomials_(k, i);
    sums[ring_[k]] += body_.mass[k] * u, sums[rings + ring_[k]] += body_.mass[k];
  }
  mpi::sumAlike(mesh_.comm, sums);
  std::vector<double> profile;
  for (int ring = 0; ring < rings; ++ring)
    if (sums[rings + ring] > 0) profile.push_back(sums[ring] / sums[rings + ring]);
  return signChanges(profile);
}

NamedMotion Revolution::name(const std::vector<const double*>& parts) const {
  std::vector<std::vector<double>> all;
  double total = 0;
  for (const double* part : parts) {
    all.push_back(moments(part));
    total += all.back().back();
  }
  if (!(total > 0)) return {};
  double best = 0;
  int diameters = 0;
  bool outOfPlane = false;
  std::array<double, 3> shares{};
  for (int n = 0; n <= mostDiameters; ++n) {
    std::array<double, 3> share{};
    for (std::size_t component = 0; component < 3; ++component)
      for (const auto& part : all)
        share[component] +=
            fits_[n].explained(std::span(part).subspan(placeOf(n, component), sizeOf(n))) / total;
    const double inPlane = share[0] + share[1], larger = std::max(inPlane, share[2]);
    // Few nodes around the axis do not tell n from larger numbers.
    if (larger <= best + 1e-6) continue;
    best = larger, diameters = n, outOfPlane = share[2] > inPlane, shares = share;
  }
  if (best < clear) return {};
  if (outOfPlane)
    return {formatted("(%d,%d) out of plane", circles(diameters, all), diameters), best};
  return {formatted("in plane, %s, n = %d", shares[0] >= shares[1] ? "radial" : "circumferential",
                    diameters),
          best};
}

}  // namespace squeal::energies
