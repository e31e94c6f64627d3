// SPDX-License-Identifier: BSD-2-Clause
#include "run/report/names.hpp"

#include <regex>

#include "base/system/text.hpp"

namespace squeal::report {

namespace fs = std::filesystem;

namespace {

const std::set<std::string> fixedNames{"eigenvalues.csv",
                                       "branches.csv",
                                       "critical.csv",
                                       "referee.csv",
                                       "critical_sensitivities.csv",
                                       "proof.csv",
                                       "contact_path.csv",
                                       "onset.csv",
                                       "regime.csv",
                                       "regime_nodes.csv",
                                       "regime_cycles.csv",
                                       "regime_spectrum.csv",
                                       "regime_points.csv",
                                       "periodic.csv",
                                       "periodic_branch.csv",
                                       "floquet.csv",
                                       "modes.csv",
                                       "sensitivities.csv",
                                       "friction_work.csv",
                                       "stability_map.csv",
                                       "summary.json",
                                       "options.txt",
                                       "results.h5",
                                       "vtk",
                                       "audit.md",
                                       "reactions.csv",
                                       "components.csv",
                                       "mode_components.csv",
                                       "participation.csv",
                                       "participation_bodies.csv",
                                       "component_modes.csv",
                                       output::Manifest::name};

/// Returns the text between `begin` and `end`; none if the text does not begin and end with them.
std::optional<std::string> between(const std::string& text, const std::string& begin,
                                   const std::string& end) {
  if (text.size() < begin.size() + end.size() || !text.starts_with(begin) || !text.ends_with(end))
    return {};
  return text.substr(begin.size(), text.size() - begin.size() - end.size());
}

bool isNumber(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

/// Returns true for NAME.pvtu, the folder NAME next to it, and the pieces NAME_RANK.vtu in that
/// folder. `parts` are the components of the path from there on.
bool isGrid(const std::string& name, const std::vector<std::string>& parts) {
  if (parts.size() == 1) return parts[0] == name || parts[0] == name + ".pvtu";
  const auto rank = between(parts[1], name + "_", ".vtu");
  return parts.size() == 2 && parts[0] == name && rank && isNumber(*rank);
}

std::vector<std::string> partsOf(const fs::path& path) { return {path.begin(), path.end()}; }

}  // namespace

std::string pointName(const sweep::Parameters& at) {
  std::string name = shortest(at.friction);
  for (const auto& parameter : sweep::allParameters)
    if (parameter.value != &sweep::Parameters::friction && at.*parameter.value != 1)
      name += "_" + std::string(parameter.name) + "_" + shortest(at.*parameter.value);
  return name;
}

ResultNames::ResultNames(const std::vector<sweep::Parameters>& points) {
  for (auto at : points) {
    points_.insert(pointName(at));
    at.damping = 1;  // steady states
    points_.insert(pointName(at));
  }
}

bool ResultNames::contains(const fs::path& path) const {
  const auto parts = partsOf(path);
  if (parts.size() > 1) return parts[0] == "vtk" && isField({parts.begin() + 1, parts.end()});
  if (fixedNames.contains(parts.at(0))) return true;
  for (const char* begin : {"steady_", "modes_"})
    if (const auto point = between(parts[0], begin, ".csv"); point && points_.contains(*point))
      return true;
  return false;
}

/// Returns true for a field of these points; `parts` are the components of its path below vtk.
bool ResultNames::isField(const std::vector<std::string>& parts) const {
  if (parts == std::vector<std::string>{"steady.pvd"}) return true;
  const std::string stem = parts.size() > 1 || !parts[0].ends_with(".pvtu")
                               ? parts[0]
                               : parts[0].substr(0, parts[0].size() - 5);
  if (stem == "materials") return isGrid(stem, parts);
  for (const char* begin : {"steady_friction_", "modes_from_friction_", "complex_modes_friction_"})
    if (const auto point = between(stem, begin, ""); point && points_.contains(*point))
      return isGrid(stem, parts);
  static const std::regex squeal(R"((squeal_friction_(.+)_mode_\d{3,}_\d+_Hz)(\.pvd)?)"),
      cycles(R"((regime_friction_(.+)_start_(?:\d+|all))(\.pvd)?)"),
      means(R"(regime_means_friction_(.+)_start_(?:\d+|all))"), frame(R"((frame_\d{3,})(\.pvtu)?)");
  std::smatch match;
  if (std::regex_match(stem, match, means))
    return points_.contains(match[1]) && isGrid(stem, parts);
  if (!std::regex_match(parts[0], match, squeal) && !std::regex_match(parts[0], match, cycles))
    return false;
  if (!points_.contains(match[2])) return false;
  if (parts.size() == 1) return true;
  return !match[3].matched && std::regex_match(parts[1], match, frame) &&
         isGrid(match[1], {parts.begin() + 1, parts.end()});
}

}  // namespace squeal::report
