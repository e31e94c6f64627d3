// SPDX-License-Identifier: BSD-2-Clause
#include "model/element/shape.hpp"

#include <array>

#include "base/system/error.hpp"
#include "model/element/tables.hpp"

namespace squeal::element {
namespace {

/// Tables by gmsh's element type; null for those that are not known.
using ByType = std::array<const ShapeTable*, 32>;

ByType sorted(std::span<const ShapeTable> tables) {
  ByType all{};
  for (const auto& table : tables) all.at(table.type) = &table;
  return all;
}

const ShapeTable* find(const ByType& tables, int type) {
  return type >= 0 && type < std::ssize(tables) ? tables[type] : nullptr;
}

const ShapeTable* findFull(int type) {
  static const ByType tables = sorted(fullTables());
  return find(tables, type);
}

}  // namespace

bool isKnown(int gmshType) { return findFull(gmshType) != nullptr; }

const ShapeTable& shapeTable(int gmshType) {
  const ShapeTable* table = findFull(gmshType);
  ensure(table, "an element has a type with a table");
  return *table;
}

const ShapeTable& stiffnessTable(int gmshType) {
  static const ByType tables = sorted(reducedTables());
  const ShapeTable* reduced = find(tables, gmshType);
  return reduced ? *reduced : shapeTable(gmshType);
}

const ShapeTable* underintegratedTable(int gmshType) {
  static const ByType tables = sorted(underintegratedTables());
  return find(tables, gmshType);
}

}  // namespace squeal::element
