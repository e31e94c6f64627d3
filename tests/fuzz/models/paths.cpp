// SPDX-License-Identifier: BSD-2-Clause
#include "fuzz/models/paths.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>

#include "base/options/settings.hpp"
#include "base/petsc/check.hpp"
#include "base/system/text.hpp"
#include "fuzz/models/compare.hpp"
#include "fuzz/random.hpp"
#include "run/analysis/analysis.hpp"

namespace squeal::fuzz {
namespace {

using Changes = std::vector<std::pair<std::string, std::string>>;

/// Collective. Writes a file on rank 0.
void writeFile(const std::filesystem::path& path, const std::string& text) {
  onFirstRank(PETSC_COMM_WORLD, "", [&] {
    std::ofstream file(path, std::ios::binary);
    file << text;
    if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
  });
}

/// The direct method finds all eigenvalues, by LAPACK where the problem is small.
const Changes direct{
    {"flutter_method", "direct"}, {"flutter_direct_count", "450"}, {"flutter_track", "off"}};

/// A way to compare by: returns the difference.
struct Path {
  std::string name;
  std::function<std::string()> difference;
};

class Paths {
 public:
  Paths(const Model& model, const std::filesystem::path& folder, const Outcome& base)
      : model_(model), folder_(folder), base_(base), random_(model.seed + 77) {}

  std::vector<Path> all() {
    std::vector<Path> paths;
    const auto add = [&](const std::string& name, std::function<std::string()> difference) {
      paths.push_back({name, std::move(difference)});
    };
    if (!model_.modalDamping) {
      add("direct", [this] { return compared({}, direct, {.criticals = false}); });
      add("direct_band", [this] { return directBand(); });
    }
    add("own_basis", [this] { return compared({}, {{"flutter_released", "0"}}, {}); });
    add("steady_full", [this] { return steadyFull(); });
    add("single", [this] { return single(); });
    add("shuffled", [this] { return compared({true, 0, {}}, {}, {}); });
    if (model_.mesh.dimension == 3)
      add("turned", [this] { return compared({false, random_.between(1, 2), {}}, {}, {}); });
    if (model_.glue) add("bond", [this] { return otherBond(); });
    if (!model_.modalDamping && base_.followed && !base_.criticals.empty())
      add("around_critical", [this] { return aroundCriticals(); });
    return paths;
  }

 private:
  std::string compared(const Form& form, const Changes& changes, const Extent& extent) {
    return difference(base_, run(model_, form, changes, folder_), extent);
  }

  /// Where steady sliding is not unique, the way of the contact decides, which is not followed in
  /// all unknowns. SNES may end without a solution, and says so; the state that the default finds
  /// is judged by its residual in all unknowns, which is down to some 1e-11 of the loads in both:
  /// convective terms depend on the state.
  std::string steadyFull() {
    if (!std::ranges::all_of(base_.steady, &FoundSteady::unique)) return "";
    const auto found = [&](const std::string& full) {
      return run(model_, {}, {{"steady_path", "0"}, {"steady_full", full}}, folder_);
    };
    return difference(found("off"), found("on"),
                      {.criticals = false, .mayMiss = true, .state = 1e-10});
  }

  std::string directBand() {
    double top = 0;
    for (const auto& point : base_.points) top = std::max(top, point.top);
    if (!(top > 0 && std::isfinite(top))) return "";
    Changes changes = direct;
    changes[1].second = "10";
    changes.emplace_back("flutter_direct_band", formatted("0,%.9g", 1.01 * top / (2 * M_PI)));
    const Outcome found = run(model_, {}, changes, folder_);
    // Where SLEPc does not converge, that point is missing, or, if it is the only one, all.
    if (found.refusal.starts_with("direct method at ")) return "";
    return difference(base_, found, {.criticals = false, .mayMiss = true});
  }

  /// Each friction by itself; two of them, since each is a run.
  std::string single() {
    for (const double friction :
         {model_.frictions.back(), model_.frictions[random_.below(model_.frictions.size())]}) {
      const Outcome found =
          run(model_, {}, {{"flutter_friction", formatted("%.9g", friction)}}, folder_);
      // Of a sweep that has results at other points, the same is a failure of this point.
      const auto isSame = [&](const std::string& failure) {
        return failure.ends_with(": " + found.refusal);
      };
      if (!found.refusal.empty() && std::ranges::any_of(base_.failures, isSame)) continue;
      auto text =
          difference(base_, found, {.sameSweep = false, .criticals = false, .sameWay = false});
      if (!text.empty()) return text;
    }
    return "";
  }

  std::string otherBond() {
    const Bond own = model_.glue->form;
    std::vector<Bond> others;
    for (int i = 0; i < bondForms; ++i)
      if (Bond(i) != own) others.push_back(Bond(i));
    const Bond form = others[random_.below(others.size())];
    const Outcome other = run(model_, {false, 0, form}, {}, folder_);
    // An edge that another tie shares: the program warns that some of its nodes are not tied here,
    // and the forms differ in these.
    if (model_.has("tie apart") && base_.lost + other.lost > 0) return "";
    const auto found = difference(base_, other, {});
    return found.empty() ? "" : std::string(text(own)) + " against " + text(form) + ": " + found;
  }

  /// The direct method on both sides of a critical friction has one more unstable eigenvalue on one
  /// of them.
  std::string aroundCriticals() {
    int checked = 0;
    for (const auto& c : base_.criticals) {
      if (!c.converged || c.kind == 3 || checked == 2) continue;
      const double step = stepFrom(c);
      const double low = c.at.friction - step, high = c.at.friction + step;
      if (step == 0 || low < model_.frictions.front() || high > model_.frictions.back()) continue;
      ++checked;
      const int below = unstableAt(c, low), above = unstableAt(c, high);
      if (below < 0 || above < 0 || above - below == (c.loss ? 1 : -1)) continue;
      return formatted(
          "critical friction %.10g (%s, %.6g rad/s): the direct method has %d and %d "
          "unstable eigenvalues near it at %.10g and %.10g",
          c.at.friction, c.loss ? "loss" : "regain", c.angularFrequency, below, above, low, high);
    }
    return "";
  }

  /// Far enough for a growth of 3e-5 |s| and nearer than half way to other critical frictions.
  double stepFrom(const FoundCritical& c) const {
    const double growth = 3e-5 * std::max(c.angularFrequency, 1.0);
    const double slope = std::abs(c.slope);
    double step = c.kind == 1 ? growth / slope : growth * growth / slope;
    step = std::max({step, 10 * c.error, 1e-7});
    double nearest = 1;
    for (const auto& other : base_.criticals)
      if (&other != &c) nearest = std::min(nearest, std::abs(other.at.friction - c.at.friction));
    return std::isfinite(step) && step < 0.25 * nearest && step < 0.01 ? step : 0;
  }

  /// The number of unstable eigenvalues of a frequency within a hundredth of the critical one; −1
  /// if it cannot be determined.
  int unstableAt(const FoundCritical& c, double friction) {
    Changes changes = direct;
    changes.emplace_back("flutter_friction", formatted("%.17g", friction));
    changes.emplace_back("flutter_speed", formatted("%.17g", c.at.speed));
    changes.emplace_back("flutter_pressure", formatted("%.17g", c.at.pressure));
    changes.emplace_back("flutter_damping", formatted("%.17g", c.at.damping));
    const Outcome found = run(model_, {}, changes, folder_);
    if (!found.refusal.empty() || found.points.empty()) return -1;
    if (changesBack(found.steady.front())) return -1;
    int count = 0;
    for (const auto& e : found.points.front().eigenvalues)
      count += e.unstable &&
               std::abs(e.s.imag() - c.angularFrequency) < 0.01 * std::max(c.angularFrequency, 1.0);
    return count;
  }

  /// True where the points on both sides have the same numbers of open and released nodes, and the
  /// one between them has others: two changes of one node between two points are not seen.
  bool changesBack(const FoundSteady& between) const {
    const FoundSteady *below = nullptr, *above = nullptr;
    for (const auto& one : base_.steady) {
      sweep::Parameters at = one.at;
      at.friction = between.at.friction;
      if (at != between.at) continue;
      if (one.at.friction <= between.at.friction) below = &one;
      if (one.at.friction >= between.at.friction && !above) above = &one;
    }
    const auto counts = [](const FoundSteady& one) { return std::pair(one.open, one.released); };
    return below && above && counts(*below) == counts(*above) && counts(between) != counts(*below);
  }

  const Model& model_;
  const std::filesystem::path& folder_;
  const Outcome& base_;
  Random random_;
};

}  // namespace

Outcome run(const Model& model, const Form& form, const Changes& changes,
            const std::filesystem::path& folder) {
  const Written files = written(model, form);
  const auto mesh = folder / "model.msh";
  writeFile(mesh, files.mesh);
  Outcome outcome;
  try {
    clearOptions();
    std::vector<Setting> settings{{"quiet", "", "", 0}, {"mesh_file", mesh.string(), "", 0}};
    for (const auto* list : {&files.options, &changes})
      for (const auto& [name, value] : *list) {
        std::erase_if(settings, [&](const auto& one) { return one.name == name; });
        settings.push_back({name, value, "", 0});
      }
    insert(settings);
    return outcomeOf(analysis::analyse(PETSC_COMM_WORLD, analysis::Settings::given()));
  } catch (const Error& error) {
    outcome.refusal = error.what();
  }
  return outcome;
}

Judgement judge(const Model& model, bool allPaths, const std::filesystem::path& folder) {
  Judgement judgement;
  judgement.base = run(model, {}, {}, folder);
  auto paths = Paths(model, folder, judgement.base);
  auto all = paths.all();
  Random random(model.seed + 5);
  // The direct method makes no free modes, and so does not refuse all that the reduced one does.
  if (!judgement.base.refusal.empty())
    std::erase_if(all, [](const auto& path) { return path.name != "shuffled"; });
  if (!allPaths)
    while (all.size() > 3) all.erase(all.begin() + random.below(all.size()));
  for (const auto& path : all) {
    const double begin = MPI_Wtime();
    const std::string difference = path.difference();
    judgement.paths.emplace_back(path.name, MPI_Wtime() - begin);
    if (difference.empty()) continue;
    judgement.failure += (judgement.failure.empty() ? "" : "\n") + path.name + ": " + difference;
    if (!allPaths) break;
  }
  return judgement;
}

}  // namespace squeal::fuzz
