// SPDX-License-Identifier: BSD-2-Clause
#include "model/meshfile/msh.hpp"

#include <fcntl.h>
#include <petscsys.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <vector>

#include "base/petsc/check.hpp"
#include "base/system/text.hpp"

namespace squeal::meshfile {
namespace {

using Integer = std::int64_t;

/// A file that is mapped into memory; its pages are loaded when they are read.
class Mapped {
 public:
  explicit Mapped(const std::string& file) {
    const int handle = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    std::error_code failure;
    size_ = std::filesystem::file_size(file, failure);
    if (handle >= 0 && !failure && size_ > 0)
      place_ = mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, handle, 0);
    if (handle >= 0) close(handle);
    if (place_ == MAP_FAILED) throw Error("option -mesh_file " + file + ": cannot be read");
  }
  ~Mapped() { munmap(place_, size_); }
  Mapped(const Mapped&) = delete;
  Mapped& operator=(const Mapped&) = delete;
  std::string_view text() const { return {static_cast<const char*>(place_), size_}; }

 private:
  void* place_ = MAP_FAILED;
  std::size_t size_ = 0;
};

/// Reads words and numbers of the file in turn.
class Reader {
 public:
  Reader(const std::string& file, std::string_view text) : file_(file), text_(text) {}

  bool binary = false, swapped = false;

  [[noreturn]] void fail(const std::string& what) const {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + begin_, '\n');
    throw Error("option -mesh_file " + file_ + ", " +
                (binary ? "byte " + std::to_string(begin_) : "line " + std::to_string(line)) +
                ": " + what);
  }
  /// Returns the next word of text; empty at the end of the file.
  std::string_view word() {
    const char* blanks = " \t\r\n";
    begin_ = std::min(text_.find_first_not_of(blanks, at_), text_.size());
    at_ = std::min(text_.find_first_of(blanks, begin_), text_.size());
    return text_.substr(begin_, at_ - begin_);
  }
  /// Returns a number written as text, which binary files hold too.
  template <class Number>
  Number written(const char* what) {
    const std::string_view token = word();
    const char *first = token.data() + (token.size() > 1 && token[0] == '+'),
               *last = token.data() + token.size();
    Number value{};
    const auto [stop, error] = std::from_chars(first, last, value);
    if (token.empty() || error != std::errc() || stop != last)
      fail(token.empty() ? "the file ends where " + std::string(what) + " should be"
                         : "'" + std::string(token.substr(0, 40)) + "' is not a " + what);
    return value;
  }
  /// Returns an integer, which has 4 bytes (small) or 8 bytes (large) in a binary file.
  Integer small(const char* what) {
    return binary ? raw<std::int32_t>(what) : written<Integer>(what);
  }
  Integer large(const char* what) { return binary ? raw<Integer>(what) : written<Integer>(what); }
  double real(const char* what) { return binary ? raw<double>(what) : written<double>(what); }
  /// Returns the number of items that is promised. Throws Error if the rest of the file cannot hold
  /// them, as each takes at least `least` bytes.
  Integer count(Integer promised, const char* what, Integer least) const {
    const Integer left = text_.size() - at_;
    if (promised < 0 ||
        promised > left / least + 1)  // the last number of a text needs no blank behind it
      fail(std::to_string(promised) + " " + what + " are promised, of which the file, with " +
           std::to_string(left) + " more bytes, cannot hold so many");
    return promised;
  }
  void skipLine() { at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1; }
  /// Returns an integer that begins at the next line of a binary file.
  Integer rawAfterLine() {
    skipLine();
    return raw<std::int32_t>("the number 1");
  }
  /// Moves behind the line that closes a section.
  void skipSection(const std::string& name) {
    const auto end = text_.find("$End" + name, at_);
    if (end == std::string_view::npos)
      fail("the section $" + name + " has no end: the file is cut short");
    at_ = end;
    word();
  }
  void closeSection(const std::string& name) {
    const std::string_view token = word();
    if (token != "$End" + name)
      fail("$End" + name + " is expected, there is " +
           (token.empty() ? "nothing" : "'" + std::string(token.substr(0, 40)) + "'") +
           "; the number in the header of the section does not fit");
  }

 private:
  template <class Number>
  Number raw(const char* what) {
    begin_ = at_;
    if (text_.size() - at_ < sizeof(Number))
      fail("the file ends where " + std::string(what) + " should be");
    std::array<char, sizeof(Number)> bytes;
    std::copy_n(text_.begin() + at_, bytes.size(), bytes.begin());
    if (swapped) std::reverse(bytes.begin(), bytes.end());
    at_ += bytes.size();
    return std::bit_cast<Number>(bytes);
  }

  const std::string& file_;
  std::string_view text_;
  std::size_t at_ = 0, begin_ = 0;  // behind the last number read, and where it began
};

/// Returns the number of nodes of an element type of first or second order, 1 to 19; 0 for others.
int nodesOf(Integer type) {
  constexpr std::array<int, 20> nodes{0, 2,  3,  4,  4,  8, 6, 5,  3,  6,
                                      9, 10, 27, 18, 14, 1, 8, 20, 15, 13};
  return type > 0 && type < std::ssize(nodes) ? nodes[type] : 0;
}

class Msh {
 public:
  Msh(const std::string& file, std::string_view text) : in_(file, text) {}

  MshContents check() {
    header();
    for (std::string_view word = in_.word(); !word.empty(); word = in_.word()) {
      if (word[0] != '$')
        in_.fail("a section is expected, $Nodes or another; there is '" +
                 std::string(word.substr(0, 40)) + "'");
      const std::string name(word.substr(1));
      if (name == "Nodes")
        section(name, nodes_, version_ < 4 ? &Msh::nodes2 : &Msh::nodes4);
      else if (name == "ParametricNodes" && version_ < 4)
        section(name, nodes_, &Msh::parametricNodes2);
      else if (name == "Elements")
        section(name, elements_, version_ < 4 ? &Msh::elements2 : &Msh::elements4);
      else
        in_.skipSection(name);
    }
    if (nodes_.empty()) in_.fail("there is no section $Nodes, or nothing in it");
    if (elements_.empty()) in_.fail("there is no section $Elements, or nothing in it");
    return {version_, std::ssize(nodes_), std::ssize(elements_)};
  }

 private:
  void header() {
    in_.word();
    version_ = in_.written<double>("a version of the format");
    const auto binary = in_.written<Integer>("a file type, 0 or 1"),
               size = in_.written<Integer>("a size of numbers");
    if (!(version_ >= 2 && version_ < 3) && version_ != 4 && version_ != 4.1)
      in_.fail(formatted("version %g of the format is unknown; known are 2 to 2.2, 4 and 4.1",
                         version_));
    if ((binary != 0 && binary != 1) || size != 8)
      in_.fail("the file type must be 0 or 1, the size of numbers 8");
    in_.binary = binary == 1;
    if (in_.binary) in_.swapped = in_.rawAfterLine() != 1;
    in_.closeSection("MeshFormat");
  }

  /// Reads one section with `body`, which fills `tags`; they are sorted then.
  void section(const std::string& name, std::vector<Integer>& tags, void (Msh::*body)()) {
    if (!tags.empty()) in_.fail("there are two sections $" + name);
    (this->*body)();
    in_.closeSection(name);
    if (!std::is_sorted(tags.begin(), tags.end())) std::sort(tags.begin(), tags.end());
    const auto twice = std::adjacent_find(tags.begin(), tags.end());
    if (twice != tags.end())
      in_.fail("$" + name + " has the tag " + std::to_string(*twice) + " twice");
  }
  void add(std::vector<Integer>& tags, Integer tag, const char* what) {
    if (tag < 1 || tag > PETSC_MAX_INT)
      in_.fail(std::string(what) + " tag " + std::to_string(tag) + ": must be from 1 to " +
               std::to_string(PETSC_MAX_INT));
    tags.push_back(tag);
  }
  void coordinates(Integer tag) {
    for (int d = 0; d < 3; ++d) {
      const double x = in_.real("coordinate");
      if (!(std::abs(x) < 1e100))  // the volume of a cell is a product of three
        in_.fail("node " + std::to_string(tag) + " has the coordinate " + shortest(x) +
                 "; must be finite, below 1e100");
    }
  }
  /// Reads the nodes of one element.
  void nodesOfElement(Integer tag, int count) {
    add(elements_, tag, "element");
    const Integer all = nodes_.size();
    const bool dense = all == 0 || nodes_.back() == all;  // 1, 2, 3, …
    for (int i = 0; i < count; ++i) {
      const Integer wanted = version_ < 4 ? in_.small("node tag") : in_.large("node tag");
      if (dense ? wanted < 1 || wanted > all
                : !std::binary_search(nodes_.begin(), nodes_.end(), wanted))
        in_.fail("element " + std::to_string(tag) + " refers to node " + std::to_string(wanted) +
                 ", which is not in the file");
    }
  }
  int knownType(Integer type) {
    if (nodesOf(type) == 0)
      in_.fail("element type " + std::to_string(type) +
               ": must be of first or second order, 1 to 19");
    return nodesOf(type);
  }

  /// Reads the nodes of version 2: their number as text, then tag and coordinates of each. With
  /// `parametric`, dimension and tag of the entity of each follow, and a coordinate on it for each
  /// dimension of a curve or a surface.
  void readNodes2(bool parametric) {
    const Integer least = in_.binary ? 28 + 8 * parametric : 8 + 4 * parametric;
    const Integer count = in_.count(in_.written<Integer>("number of nodes"), "nodes", least);
    if (in_.binary) in_.skipLine();
    for (Integer i = 0; i < count; ++i) {
      add(nodes_, in_.small("node tag"), "node");
      coordinates(nodes_.back());
      if (!parametric) continue;
      const Integer dimension = in_.small("dimension");
      if (dimension < 0 || dimension > 3)
        in_.fail("node " + std::to_string(nodes_.back()) + " is on an entity of dimension " +
                 std::to_string(dimension) + ": must be 0 to 3");
      in_.small("entity");
      for (Integer d = 0; d < dimension && dimension < 3; ++d) in_.real("parametric coordinate");
    }
  }
  void nodes2() { readNodes2(false); }
  void parametricNodes2() { readNodes2(true); }
  /// Reads the elements of version 2: tag, type, number of labels, labels, nodes. In a binary file
  /// a block holds all elements of one type and number of labels.
  void elements2() {
    const Integer count = in_.count(in_.written<Integer>("number of elements"), "elements", 8);
    if (in_.binary) in_.skipLine();
    for (Integer done = 0; done < count;) {
      Integer tag = in_.binary ? 0 : in_.small("element tag"), inBlock = 1;
      const int nodes = knownType(in_.small("element type"));
      if (in_.binary)
        inBlock = in_.count(in_.small("number of elements"), "elements", 4 * (1 + nodes));
      if (inBlock < 1 || inBlock > count - done)
        in_.fail("a block of " + std::to_string(inBlock) + " elements");
      const Integer labels = in_.count(in_.small("number of labels"), "labels", 2);
      for (Integer i = 0; i < inBlock; ++i, ++done) {
        if (in_.binary) tag = in_.small("element tag");
        for (Integer j = 0; j < labels; ++j)
          if (const Integer label = in_.small("label"); label < 0 && j < 2)
            in_.fail("element " + std::to_string(tag) + " has the group or entity " +
                     std::to_string(label) + ", a negative number");
        nodesOfElement(tag, nodes);
      }
    }
  }

  struct Block {
    Integer dimension, entity, third, count;
  };
  /// Reads the numbers of blocks and of items; in version 4.1 also the smallest and largest tag.
  Integer blocks(const char* what, Integer& items) {
    if (in_.binary) in_.skipLine();
    const Integer number = in_.count(in_.large("number of blocks"), "blocks", in_.binary ? 20 : 8);
    items = in_.count(in_.large(what), what, in_.binary ? 16 : 4);
    if (version_ > 4)
      for (int i = 0; i < 2; ++i) in_.large("tag");
    return number;
  }
  Block block(const char* what, Integer least, Integer most) {
    Block block{};
    block.dimension = in_.small("dimension"), block.entity = in_.small("entity");
    if (version_ < 4.1) std::swap(block.dimension, block.entity);
    block.third = in_.small("number");
    block.count = in_.count(in_.large(what), what, least);
    if (block.dimension < 0 || block.dimension > 3)
      in_.fail("dimension " + std::to_string(block.dimension) + ": must be 0 to 3");
    if (block.count > most)
      in_.fail("the blocks of the section hold more than the number in its header");
    return block;
  }
  void requireAll(Integer left, const char* what) {
    if (left != 0)
      in_.fail(std::to_string(left) + " fewer " + what +
               " in the blocks of the section than the number in its header");
  }
  void nodes4() {
    Integer left = 0;
    const Integer number = blocks("nodes", left);
    for (Integer b = 0; b < number; ++b) {
      const Block entity = block("nodes", in_.binary ? 32 : 8, left);
      if (version_ > 4)
        for (Integer i = 0; i < entity.count; ++i) add(nodes_, in_.large("node tag"), "node");
      for (Integer i = 0; i < entity.count; ++i) {
        if (version_ <= 4) add(nodes_, in_.large("node tag"), "node");
        coordinates(nodes_[nodes_.size() - (version_ > 4 ? entity.count - i : 1)]);
        if (entity.third != 0)
          for (Integer d = 0; d < entity.dimension; ++d) in_.real("parametric coordinate");
      }
      left -= entity.count;
    }
    requireAll(left, "nodes");
  }
  void elements4() {
    Integer left = 0;
    const Integer number = blocks("elements", left);
    for (Integer b = 0; b < number; ++b) {
      const Block entity = block("elements", in_.binary ? 16 : 4, left);
      const int nodes = knownType(entity.third);
      for (Integer i = 0; i < entity.count; ++i) nodesOfElement(in_.large("element tag"), nodes);
      left -= entity.count;
    }
    requireAll(left, "elements");
  }

  Reader in_;
  double version_ = 0;
  std::vector<Integer> nodes_, elements_;  // tags, sorted once all are read
};

}  // namespace

MshContents requireSoundMsh(const std::string& file) {
  const Mapped mapped(file);
  return Msh(file, mapped.text()).check();
}

}  // namespace squeal::meshfile
