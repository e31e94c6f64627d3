#include "eigen/pencil/modal_damping.hpp"

#include <algorithm>
#include <cmath>

#include "base/options/options.hpp"

namespace squeal::pencil {
namespace {

const RealListOption modalOption("flutter", "flutter_modal_damping", "0", "", nonNegative,
                                 "damping ratios of the free modes in order, the last one for all "
                                 "that follow; reduced method alone");

}  // namespace

bool modalDampingWanted() {
  const auto ratios = modalOption.get();
  return std::any_of(ratios.begin(), ratios.end(), [](double ratio) { return ratio > 0; });
}

std::vector<Term> modalDamping(const modes::Modes& modes, Mat mass) {
  std::vector<Term> terms;
  if (!modalDampingWanted()) return terms;
  const auto ratios = modalOption.get();
  PetscInt local = 0, global = 0;
  const PetscInt count = modes.angularFrequency.size();
  check(BVGetSizes(modes.vectors, &local, &global, nullptr));
  OwnedMat factors, product;
  check(MatCreateDense(PetscObjectComm(reinterpret_cast<PetscObject>(mass)), local, PETSC_DECIDE,
                       global, count, nullptr, factors.out()));
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
