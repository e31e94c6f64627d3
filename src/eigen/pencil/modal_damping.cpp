// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/pencil/modal_damping.hpp"
#include "base/petsc/object.hpp"

#include <algorithm>
#include <cmath>

namespace squeal::pencil {
std::vector<Term> modalDamping(const modes::Modes& modes, Mat mass,
                               const std::vector<double>& ratios) {
  std::vector<Term> terms;
  if (std::ranges::none_of(ratios, [](double ratio) { return ratio > 0; })) return terms;
  PetscInt local = 0, global = 0;
  const PetscInt count = modes.angularFrequency.size();
  check(BVGetSizes(modes.vectors, &local, &global, nullptr));
  OwnedMat factors, product;
  check(MatCreateDense(commOf(mass), local, PETSC_DECIDE, global, count, nullptr, factors.out()));
  for (PetscInt i = 0; i < count; ++i) {
    Vec d = nullptr, column = nullptr;
    check(BVGetColumn(modes.vectors, i, &d));
    check(MatDenseGetColumnVecWrite(factors, i, &column));
    check(MatMult(mass, d, column));
    check(VecScale(column, std::sqrt(2 * ratios[std::min<std::size_t>(i, ratios.size() - 1)] *
                                     modes.angularFrequency[i])));
    check(MatDenseRestoreColumnVecWrite(factors, i, &column));
    check(BVRestoreColumn(modes.vectors, i, &d));
  }
  check(MatCreateLRC(nullptr, factors, nullptr, nullptr, product.out()));
  check(MatSetOption(product, MAT_SYMMETRIC, PETSC_TRUE));
  terms.push_back({std::move(product), 1, 0, 1.0, 0, 1});
  return terms;
}

}  // namespace squeal::pencil
