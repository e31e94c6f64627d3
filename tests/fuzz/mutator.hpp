// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Damaged files made of sound ones, the same on every machine: the n-th input depends only on the
/// seeds and on n.
#include <cstdint>
#include <string>
#include <vector>

namespace squeal::fuzz {

/// Input `number`: the seeds themselves come first, then one to four changes of one of them: bits
/// and bytes changed, ends cut off, chunks inserted, doubled, taken out or brought from another
/// seed, numbers replaced by awkward ones, in text as well as in binary words of either byte order.
/// At most twice as long as the longest seed and 64 bytes. `seeds`: one at least, none empty.
std::string inputOf(const std::vector<std::string>& seeds, std::uint64_t number);

}  // namespace squeal::fuzz
