// SPDX-License-Identifier: BSD-2-Clause
#include "fuzz/fuzz.hpp"
#include "problem/matrices/read.hpp"

namespace squeal::fuzz {

Target target() {
  const std::string head = "%%MatrixMarket matrix ";
  return {
      "matrix_market",
      ".mtx",
      {head + "coordinate real general\n% comment\n3 3 4\n1 1 4.0\n2 2 5e-1\n3 3 -6.25\n1 3 1e+2\n",
       head + "coordinate integer symmetric\n2 2 2\n1 1 3\n2 1 -4\n",
       head + "coordinate real skew-symmetric\n2 2 1\n2 1 4\n",
       head + "coordinate pattern general\n2 2 2\n1 1\n2 2\n",
       head + "array real general\n2 2\n1\n2.5\n-3\n4e0\n",
       head + "array real symmetric\n2 2\n1\n2\n3\n",
       head + "coordinate real general\r\n2 2 1\r\n\r\n1 2 7\r\n"},
      [](const std::string& path) { matrices::read(PETSC_COMM_WORLD, path); }};
}

}  // namespace squeal::fuzz
