// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Two blocks on each other that are meshed apart, with any cells, as texts of gmsh's format.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "model/element/shape.hpp"
#include "model/mortar/basis.hpp"
#include "support/algebra/dense.hpp"
#include "support/model/model.hpp"

namespace squeal::test {

/// gmsh's numbers of the types of cells.
inline constexpr int hex8 = 5, hex20 = 17, hex27 = 12, wedge6 = 6, wedge15 = 18, wedge18 = 13;
/// Those whose faces in contact are tri3, tri6 (twice), quad4, quad8 and quad9; in the plane line2
/// and line3.
inline const std::vector<int> solidCells{wedge6, wedge15, wedge18, hex8, hex20, hex27};
inline const std::vector<int> planeCells{2, 9, 3, 16, 10};

/// A block [low, high] of cells; the last direction is the height. Grid lines are unequal, and
/// corners inside the block move by up to `jitter` of a cell, across the height in space.
struct Block {
  int cell;
  std::array<int, 3> cells{2, 2, 1};
  mesh::Point low{0, 0, 0}, high{1, 1, 1};
  double jitter = 0.15;
  int mixed = 0;  ///< type of the cells in the second half along x; 0: the same
  std::function<mesh::Point(const mesh::Point&)> map = [](const mesh::Point& x) { return x; };
};

/// Writes blocks as MSH 2.2, with the groups <name>, <name>_low and <name>_high across the height
/// (the last direction), and <name>_x0, _x1, _y0 and _y1 (x alone in the plane).
class BlockWriter {
 public:
  void add(const std::string& name, const Block& block) {
    ++body_;
    block_ = &block;
    const bool plane = isPlane(block.cell);
    const auto groups = [&](const std::string& end) { return group(name + end); };
    dimension_ = plane ? 2 : 3;
    jitter();
    const auto [nx, ny, nz] = block.cells;
    for (int k = 0; k < nz; ++k)
      for (int j = 0; j < (plane ? 1 : ny); ++j)
        for (int i = 0; i < nx; ++i) {
          const int type = block.mixed && 2 * i >= nx ? block.mixed : block.cell;
          column(type, i, j, k, groups(""));
          if (k == 0) facesAcross(type, i, j, 0, groups("_low"));
          if (k + 1 == nz) facesAcross(type, i, j, nz, groups("_high"));
          if (i == 0) side(type, {{{0, j, k}, {0, j + 1, k}}}, groups("_x0"));
          if (i + 1 == nx) side(type, {{{nx, j, k}, {nx, j + 1, k}}}, groups("_x1"));
          if (!plane && j == 0) side(type, {{{i, 0, k}, {i + 1, 0, k}}}, groups("_y0"));
          if (!plane && j + 1 == ny) side(type, {{{i, ny, k}, {i + 1, ny, k}}}, groups("_y1"));
        }
  }
  std::string text() const {
    std::ostringstream out;
    out.precision(17);
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" << groups_.size() << "\n";
    for (const auto& [name, group] : groups_)
      out << (group.isBody ? dimension_ : dimension_ - 1) << " " << group.tag << " \"" << name
          << "\"\n";
    out << "$EndPhysicalNames\n$Nodes\n" << points_.size() << "\n";
    for (std::size_t i = 0; i < points_.size(); ++i)
      out << i + 1 << " " << points_[i][0] << " " << points_[i][1] << " " << points_[i][2] << "\n";
    out << "$EndNodes\n$Elements\n" << elements_.size() << "\n";
    for (std::size_t i = 0; i < elements_.size(); ++i) out << i + 1 << " " << elements_[i] << "\n";
    out << "$EndElements\n";
    return out.str();
  }

 private:
  using Index = std::array<int, 3>;
  struct Group {
    int tag;
    bool isBody;
  };
  static bool isPlane(int cell) {
    return std::find(planeCells.begin(), planeCells.end(), cell) != planeCells.end();
  }
  static bool isTriangular(int cell) {
    return cell == 2 || cell == 9 || cell == wedge6 || cell == wedge15 || cell == wedge18;
  }
  static int faceType(int cell) {
    static const std::map<int, int> types{{wedge6, 2}, {wedge15, 9}, {wedge18, 9}, {hex8, 3},
                                          {hex20, 16}, {hex27, 10},  {2, 1},       {3, 1},
                                          {9, 8},      {16, 8},      {10, 8}};
    return types.at(cell);
  }
  static int sideType(int cell) {
    static const std::map<int, int> types{{wedge6, 3}, {wedge15, 16}, {wedge18, 10}};
    const auto found = types.find(cell);
    return found == types.end() ? faceType(cell) : found->second;
  }
  int group(const std::string& name) {
    const bool isBody = name.find('_') == std::string::npos;
    return groups_.try_emplace(name, Group{int(groups_.size()) + 1, isBody}).first->second.tag;
  }
  void jitter() {
    moved_.clear();
    std::mt19937 generator(block_->cells[0] * 10 + block_->cells[1]);
    const auto& n = block_->cells;
    const bool plane = dimension_ == 2;
    for (int k = 0; k <= (plane ? n[2] : 0); ++k)
      for (int j = 0; j <= (plane ? 0 : n[1]); ++j)
        for (int i = 0; i <= n[0]; ++i) {
          std::array<double, 3> shift{};
          for (auto& s : shift) s = block_->jitter * uniform(generator);
          if (i == 0 || i == n[0]) shift[0] = 0;
          if (plane || j == 0 || j == n[1]) shift[1] = 0;
          if (!plane || k == 0 || k == n[2]) shift[2] = 0;
          moved_[{i, j, k}] = shift;
        }
  }
  /// Corner of the grid.
  mesh::Point at(const Index& index) const {
    const auto& b = *block_;
    const auto& shift = moved_.at({index[0], index[1], dimension_ == 2 ? index[2] : 0});
    mesh::Point x{};
    for (std::size_t d = 0; d < 3; ++d) {
      const double step = (b.high[d] - b.low[d]) / b.cells[d];
      x[d] = b.low[d] + step * (index[d] + shift[d]);
    }
    return x;
  }
  PetscInt node(const mesh::Point& given) {
    mesh::Point x = block_->map(given);
    if (dimension_ == 2) x = {x[0], x[2], 0};
    std::array<long, 4> key{body_};
    for (std::size_t d = 0; d < 3; ++d) key[d + 1] = std::lround(x[d] * 1e8);
    const auto [found, isNew] = nodes_.try_emplace(key, points_.size() + 1);
    if (isNew) points_.push_back(x);
    return found->second;
  }
  /// Nodes at their places in a cell or face with these corners.
  void element(int type, const std::vector<mesh::Point>& corners, int group) {
    const auto& table = element::shapeTable(type);
    std::ostringstream out;
    out << type << " 2 " << group << " " << group;
    for (std::size_t i = 0; i < std::size_t(table.nodes); ++i) {
      mesh::Point x{};
      for (std::size_t c = 0; c < corners.size(); ++c)
        for (std::size_t d = 0; d < 3; ++d)
          x[d] += table.cornerValue[i * corners.size() + c] * corners[c][d];
      out << " " << node(x);
    }
    elements_.push_back(out.str());
  }
  /// The triangles or the quadrilateral of corners a, b, c, d.
  static std::vector<std::vector<Index>> parts(int type, const std::vector<Index>& q, bool turned) {
    if (!isTriangular(type)) return {q};
    if (turned) return {{q[1], q[2], q[3]}, {q[0], q[1], q[3]}};
    return {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}};
  }
  void column(int type, int i, int j, int k, int group) {
    const bool plane = dimension_ == 2;
    const std::vector<Index> q =
        plane ? std::vector<Index>{{i, 0, k}, {i + 1, 0, k}, {i + 1, 0, k + 1}, {i, 0, k + 1}}
              : std::vector<Index>{{i, j, k}, {i + 1, j, k}, {i + 1, j + 1, k}, {i, j + 1, k}};
    for (const auto& part : parts(type, q, (i + j) % 2)) {
      std::vector<mesh::Point> corners;
      for (const auto& index : part) corners.push_back(at(index));
      if (!plane)
        for (const auto& index : part) corners.push_back(at({index[0], index[1], k + 1}));
      element(type, corners, group);
    }
  }
  void facesAcross(int type, int i, int j, int k, int group) {
    if (dimension_ == 2) return element(faceType(type), {at({i, 0, k}), at({i + 1, 0, k})}, group);
    const std::vector<Index> q{{i, j, k}, {i + 1, j, k}, {i + 1, j + 1, k}, {i, j + 1, k}};
    for (const auto& part : parts(type, q, (i + j) % 2)) {
      std::vector<mesh::Point> corners;
      for (const auto& index : part) corners.push_back(at(index));
      element(faceType(type), corners, group);
    }
  }
  void side(int type, const std::array<Index, 2>& foot, int group) {
    std::array<Index, 2> top = foot;
    for (auto& index : top) ++index[2];
    if (dimension_ == 2) return element(faceType(type), {at(foot[0]), at(top[0])}, group);
    element(sideType(type), {at(foot[0]), at(foot[1]), at(top[1]), at(top[0])}, group);
  }

  int body_ = 0, dimension_ = 3;
  const Block* block_ = nullptr;
  std::map<Index, std::array<double, 3>> moved_;
  std::map<std::array<long, 4>, PetscInt> nodes_;
  std::vector<mesh::Point> points_;
  std::map<std::string, Group> groups_;
  std::vector<std::string> elements_;
};

/// Collective. Writes the disc below the pad and returns the options of mesh, materials and of the
/// interface `face` of pad_low and disc_high.
inline std::string blocksApart(const std::string& file, const Block& disc, const Block& pad) {
  BlockWriter writer;
  writer.add("disc", disc);
  writer.add("pad", pad);
  return "-mesh_file " + writeFile(file, writer.text()) + material("disc", "1", "0.3", "1") +
         material("pad", "1", "0.3", "1") +
         " -contact_face_pad pad_low -contact_face_disc disc_high ";
}

}  // namespace squeal::test
