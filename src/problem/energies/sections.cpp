// SPDX-License-Identifier: BSD-2-Clause
#include "problem/energies/sections.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "problem/energies/legendre.hpp"
#include "problem/energies/profile.hpp"

namespace squeal::energies {
namespace {

constexpr std::size_t degrees = 10;  // of the polynomials: 0 … 9
constexpr double clear = 0.7;        // share from which a name is given

}  // namespace

Sections::Sections(const mesh::Mesh& mesh, LumpedBody body, const Point& centre,
                   const Principal& axes)
    : mesh_(mesh), body_(std::move(body)), axes_(axes) {
  for (const PetscInt node : body_.nodes)
    fromCentre_.push_back(mesh::minus(mesh.coordinates[node], centre));
  for (std::size_t along = 0; along < 2; ++along) {
    std::array<double, 2> limits{-INFINITY, -INFINITY};  // −smallest and largest position
    for (const Point& x : fromCentre_) {
      const double z = mesh::dot(x, axes_.axes[along]);
      limits = {std::max(limits[0], -z), std::max(limits[1], z)};
    }
    mpi::reduce<double>(mesh.comm, limits, MPI_MAX);
    const double length = limits[0] + limits[1];
    lengths_[along] = length > 0 ? length : 1;
    for (const Point& x : fromCentre_) {
      const double z = mesh::dot(x, axes_.axes[along]);
      const auto p = legendre<degrees>(length > 0 ? (2 * z + limits[0] - limits[1]) / length : 0);
      polynomials_[along].insert(polynomials_[along].end(), p.begin(), p.end());
    }
  }
  using enum Family::Kind;
  const bool isFlat = axes.values[2] < 0.16 * axes.values[1];
  if (isFlat)
    families_ = {{bending, "bending", 0, {2}}, {bending, "in-plane bending", 0, {1}}};
  else
    families_ = {{bending, "bending", 0, {1, 2}}};
  families_.push_back({torsion, "torsion", 0});
  families_.push_back({axial, "axial", 0});
  families_.push_back({bending, "cross bending", 1, {2}});
  families_.push_back({torsion, "cross torsion", 1});
  for (auto& family : families_) {
    const std::size_t size = family.size();
    linalg::DenseMatrix gram(size, size);
    for (std::size_t k = 0; k < body_.nodes.size(); ++k) {
      const auto motions = motionsAt(family, k);
      for (std::size_t j = 0; j < size; ++j)
        for (std::size_t i = j; i < size; ++i)
          gram(i, j) += body_.mass[k] * mesh::dot(motions[i], motions[j]);
    }
    mpi::sumAlike(mesh.comm, {gram.data(), size * size});
    family.fit = WeightedFit(std::move(gram));
  }
}

std::size_t Sections::Family::size() const {
  return kind == Kind::bending ? 2 * degrees * across.size() : degrees;
}

/// Returns the motions of a family at a node of the body. Those of a family have the same unit.
std::vector<Point> Sections::motionsAt(const Family& family, std::size_t node) const {
  const double* p = polynomials_[family.along].data() + degrees * node;
  const Point &x = fromCentre_[node], &e = axes_.axes[family.along];
  std::vector<Point> motions;
  const auto add = [&](const Point& direction) {
    for (std::size_t k = 0; k < degrees; ++k) motions.push_back(mesh::scaled(direction, p[k]));
  };
  if (family.kind == Family::Kind::torsion) add(mesh::cross(e, x));
  if (family.kind == Family::Kind::axial) add(e);
  for (const std::size_t across : family.across) {
    const Point& a = axes_.axes[across];
    add(a);
    add(mesh::scaled(e, mesh::dot(a, x) / lengths_[family.along]));
  }
  return motions;
}

/// Returns the number of nodal sections of p(ζ) of the direction that moves most, less one for
/// bending.
int Sections::order(const Family& family, const std::vector<double>& coefficients) const {
  constexpr int points = 100;
  const double* best = coefficients.data();
  for (std::size_t first = 0; first < coefficients.size(); first += 2 * degrees) {
    const double* c = coefficients.data() + first;
    if (std::inner_product(c, c + degrees, c, 0.0) >
        std::inner_product(best, best + degrees, best, 0.0))
      best = c;
  }
  std::vector<double> profile;
  for (int i = 0; i <= points; ++i) {
    const auto p = legendre<degrees>(2.0 * i / points - 1);
    double value = 0;
    for (std::size_t k = 0; k < degrees; ++k) value += best[k] * p[k];
    profile.push_back(value);
  }
  const int count = signChanges(profile);
  return family.kind == Family::Kind::bending ? count - 1 : count;
}

/// Collective. Returns Σ m p·u of the motions p of all families in turn, and at the end Σ m |u|².
std::vector<double> Sections::moments(const double* values) const {
  std::vector<double> sums;
  for (const auto& family : families_) sums.resize(sums.size() + family.size(), 0.0);
  double square = 0;
  for (std::size_t k = 0; k < body_.nodes.size(); ++k) {
    const double* value = values + 3 * body_.nodes[k];
    const Point u{value[0], value[1], value[2]};
    double* sum = sums.data();
    for (const auto& family : families_)
      for (const Point& motion : motionsAt(family, k))
        *sum++ += body_.mass[k] * mesh::dot(motion, u);
    square += body_.mass[k] * mesh::dot(u, u);
  }
  sums.push_back(square);
  mpi::sumAlike(mesh_.comm, sums);
  return sums;
}

NamedMotion Sections::name(const double* values) const {
  const std::vector<double> all = moments(values);
  if (!(all.back() > 0)) return {};
  NamedMotion best;
  auto first = all.begin();
  for (const auto& family : families_) {
    const std::span sums(first, family.size());
    first += family.size();
    const double share = family.fit.explained(sums) / all.back();
    if (share < clear || share <= best.share) continue;
    const int number = order(family, family.fit.coefficients(sums));
    if (number < 1) continue;
    // The lowest torsion of a plate, u = x y, is the same along both axes.
    const bool isLowest = family.kind == Family::Kind::torsion && number == 1;
    best = {isLowest ? "torsion 1" : formatted("%s %d", family.name.c_str(), number), share};
  }
  return best;
}

}  // namespace squeal::energies
