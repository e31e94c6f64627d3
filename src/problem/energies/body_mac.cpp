// SPDX-License-Identifier: BSD-2-Clause
#include "problem/energies/body_mac.hpp"

#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"

namespace squeal::energies {

BodyMac::BodyMac(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                 std::vector<std::vector<PetscInt>> nodes)
    : mesh_(mesh), nodes_(std::move(nodes)) {
  OwnedVec diagonal;
  check(MatCreateVecs(bodies.mass, diagonal.out(), nullptr));
  check(MatGetDiagonal(bodies.mass, diagonal));
  const ReadArray values(diagonal);
  mass_.assign(values.begin(), values.end());
}

std::vector<std::vector<double>> BodyMac::of(
    const std::vector<const double*>& parts,
    const std::vector<std::span<const double>>& motions) const {
  // [body]: uᴴ D u, then for each motion φᵀ D φ and φᵀ D u of each part.
  const std::size_t perMotion = 1 + parts.size(), perBody = 1 + motions.size() * perMotion;
  std::vector<double> sums(nodes_.size() * perBody, 0.0);
  for (std::size_t body = 0; body < nodes_.size(); ++body) {
    double* of = sums.data() + body * perBody;
    for (const PetscInt node : nodes_[body])
      for (int d = 0; d < mesh_.dimension; ++d) {
        const PetscInt row = mesh_.dimension * node + d;
        for (const double* u : parts) of[0] += mass_[row] * u[row] * u[row];
        for (std::size_t m = 0; m < motions.size(); ++m) {
          double* entry = of + 1 + m * perMotion;
          const double force = mass_[row] * motions[m][row];
          *entry++ += force * motions[m][row];
          for (const double* u : parts) *entry++ += force * u[row];
        }
      }
  }
  mpi::sumAlike(mesh_.comm, sums);
  std::vector<std::vector<double>> macs(motions.size(), std::vector<double>(nodes_.size(), 0.0));
  for (std::size_t body = 0; body < nodes_.size(); ++body)
    for (std::size_t m = 0; m < motions.size(); ++m) {
      const double* of = sums.data() + body * perBody;
      const double* entry = of + 1 + m * perMotion;
      double square = 0;
      for (std::size_t part = 0; part < parts.size(); ++part)
        square += entry[1 + part] * entry[1 + part];
      if (square > 0) macs[m][body] = square / (entry[0] * of[0]);
    }
  return macs;
}

}  // namespace squeal::energies
