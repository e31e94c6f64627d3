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

/// A support, load or joint with its properties; names of numbers end in their unit.
struct Item {
  std::string name;
  std::vector<std::pair<std::string, Fact>> facts;
};

/// All items of a kind: supports, loads, references, couplings, equations, springs, bushings,
/// masses, bolts.
struct ItemList {
  std::string kind;
  std::vector<Item> items;
};

/// Collective. Returns the items that the options give, in the order of kinds and names; without
/// kinds that have none. The same on all ranks.
std::vector<ItemList> inventory(const mesh::Mesh& mesh, const ModelSettings& settings);

/// Returns an item in a line for the log.
std::string text(const Item& item);

}  // namespace squeal::analysis
