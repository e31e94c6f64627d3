// SPDX-License-Identifier: BSD-2-Clause
#include "model/meshfile/unv.hpp"

#include <petscsys.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <unordered_set>
#include <vector>

#include "base/petsc/check.hpp"
#include "base/system/text.hpp"

namespace squeal::meshfile {
namespace {

using Integer = std::int64_t;

/// Returns the number of nodes of the element types that gmsh reads; 0 for others.
Integer nodesOf(Integer type) {
  static const std::map<Integer, std::vector<Integer>> types{
      {2, {11, 21, 22, 31}},
      {3, {23, 24, 32, 41, 51, 61, 74, 81, 91}},
      {4, {44, 54, 64, 71, 84, 94, 111}},
      {6, {42, 52, 62, 72, 82, 92, 101, 112}},
      {8, {45, 55, 65, 75, 85, 95, 104, 115}},
      {10, {118}},
      {15, {102, 113}},
      {20, {105, 116}}};
  for (const auto& [nodes, list] : types)
    if (std::find(list.begin(), list.end(), type) != list.end()) return nodes;
  return 0;
}

class Unv {
 public:
  /// If `copy` is given, the file is written to it with its groups as gmsh can read them.
  explicit Unv(const std::string& file, std::ostream* copy = nullptr)
      : file_(file), stream_(file, std::ios::binary), copy_(copy) {}

  UnvContents check() {
    while (next()) {
      if (!isMark()) fail("-1 is expected, which begins a section");
      require("the number of a section");
      if (isMark()) require("the number of a section");  // an empty section before
      const Integer section = integers(1, "number of a section")[0];
      if (section == 2467) replace("  2477");  // the same records, which gmsh reads
      contents_.groupsAreRead &= section != 2467;
      if (section == 2411)
        nodes();
      else if (section == 2412)
        elements();
      else if (section == 2435 || section == 2452 || section == 2467 || section == 2477)
        groups();
      else
        while (require("-1, the end of the section"), !isMark()) continue;
    }
    if (nodes_.empty()) fail("there is no section 2411, of nodes, or nothing in it");
    if (elements_.empty()) fail("there is no section 2412, of elements, or nothing in it");
    contents_.nodes = std::ssize(nodes_), contents_.elements = std::ssize(elements_);
    return contents_;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error("option -mesh_file " + file_ + ", line " + std::to_string(number_) + ": " + what);
  }
  /// Moves to the next line that is not empty. Returns false at the end of the file.
  bool next() {
    if (copy_ && number_ > 0) *copy_ << line_ << '\n';
    do ++number_;
    while (std::getline(stream_, line_) && line_.find_first_not_of(" \t\r") == std::string::npos);
    return !stream_.fail();
  }
  /// Puts this text in the place of the line in the copy.
  void replace(const std::string& text) {
    if (copy_) line_ = text;
  }
  void require(const char* what) {
    if (!next()) fail(std::string("the file ends where ") + what + " should be");
  }
  bool isMark() const {
    return line_.compare(0, 6, "    -1") == 0 &&
           line_.find_first_not_of(" \t\r", 6) == std::string::npos;
  }
  std::vector<std::string> words() const {
    std::istringstream text(line_);
    std::vector<std::string> list;
    for (std::string word; text >> word;) list.push_back(word);
    return list;
  }
  template <class Number>
  std::vector<Number> numbers(std::size_t count, const std::string& what) const {
    std::vector<Number> list;
    for (auto word : words()) {
      std::replace(word.begin(), word.end(), 'D', 'E');
      Number value{};
      const char *first = word.data() + (word[0] == '+'), *last = word.data() + word.size();
      const auto [stop, error] = std::from_chars(first, last, value);
      if (error != std::errc() || stop != last)
        fail("'" + word.substr(0, 40) + "' is not a " + what);
      list.push_back(value);
    }
    if (list.size() != count)
      fail(std::to_string(list.size()) + " numbers where there should be " + std::to_string(count));
    return list;
  }
  std::vector<Integer> integers(std::size_t count, const std::string& what) const {
    return numbers<Integer>(count, what);
  }
  void add(std::unordered_set<Integer>& tags, Integer tag, const std::string& what) {
    if (tag < 1 || tag > PETSC_MAX_INT)
      fail(what + " tag " + std::to_string(tag) + ": must be from 1 to " +
           std::to_string(PETSC_MAX_INT));
    if (!tags.insert(tag).second)
      fail("there are two " + what + "s with the tag " + std::to_string(tag));
  }

  void nodes() {
    for (require("a node, or -1"); !isMark(); require("a node, or -1")) {
      const Integer tag = integers(4, "node tag")[0];
      add(nodes_, tag, "node");
      require("a line of coordinates");
      for (double x : numbers<double>(3, "coordinate"))
        if (!(std::abs(x) < 1e100))
          fail("node " + std::to_string(tag) + ": coordinates must be finite, below 1e100");
    }
  }
  void elements() {
    for (require("an element, or -1"); !isMark(); require("an element, or -1")) {
      const auto head = integers(6, "number");
      add(elements_, head[0], "element");
      const Integer nodes = nodesOf(head[1]);
      if (nodes == 0)
        fail("element " + std::to_string(head[0]) + " is of type " + std::to_string(head[1]) +
             ", which gmsh does not read");
      if (nodes != head[5])
        fail("element " + std::to_string(head[0]) + " of type " + std::to_string(head[1]) +
             " has " + std::to_string(nodes) + " nodes, not " + std::to_string(head[5]));
      if (head[1] < 41) require("the orientation of a beam");
      for (Integer left = head[5]; left > 0; left -= 8) {
        require("the nodes of an element");
        for (Integer node : integers(std::min<Integer>(left, 8), "node tag"))
          if (!nodes_.count(node))
            fail("element " + std::to_string(head[0]) + " refers to node " + std::to_string(node) +
                 ", which is not in the file");
      }
    }
  }
  void groups() {
    for (require("a group, or -1"); !isMark(); require("a group, or -1")) {
      const auto head = integers(8, "number");
      require("the name of a group");
      const auto name = words();
      if (name.empty()) fail("a group without a name");
      contents_.groupsAreRead &= name.size() == 1;
      const std::string whole = joined(name, "_");
      if (!groups_.insert(whole).second)
        fail("there are two groups of the name '" + whole + "', with underscores for blanks");
      replace(whole);
      for (Integer left = head[7]; left > 0; left -= 2) {
        require("the members of a group");
        integers(left > 1 ? 8 : 4, "number");
      }
    }
  }

  const std::string& file_;
  std::ifstream stream_;
  std::ostream* copy_;
  UnvContents contents_;
  std::string line_;
  Integer number_ = 0;
  std::unordered_set<Integer> nodes_, elements_;
  std::set<std::string> groups_;
};

}  // namespace

UnvContents requireSoundUnv(const std::string& file) { return Unv(file).check(); }

UnvCopy::UnvCopy(const std::string& file) {
  std::string name = std::filesystem::temp_directory_path() / "squeal_XXXXXX.unv";
  const int descriptor = mkstemps(name.data(), 4);
  if (descriptor < 0)
    throw Error("option -mesh_file " + file + ": its groups must be rewritten for gmsh, and " +
                name + " cannot be made: " + std::strerror(errno));
  close(descriptor);
  path_ = name;
  std::ofstream stream(path_, std::ios::binary);
  Unv(file, &stream).check();
  stream.close();
  if (stream.fail()) {
    std::filesystem::remove(path_);
    throw Error("option -mesh_file " + file + ": its groups must be rewritten for gmsh, and " +
                path_ + " cannot be written");
  }
}

UnvCopy::~UnvCopy() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace squeal::meshfile
