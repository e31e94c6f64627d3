// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Independent ways to the results of a model.
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "fuzz/models/model.hpp"
#include "fuzz/models/outcome.hpp"

namespace squeal::fuzz {

/// What was found at one model.
struct Judgement {
  std::string failure;  ///< the path and the difference; empty: all agree
  Outcome base;         ///< of the model as it is
  /// By which it was compared, and the wall time of each, s.
  std::vector<std::pair<std::string, double>> paths;
};

/// Collective. Runs a model in one of its forms with some options changed. Files are written to the
/// folder.
Outcome run(const Model& model, const Form& form,
            const std::vector<std::pair<std::string, std::string>>& changes,
            const std::filesystem::path& folder);

/// On one rank. Runs a model, and some of its other ways, which the seed chooses, or all of them.
Judgement judge(const Model& model, bool allPaths, const std::filesystem::path& folder);

}  // namespace squeal::fuzz
