// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/pencil/participation.hpp"

#include <algorithm>
#include <numeric>

#include "algebra/linalg/block.hpp"
#include "algebra/linalg/columns.hpp"
#include "base/petsc/arrays.hpp"
#include "base/petsc/object.hpp"
#include "base/system/mpi.hpp"

namespace squeal::pencil {
namespace {

constexpr std::size_t together = 8;  // motions: products with several columns read a matrix once

/// A motion in the coordinates of the free modes.
struct ModalMotion {
  std::vector<Complex> coordinates;  // q, [mode]
  double mass, stiffness;            // xᴴ M0 x, xᴴ K0 x
};

/// Returns the parts of the free modes in a motion with this s.
std::vector<Participation> partsOf(const modes::Modes& modes, Complex s,
                                   const ModalMotion& motion) {
  const auto& [q, mass, stiffness] = motion;
  const double energy = std::norm(s) * mass + stiffness;
  std::vector<Participation> found;
  Complex largest = 0;
  for (std::size_t i = 0; i < q.size(); ++i) {
    if (std::abs(q[i]) > std::abs(largest)) largest = q[i];
    found.push_back({.mode = i,
                     .amplitude = q[i],
                     .energy = (std::norm(s) + modes.lambda[i]) * std::norm(q[i]) / energy,
                     .mac = std::norm(q[i]) / mass});
  }
  const double size = std::abs(largest);
  if (size > 0)
    for (auto& one : found) one.amplitude *= std::conj(largest) / size / std::sqrt(mass);
  return found;
}

/// Collective. Returns the modal coordinates of some motions, [motion].
std::vector<ModalMotion> modalMotions(const modes::Modes& modes,
                                      const factor::AssociatedSystem& system,
                                      std::span<const ComplexMotion> motions) {
  const MPI_Comm comm = commOf(system.m0());
  PetscInt rows = 0;
  check(MatGetLocalSize(system.m0(), &rows, nullptr));
  linalg::Block x(rows), inertia(rows), elastic(rows);
  for (const auto& motion : motions)
    for (const Vec part : {motion.x->real.get(), motion.x->imaginary.get()})
      x.append(ReadArray(part));
  linalg::appendProduct(system.m0(), x, inertia);
  linalg::appendProduct(system.k0(), x, elastic);
  std::vector<double> forms;  // [column] xᵀ M0 x, xᵀ K0 x
  for (PetscInt j = 0; j < x.columns(); ++j)
    for (const auto* y : {&inertia, &elastic}) {
      const std::span<const double> a = x.column(j), b = y->column(j);
      forms.push_back(std::inner_product(a.begin(), a.end(), b.begin(), 0.0));
    }
  mpi::sumAlike(comm, forms);
  const PetscInt count = modes.angularFrequency.size();
  linalg::DenseMatrix q(count, x.columns());
  if (count > 0) {
    const linalg::ReadColumns vectors(modes.vectors);
    q = linalg::transposedProduct(comm, vectors.view().columnRange(0, count), inertia);
  }
  std::vector<ModalMotion> found;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const double* form = &forms[4 * i];
    found.push_back({{}, form[0] + form[2], form[1] + form[3]});
    for (PetscInt mode = 0; mode < count; ++mode)
      found.back().coordinates.emplace_back(q(mode, 2 * i), q(mode, 2 * i + 1));
  }
  return found;
}

}  // namespace

std::vector<std::vector<Participation>> participations(const modes::Modes& modes,
                                                       const factor::AssociatedSystem& system,
                                                       std::span<const ComplexMotion> motions) {
  std::vector<std::vector<Participation>> found;
  for (std::size_t first = 0; first < motions.size(); first += together) {
    const auto some = motions.subspan(first, std::min(together, motions.size() - first));
    const auto modal = modalMotions(modes, system, some);
    for (std::size_t i = 0; i < some.size(); ++i)
      found.push_back(partsOf(modes, some[i].s, modal[i]));
  }
  return found;
}

}  // namespace squeal::pencil
