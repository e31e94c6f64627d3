// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Why a number of eigenvalues is not proved, in words.
#include <string>

#include "eigen/proof/count.hpp"

namespace squeal::proof {

/// The options that change what a proof depends on; an empty name means that there is none.
struct Remedies {
  std::string modes;  ///< number of free modes
  std::string top;    ///< top of the region
  std::string left;   ///< reach of the region to the left of the imaginary axis
  std::string discs;  ///< largest number of expansions
};

/// Returns the reason with the options that help; empty if the count is proved.
std::string reason(const CountProof& count, const Remedies& remedies);

}  // namespace squeal::proof
