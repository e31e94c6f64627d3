// SPDX-License-Identifier: BSD-2-Clause
// Where LAPACK cannot sort a Schur form, the direct method begins again from another vector. The
// failure is a matter of rounding, so this program puts its own dtrexc before that of LAPACK, which
// refuses to swap as often as a test asks it to.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <petscblaslapack.h>

#include <cstring>

#include "eigen/direct/direct.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "support/eigen/mass_chains.hpp"
#include "support/eigen/spectrum.hpp"
#include "support/model/model.hpp"
#include "support/run/case.hpp"

namespace {

int refusals = 0;  // the calls that are still to be refused
int refused = 0;   // the calls that were

/// LAPACK's own dlaqr3 calls dtrexc too, and copes with a refusal.
bool isOfSlepc(const void* caller) {
  Dl_info library{};
  return dladdr(caller, &library) != 0 && std::strstr(library.dli_fname, "libslepc") != nullptr;
}

}  // namespace

/// Does what LAPACK does where two blocks are too close to swap: info is 1 and T is as it was.
extern "C" void dtrexc_(char* compq, PetscBLASInt* n, double* t, PetscBLASInt* ldt, double* q,
                        PetscBLASInt* ldq, PetscBLASInt* from, PetscBLASInt* to, double* work,
                        PetscBLASInt* info) {
  if (refusals > 0 && isOfSlepc(__builtin_return_address(0))) {
    --refusals, ++refused;
    *info = 1;
    return;
  }
  static const auto real = reinterpret_cast<decltype(&dtrexc_)>(dlsym(RTLD_NEXT, "dtrexc_"));
  real(compq, n, t, ldt, q, ldq, from, to, work, info);
}

namespace squeal {
namespace {

using test::Complex;

/// The twenty eigenvalues nearest to zero of chains of 100 masses, undamped and damped, after the
/// first `failures` calls of dtrexc have been refused.
void expectSpectrumAfter(int failures, double alpha) {
  const auto problem = test::chains(100, 2, alpha);
  test::setOptions("-flutter_direct_count 20");
  refusals = failures;
  refused = 0;
  const auto point = direct::solveDirect(problem.pencil(), {0.0, 1.0}, problem.tridiagonal(1, 0),
                                         direct::Settings::given(pencil::Settings::given()));
  EXPECT_EQ(refused, failures);
  auto exact = problem.exact();
  const double last = (1 + 1e-9) * std::abs(exact.at(19));
  std::erase_if(exact, [&](Complex s) { return std::abs(s) > last; });
  EXPECT_EQ(point.eigenvalues.size(), exact.size());
  // As in unit/direct/direct: ten times the tolerance of the solver.
  EXPECT_LT(test::worst(test::errors(exact, test::eigenvaluesOf(point)).relative), 1e-11);
}

TEST(LapackFailure, AnotherStartVectorIsTaken) {
  for (const double alpha : test::alphas)
    for (const int failures : {0, 1, 4}) expectSpectrumAfter(failures, alpha);
}

TEST(LapackFailure, FiveStartVectorsAreEnough) {
  for (const double alpha : test::alphas) {
    const std::string message = test::errorOf([&] { expectSpectrumAfter(5, alpha); });
    EXPECT_NE(message.find("direct method at friction 0: SLEPc fails from each of 5 start vectors: "
                           "Error in LAPACK subroutine trexc: info=1"),
              std::string::npos)
        << message;
  }
  refusals = 0;
}

}  // namespace
}  // namespace squeal
