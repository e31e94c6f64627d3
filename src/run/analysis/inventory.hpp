// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The supports, loads and joints of a model, for the dry run and the summary.
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "model/mesh/mesh.hpp"
#include "run/analysis/model_settings.hpp"

namespace squeal::analysis {

using Fact = std::variant<std::string, double, std::vector<double>>;

/// A support, load or joint with its properties. The names of quantities end with their units.
struct Item {
  std::string name;
  std::vector<std::pair<std::string, Fact>> facts;
};

/// All items of one kind: supports, loads, references, couplings, equations, springs, bushings,
/// masses or bolts.
struct ItemList {
  std::string kind;
  std::vector<Item> items;
};

/// Collective. Returns the items that the options give, by kind and name. Kinds without items are
/// omitted. The result is the same on all ranks.
std::vector<ItemList> inventory(const mesh::Mesh& mesh, const ModelSettings& settings);

/// Returns an item as one line for the log.
std::string text(const Item& item);

}  // namespace squeal::analysis
