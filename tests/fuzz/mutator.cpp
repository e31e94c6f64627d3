// SPDX-License-Identifier: BSD-2-Clause
#include "fuzz/mutator.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "fuzz/random.hpp"

namespace squeal::fuzz {
namespace {

const std::array<const char*, 26> awkwardNumbers{"-1",
                                                 "0",
                                                 "1",
                                                 "2",
                                                 "-0",
                                                 "2147483647",
                                                 "2147483648",
                                                 "-2147483649",
                                                 "4294967296",
                                                 "9223372036854775807",
                                                 "9223372036854775808",
                                                 "99999999999999999999999",
                                                 "1e308",
                                                 "1e309",
                                                 "-1e400",
                                                 "1e-400",
                                                 "nan",
                                                 "inf",
                                                 "-inf",
                                                 "1.9",
                                                 "4,9",
                                                 "4.0D+2",
                                                 "0x10",
                                                 "+",
                                                 "e5",
                                                 ""};
const std::array<std::uint64_t, 18> awkwardWords{
    0,          1,          2,          3,          127,        128,
    255,        256,        65535,      65536,      2000000000, 0x7fffffff,
    0x80000000, 0xfffffffb, 0xffffffff, 1ULL << 32, ~0ULL >> 1, ~0ULL};

std::size_t chunkLength(Random& random, const std::string& bytes, std::size_t from) {
  return 1 + random.below(std::min<std::size_t>(bytes.size() - from,
                                                random.below(4) == 0 ? bytes.size() : 16));
}

void changeByte(Random& random, std::string& bytes) {
  auto& byte = bytes[random.below(bytes.size())];
  byte = random.below(2) ? static_cast<char>(byte ^ 1 << random.below(8))
                         : static_cast<char>(random.below(256));
}

void cut(Random& random, std::string& bytes) { bytes.resize(random.below(bytes.size())); }

/// Text has no zeros; binary formats have them everywhere.
bool isText(const std::string& bytes) { return bytes.find('\0') == std::string::npos; }

void insert(Random& random, std::string& bytes) {
  const std::string characters = " \n\t0123456789.,-+eEdD%#:'\"[]{}";
  std::string chunk(1 + random.below(8), '\0');
  for (auto& byte : chunk)
    byte = isText(bytes) ? characters[random.below(characters.size())]
                         : static_cast<char>(random.below(256));
  bytes.insert(random.below(bytes.size() + 1), chunk);
}

void duplicate(Random& random, std::string& bytes) {
  const std::size_t from = random.below(bytes.size());
  bytes.insert(random.below(bytes.size() + 1),
               bytes.substr(from, chunkLength(random, bytes, from)));
}

void erase(Random& random, std::string& bytes) {
  const std::size_t from = random.below(bytes.size());
  bytes.erase(from, chunkLength(random, bytes, from));
}

/// Over what is there, or in between.
void splice(Random& random, std::string& bytes, const std::string& other) {
  const std::size_t at = random.below(bytes.size()), from = random.below(other.size());
  if (random.below(2)) {
    bytes = bytes.substr(0, at) + other.substr(from);
    return;
  }
  const std::string chunk = other.substr(from, chunkLength(random, other, from));
  bytes.replace(at, random.below(2) ? std::min(chunk.size(), bytes.size() - at) : 0, chunk);
}

bool ofNumber(char c) {
  return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e' || c == 'E';
}

/// The first number in text from a random place on.
void replaceNumber(Random& random, std::string& bytes) {
  const std::size_t start = random.below(bytes.size());
  const auto begin =
      std::find_if(bytes.begin() + static_cast<std::ptrdiff_t>(start), bytes.end(), ofNumber);
  const auto end = std::find_if_not(begin, bytes.end(), ofNumber);
  bytes.replace(begin, end, awkwardNumbers[random.below(awkwardNumbers.size())]);
}

/// Words of binary formats lie at multiples of 4 as a rule.
void replaceWord(Random& random, std::string& bytes) {
  const std::uint64_t awkward = awkwardWords[random.below(awkwardWords.size())];
  const std::size_t width = random.below(3) == 0 ? 8 : random.below(6) == 0 ? 2 : 4;
  std::string word(reinterpret_cast<const char*>(&awkward),
                   width);  // little-endian on all that we build for
  if constexpr (std::endian::native == std::endian::big) return;
  if (random.below(2)) std::reverse(word.begin(), word.end());
  if (bytes.size() < width) return;
  std::size_t at = random.below(bytes.size() - width + 1);
  if (random.below(8) != 0) at -= at % 4;
  bytes.replace(at, width, word);
}

void change(Random& random, std::string& bytes, const std::string& other) {
  switch (random.below(10)) {
    case 0:
    case 1:
      return changeByte(random, bytes);
    case 2:
      return cut(random, bytes);
    case 3:
      return insert(random, bytes);
    case 4:
      return duplicate(random, bytes);
    case 5:
      return erase(random, bytes);
    case 6:
      return splice(random, bytes, other);
    case 7:
      return replaceNumber(random, bytes);
    default:
      return isText(bytes) ? replaceNumber(random, bytes) : replaceWord(random, bytes);
  }
}

}  // namespace

std::string inputOf(const std::vector<std::string>& seeds, std::uint64_t number) {
  if (number < seeds.size()) return seeds[number];
  Random random(number);
  std::size_t longest = 0;
  for (const auto& seed : seeds) longest = std::max(longest, seed.size());
  std::string bytes = seeds[random.below(seeds.size())];
  for (std::size_t changes = 1 + random.below(4); changes > 0 && !bytes.empty(); --changes) {
    change(random, bytes, seeds[random.below(seeds.size())]);
    bytes.resize(std::min(bytes.size(), 2 * longest + 64));
  }
  return bytes;
}

}  // namespace squeal::fuzz
