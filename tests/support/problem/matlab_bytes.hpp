// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// MATLAB files of versions 4 and 5, byte by byte as MATLAB writes them: numbers in the smallest
/// type that holds them, either byte order.
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace squeal::test {

/// Numbers one after the other, in either byte order.
class Bytes {
 public:
  explicit Bytes(bool big = false) : big_(big) {}
  template <class Number>
  Bytes& add(Number number) {
    std::string bytes(reinterpret_cast<const char*>(&number), sizeof number);
    if (big_) std::reverse(bytes.begin(), bytes.end());
    text_ += bytes;
    return *this;
  }
  template <class Number>
  Bytes& addAll(const std::vector<double>& numbers) {
    for (const double number : numbers) add(static_cast<Number>(number));
    return *this;
  }
  Bytes& append(const std::string& bytes) {
    text_ += bytes;
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  bool big_;
  std::string text_;
};

/// A variable of version 4. `type`: 10 times that of the values (0: double), and 0 for a full, 1
/// for a text, 2 for a sparse matrix.
inline std::string version4(bool big, int type, std::int32_t rows, std::int32_t columns,
                            const std::string& name, const std::vector<double>& values) {
  Bytes bytes(big);
  for (const std::int32_t word :
       {(big ? 1000 : 0) + type, rows, columns, 0, static_cast<std::int32_t>(name.size() + 1)})
    bytes.add(word);
  return bytes.append(name).append(std::string(1, '\0')).addAll<double>(values).text();
}

/// An element of type, length, content and padding.
inline std::string element(bool big, std::uint32_t type, const std::string& content) {
  const auto size = static_cast<std::uint32_t>(content.size());
  if (size <= 4 && size > 0)
    return Bytes(big).add(type | size << 16).append(content + std::string(4 - size, '\0')).text();
  return Bytes(big)
      .add(type)
      .add(size)
      .append(content + std::string((8 - size % 8) % 8, '\0'))
      .text();
}

/// `flags`: the class, and 0x800 for complex, 0x200 for logical.
inline std::string variable5(bool big, std::uint32_t flags, const std::vector<double>& shape,
                             const std::string& name, const std::string& parts) {
  return element(big, 14,
                 element(big, 6, Bytes(big).add(flags).add(std::uint32_t{1}).text()) +
                     element(big, 5, Bytes(big).addAll<std::int32_t>(shape).text()) +
                     element(big, 1, name) + parts);
}

inline std::string header5(bool big) {
  std::string text = "MATLAB 5.0 MAT-file, Platform: GLNXA64, Created on: Mon Jan 1 00:00:00 2024";
  text.resize(124, ' ');
  return Bytes(big).append(text).add(std::uint16_t{0x0100}).append(big ? "MI" : "IM").text();
}

/// [[2, 0], [1, 3]]: the rows of its columns in 32-bit integers, the values, whole numbers, in
/// bytes.
inline std::string sparse5(bool big, const std::string& name) {
  return variable5(big, 5, {2, 2}, name,
                   element(big, 5, Bytes(big).addAll<std::int32_t>({0, 1, 1}).text()) +
                       element(big, 5, Bytes(big).addAll<std::int32_t>({0, 2, 3}).text()) +
                       element(big, 2, Bytes(big).addAll<std::uint8_t>({2, 1, 3}).text()));
}

inline std::string full5(bool big, const std::string& name) {
  return variable5(big, 6, {2, 2}, name,
                   element(big, 4, Bytes(big).addAll<std::uint16_t>({2, 1, 0, 3}).text()));
}

}  // namespace squeal::test
