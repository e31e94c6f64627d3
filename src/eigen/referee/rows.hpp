// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The verdicts on the entries of a list.
#include "eigen/referee/referee.hpp"

namespace squeal::referee {

/// Not collective. Sets the eigenvalues and the rows of a judgement whose region and count are
/// set. `tolerance` is relative to |s|.
void setRows(std::span<const Complex> list, const std::vector<proof::Enclosure>& discs,
             double tolerance, Judgement& judgement);

}  // namespace squeal::referee
