// SPDX-License-Identifier: BSD-2-Clause
// A file of MATLAB's version 5 consists of consecutive elements, each with its type and length. A
// variable is an element of elements, packed by zlib in files that -v7 writes.
#include "problem/matrixfile/matlab5.hpp"

#include <zlib.h>

#include <array>
#include <cinttypes>
#include <limits>

#include "base/petsc/check.hpp"
#include "base/system/text.hpp"

namespace squeal::matrixfile {
namespace {

constexpr std::uint32_t matrixType = 14, packedType = 15, opaqueClass = 17;
constexpr std::uint64_t headerSize = 128, tagSize = 8;

/// The bytes of one element, unpacked.
class Source {
 public:
  Source(BinaryFile& file, std::uint64_t begin, std::uint64_t end, bool packed)
      : file_(file), left_(end - begin), packed_(packed) {
    file_.seek(begin);
    if (packed_ && inflateInit(&stream_) != Z_OK) throw Error("zlib is out of memory");
  }
  ~Source() {
    if (packed_) inflateEnd(&stream_);
  }
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  /// Reads `count` bytes. Throws Error if there are fewer.
  void read(char* to, std::size_t count) {
    if (packed_) return unpack(to, count);
    if (count > left_) throw Error("it is cut short");
    file_.read(to, count);
    left_ -= count;
  }
  /// Returns the next `count` bytes. It allocates memory as bytes arrive, since the given length
  /// may be damaged.
  std::vector<char> take(std::uint64_t count) {
    constexpr std::uint64_t step = 1 << 22;
    std::vector<char> bytes;
    while (bytes.size() < count) {
      const std::size_t had = bytes.size();
      bytes.resize(std::min<std::uint64_t>(count, had + step));
      read(bytes.data() + had, bytes.size() - had);
    }
    return bytes;
  }
  /// Throws Error unless packed bytes end here, with their checksum.
  void finish() {
    if (!packed_) return;
    char surplus = 0;
    if (!atEnd_ && produce(&surplus, 1) == 1) throw Error("it is longer than its header states");
    if (!atEnd_ || left_ > 0 || stream_.avail_in > 0)
      throw Error("its packed bytes do not end where they should");
  }

 private:
  void unpack(char* to, std::size_t count) {
    while (count > 0) {
      const std::size_t got = produce(to, std::min<std::size_t>(count, 1 << 30));
      if (got == 0) throw Error("its packed bytes end too early");
      to += got;
      count -= got;
    }
  }
  std::size_t produce(char* to, std::size_t count) {
    stream_.next_out = reinterpret_cast<Bytef*>(to);
    stream_.avail_out = count;
    while (!atEnd_ && stream_.avail_out > 0) {
      if (stream_.avail_in == 0 && left_ > 0) {
        const std::size_t size = std::min<std::uint64_t>(left_, buffer_.size());
        file_.read(buffer_.data(), size);
        left_ -= size;
        stream_.next_in = reinterpret_cast<Bytef*>(buffer_.data());
        stream_.avail_in = size;
      }
      const int code = inflate(&stream_, Z_NO_FLUSH);
      if (code == Z_STREAM_END) atEnd_ = true;
      if (code == Z_BUF_ERROR) break;  // no byte left to unpack
      if (code != Z_OK && code != Z_STREAM_END) throw Error("its packed bytes are damaged");
    }
    return count - stream_.avail_out;
  }

  BinaryFile& file_;
  std::uint64_t left_;
  bool packed_, atEnd_ = false;
  z_stream stream_{};
  std::vector<char> buffer_ = std::vector<char>(packed_ ? 1 << 16 : 0);
};

/// The elements of one variable, in the order of their source.
class Elements {
 public:
  Elements(BinaryFile& file, const Variable& variable)
      : source_(file, variable.begin, variable.end, variable.packed),
        swapped_(variable.swapped),
        left_(variable.end - variable.begin) {
    if (!variable.packed) return;
    left_ = std::numeric_limits<std::uint64_t>::max();  // until the inner tag defines it
    const Tag tag = nextTag();
    if (tag.type != matrixType) throw Error("no variable in packed bytes");
    left_ = tag.size;
  }

  struct Element {
    std::uint32_t type = 0;
    std::vector<char> bytes;
  };
  Element next() {
    const Tag tag = nextTag();
    Element element{tag.type, {}};
    if (tag.small) {
      element.bytes.assign(tag.data, tag.data + tag.size);
      return element;
    }
    if (tag.size > left_) throw Error("a part is longer than the whole");
    element.bytes = source_.take(tag.size);
    left_ -= tag.size;
    const std::uint64_t padding = std::min((8 - tag.size % 8) % 8, left_);
    source_.take(padding);
    left_ -= padding;
    return element;
  }
  /// Throws Error unless all announced bytes have been read.
  void finish() {
    if (left_ != 0) throw Error("it is longer than its parts");
    source_.finish();
  }

 private:
  struct Tag {
    std::uint32_t type = 0;
    std::uint64_t size = 0;
    bool small = false;
    char data[4] = {};
  };
  /// Reads the next tag. A small element has its length in the upper half of the type, and its
  /// bytes in place of the length.
  Tag nextTag() {
    char bytes[tagSize];
    if (left_ < tagSize) throw Error("it is cut short");
    source_.read(bytes, sizeof bytes);
    left_ -= tagSize;
    const auto first = numberAt<std::uint32_t>(bytes, swapped_);
    Tag tag{first, numberAt<std::uint32_t>(bytes + 4, swapped_), false, {}};
    if (first >> 16 == 0) return tag;
    tag.small = true;
    tag.type = first & 0xffff;
    tag.size = first >> 16;
    if (tag.size > 4) throw Error(formatted("a small part of %u bytes", first >> 16));
    std::copy(bytes + 4, bytes + 8, tag.data);
    return tag;
  }

  Source source_;
  bool swapped_;
  std::uint64_t left_;
};

template <class Stored, class Number>
std::vector<Number> converted(const std::vector<char>& bytes, bool swapped) {
  if (bytes.size() % sizeof(Stored) != 0) throw Error("half a number at the end of a part");
  std::vector<Number> numbers(bytes.size() / sizeof(Stored));
  for (std::size_t k = 0; k < numbers.size(); ++k)
    numbers[k] = numberAt<Stored>(bytes.data() + k * sizeof(Stored), swapped);
  return numbers;
}

/// Returns the numbers of an element, which MATLAB stores in the smallest type that holds them all.
template <class Number>
std::vector<Number> numbersOf(const Elements::Element& element, bool swapped) {
  const auto as = [&](auto stored) {
    return converted<decltype(stored), Number>(element.bytes, swapped);
  };
  switch (element.type) {
    case 1:
      return as(std::int8_t{});
    case 2:
      return as(std::uint8_t{});
    case 3:
      return as(std::int16_t{});
    case 4:
      return as(std::uint16_t{});
    case 5:
      return as(std::int32_t{});
    case 6:
      return as(std::uint32_t{});
    case 12:
      return as(std::int64_t{});
    case 13:
      return as(std::uint64_t{});
    case 7:
      if constexpr (std::is_floating_point_v<Number>) return as(float{});
      break;
    case 9:
      if constexpr (std::is_floating_point_v<Number>) return as(double{});
      break;
    default:
      break;
  }
  throw Error(formatted("numbers of the unknown type %u", element.type));
}

std::vector<long long> shapeOf(const Elements::Element& element, bool swapped) {
  if (element.type != 5) throw Error("its sizes are damaged");
  const auto shape = numbersOf<long long>(element, swapped);
  if (shape.size() < 2) throw Error("its sizes are damaged");
  for (const auto size : shape)
    if (size < 0) throw Error(formatted("a size of %lld", size));
  return shape;
}

/// Reads the header of a variable: flags, sizes (except of an opaque object) and name.
void readHeader(Elements& elements, Variable& variable) {
  const auto flags = elements.next();
  if (flags.type != 6 || flags.bytes.size() != 8) throw Error("its flags are damaged");
  const auto word = numberAt<std::uint32_t>(flags.bytes.data(), variable.swapped);
  const std::uint32_t type = word & 0xff;
  const bool complex = word & 0x800, logical = word & 0x200;
  variable.sparse = type == 5;
  variable.real = !complex && !logical && type >= 5 && type <= 7;
  const std::array<const char*, 18> names{
      "?",     "cell",  "struct", "object", "char",   "sparse", "double", "single",   "int8",
      "uint8", "int16", "uint16", "int32",  "uint32", "int64",  "uint64", "function", "object"};
  variable.kind = std::string(complex ? "complex " : "") + (logical ? "logical " : "") +
                  names[type < names.size() ? type : 0];
  if (type != opaqueClass) variable.shape = shapeOf(elements.next(), variable.swapped);
  const auto name = elements.next();
  if (name.bytes.size() > 4096) throw Error("its name is damaged");
  variable.name.assign(name.bytes.begin(), name.bytes.end());
}

Variable variableAt(BinaryFile& file, std::uint64_t position, bool swapped) {
  if (file.size() - position < tagSize)
    throw Error("the file is truncated in the header of a variable");
  file.seek(position);
  const auto type = file.number<std::uint32_t>(swapped), size = file.number<std::uint32_t>(swapped);
  if (type != matrixType && type != packedType)
    throw Error(formatted("no variable at byte %" PRIu64 ": the file is damaged", position));
  Variable variable;
  variable.begin = position + tagSize;
  variable.end = variable.begin + size;
  variable.packed = type == packedType;
  variable.swapped = swapped;
  if (variable.end > file.size())
    throw Error(formatted("the file is truncated: the variable at byte %" PRIu64
                          " takes %u bytes, %" PRIu64 " are left",
                          position, size, file.size() - variable.begin));
  if (size == 0) return variable;  // an empty matrix
  try {
    Elements elements(file, variable);
    readHeader(elements, variable);
  } catch (const Error& error) {
    throw Error(
        formatted("the variable at byte %" PRIu64 " is damaged: %s", position, error.what()));
  }
  return variable;
}

}  // namespace

std::vector<Variable> variablesOfVersion5(BinaryFile& file) {
  char mark = 0;
  file.seek(126);
  file.read(&mark, 1);
  const bool swapped = (mark == 'I') != littleEndian;
  std::vector<Variable> variables;
  for (std::uint64_t position = headerSize; position < file.size();) {
    Variable variable = variableAt(file, position, swapped);
    position = variable.end;
    if (!variable.name.empty())
      variables.push_back(std::move(variable));  // MATLAB's internal variables have no name
  }
  return variables;
}

Entries readVersion5(BinaryFile& file, const Variable& variable) {
  Variable again = variable;
  Elements elements(file, variable);
  readHeader(elements, again);
  if (!variable.sparse) {
    const auto values = numbersOf<double>(elements.next(), variable.swapped);
    elements.finish();
    if (std::ssize(values) != variable.shape[0] * variable.shape[1])  // less than 2^62
      throw Error(formatted("%zu values in a matrix of %lld x %lld", values.size(),
                            variable.shape[0], variable.shape[1]));
    return full(variable, values);
  }
  Compressed matrix{variable.shape[0], variable.shape[1], true, {}, {}, {}, "jc", "ir"};
  matrix.index = numbersOf<long long>(elements.next(), variable.swapped);
  matrix.begin = numbersOf<long long>(elements.next(), variable.swapped);
  matrix.value = numbersOf<double>(elements.next(), variable.swapped);
  elements.finish();
  matrix.dropFree();
  return matrix.entries();
}

}  // namespace squeal::matrixfile
