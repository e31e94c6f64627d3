#include "linalg/symmetric.hpp"

#include <petscsys.h>  // first: the next header needs it

#include <slepcblaslapack.h>

#include <string>

#include "petsc/check.hpp"

namespace squeal::linalg {

std::vector<double> symmetricEigen(std::vector<double>& a, int n) {
  PetscBLASInt order = n, length = -1, integers = -1, info = 0, integerLength = 0;
  std::vector<double> values(n);
  if (n == 0) return values;
  double workLength = 0;
  // Divide and conquer: on some hundred columns several times faster than dsyev, whose rotations
  // (dlasr) are not blocked.
  LAPACKsyevd_("V", "L", &order, a.data(), &order, values.data(), &workLength, &length,
               &integerLength, &integers, &info);
  length = static_cast<PetscBLASInt>(workLength);
  integers = integerLength;
  std::vector<double> work(length);
  std::vector<PetscBLASInt> integerWork(integers);
  LAPACKsyevd_("V", "L", &order, a.data(), &order, values.data(), work.data(), &length,
               integerWork.data(), &integers, &info);
  if (info != 0)
    throw Error("LAPACK dsyevd failed on a matrix of order " + std::to_string(n) + " (info " +
                std::to_string(info) + ")");
  return values;
}

std::vector<double> symmetricEigen(std::vector<double>& a, std::vector<double>& b, int n) {
  PetscBLASInt type = 1, order = n, length = -1, info = 0;
  std::vector<double> values(n), work(1);
  if (n == 0) return values;
  LAPACKsygv_(&type, "V", "L", &order, a.data(), &order, b.data(), &order, values.data(),
              work.data(), &length, &info);
  length = static_cast<PetscBLASInt>(work[0]);
  work.resize(length);
  LAPACKsygv_(&type, "V", "L", &order, a.data(), &order, b.data(), &order, values.data(),
              work.data(), &length, &info);
  if (info != 0)
    throw Error("LAPACK dsygv failed on matrices of order " + std::to_string(n) + " (info " +
                std::to_string(info) + ")");
  return values;
}

}  // namespace squeal::linalg
