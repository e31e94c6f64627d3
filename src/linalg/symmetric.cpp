#include "linalg/symmetric.hpp"

#include <petscsys.h>  // first: the next header needs it

#include <slepcblaslapack.h>

#include <string>

#include "linalg/lapack.hpp"
#include "petsc/check.hpp"

namespace squeal::linalg {

std::vector<double> symmetricEigen(DenseMatrix& a) {
  PetscBLASInt order = a.rows(), length = -1, integers = -1, info = 0, integerLength = 0;
  std::vector<double> values(order);
  if (order == 0) return values;
  double workLength = 0;
  // Divide and conquer: on some hundred columns several times faster than dsyev, whose rotations
  // (dlasr) are not blocked.
  LAPACKsyevd_("V", "L", &order, a.data(), &order, values.data(), &workLength, &length,
               &integerLength, &integers, &info);
  length = workLength;
  integers = integerLength;
  std::vector<double> work(length);
  std::vector<PetscBLASInt> integerWork(integers);
  LAPACKsyevd_("V", "L", &order, a.data(), &order, values.data(), work.data(), &length,
               integerWork.data(), &integers, &info);
  if (info != 0)
    throw Error("LAPACK dsyevd failed on a matrix of order " + std::to_string(order) + " (info " +
                std::to_string(info) + ")");
  return values;
}

std::vector<double> symmetricEigen(DenseMatrix& a, DenseMatrix& b) {
  PetscBLASInt type = 1, order = a.rows(), info = 0;
  std::vector<double> values(order);
  if (order == 0) return values;
  callWithWork([&](double* work, PetscBLASInt length) {
    LAPACKsygv_(&type, "V", "L", &order, a.data(), &order, b.data(), &order, values.data(), work,
                &length, &info);
  });
  if (info != 0)
    throw Error("LAPACK dsygv failed on matrices of order " + std::to_string(order) + " (info " +
                std::to_string(info) + ")");
  return values;
}

}  // namespace squeal::linalg
