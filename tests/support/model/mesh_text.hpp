// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Small meshes as texts of gmsh's format, sound as they stand.
#include <stdexcept>
#include <string>
#include <vector>

namespace squeal::test {

/// The rectangle [0, 2] × [0, 1] of two quadrangles, tags 5 and 6, in the group `layer`; lines 1
/// and 2 below, `bottom`, 3 and 4 above, `top`. Version 2.2.
inline std::string quadranglesMsh2() {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
         "$PhysicalNames\n3\n1 1 \"bottom\"\n1 2 \"top\"\n2 3 \"layer\"\n$EndPhysicalNames\n"
         "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n$EndNodes\n"
         "$Elements\n6\n1 1 2 1 1 1 2\n2 1 2 1 1 2 3\n3 1 2 2 2 4 5\n4 1 2 2 2 5 6\n5 3 2 3 1 1 2 "
         "5 4\n6 3 2 3 1 2 3 6 "
         "5\n$EndElements\n";
}

/// The same in version 4.1.
inline std::string quadranglesMsh4() {
  return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
         "$PhysicalNames\n3\n1 1 \"bottom\"\n1 2 \"top\"\n2 3 \"layer\"\n$EndPhysicalNames\n"
         "$Entities\n0 2 1 0\n1 0 0 0 2 0 0 1 1 0\n2 0 1 0 2 1 0 1 2 0\n1 0 0 0 2 1 0 1 3 2 1 "
         "-2\n$EndEntities\n"
         "$Nodes\n1 6 1 6\n2 1 0 6\n1\n2\n3\n4\n5\n6\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 "
         "0\n$EndNodes\n"
         "$Elements\n3 6 1 6\n1 1 1 2\n1 1 2\n2 2 3\n1 2 1 2\n3 4 5\n4 5 6\n2 1 3 2\n5 1 2 5 4\n6 "
         "2 3 6 5\n$EndElements\n";
}

/// The same as an I-deas universal file.
inline std::string quadranglesUnv() {
  const auto node = [](int tag, int x, int y) {
    return "         " + std::to_string(tag) + "         1         1        11\n   " +
           std::to_string(x) + ".0000000000000000D+00   " + std::to_string(y) +
           ".0000000000000000D+00   0.0000000000000000D+00\n";
  };
  const auto element = [](int tag, int type, const std::vector<int>& nodes) {
    std::string text = "         " + std::to_string(tag) + "        " + std::to_string(type) +
                       "         1         0         7         " + std::to_string(nodes.size()) +
                       "\n" + (type == 21 ? "         0         0         0\n" : "");
    for (int n : nodes) text += "         " + std::to_string(n);
    return text + "\n";
  };
  const auto group = [](int number, const std::string& name, int first, int second) {
    return "         " + std::to_string(number) +
           "         0         0         0         0         0         0         2\n" + name +
           "\n         8         " + std::to_string(first) +
           "         0         0         8         " + std::to_string(second) +
           "         0         0\n";
  };
  return "    -1\n  2411\n" + node(1, 0, 0) + node(2, 1, 0) + node(3, 2, 0) + node(4, 0, 1) +
         node(5, 1, 1) + node(6, 2, 1) + "    -1\n    -1\n  2412\n" + element(1, 21, {1, 2}) +
         element(2, 21, {2, 3}) + element(3, 21, {4, 5}) + element(4, 21, {5, 6}) +
         element(5, 44, {1, 2, 5, 4}) + element(6, 44, {2, 3, 6, 5}) + "    -1\n    -1\n  2477\n" +
         group(1, "bottom", 1, 2) + group(2, "top", 3, 4) + group(3, "layer", 5, 6) + "    -1\n";
}

/// `text` with `was`, which must be there, replaced once.
inline std::string changed(std::string text, const std::string& was, const std::string& is) {
  const auto at = text.find(was);
  if (at == std::string::npos) throw std::logic_error("no '" + was + "' to change");
  return text.replace(at, was.size(), is);
}

}  // namespace squeal::test
