// SPDX-License-Identifier: BSD-2-Clause
#include "fuzz/models/compare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/system/text.hpp"

namespace squeal::fuzz {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Rounding of both runs. A stiffness that is known to ε of its entries moves s by
///   |δs|/|s| ≤ κ ε (1 + Ω²/|s|²),
/// with Ω the bound of the frequencies of the mesh; sums of some hundred entries, in another order,
/// make it a few times as much. Near another eigenvalue at the distance d the condition κ is at
/// most about |s|/d, and as d is of the order of δs where two meet, |δs| max(d, |δs|) is bounded.
constexpr double safety = 20;

/// An eigenvalue, the distance to its nearest neighbour, and the error that it is allowed.
struct Judged {
  const FoundEigenvalue* e;
  double isolation, estimate;
};

std::vector<Judged> judged(const FoundPoint& point, double rounding) {
  std::vector<Judged> all;
  for (const auto& e : point.eigenvalues) {
    const double size = std::abs(e.s);
    double isolation = std::max(size, std::abs(2 * e.s.imag()));
    for (const auto& other : point.eigenvalues)
      if (&other != &e) isolation = std::min(isolation, std::abs(other.s - e.s));
    if (e.s.imag() > 0) isolation = std::min(isolation, 2 * e.s.imag());
    // The direct method has no estimate: its backward error times the condition takes its place.
    const double estimate = std::isnan(e.estimate)
                                ? std::max(e.backwardError - epsilon, 0.0) * rounding / epsilon
                                : e.estimate;
    all.push_back({&e, isolation, estimate * size});
  }
  return all;
}

std::string text(Complex s) { return formatted("%.12g%+.12gi", s.real(), s.imag()); }

class PointComparison {
 public:
  PointComparison(const FoundPoint& first, const FoundPoint& second, double stiffest, double state)
      : first_(first), second_(second), stiffest_(stiffest), state_(state) {
    top_ = std::min(reach(first), reach(second));
  }

  std::string difference() const {
    for (const bool back : {false, true}) {
      const FoundPoint &a = back ? second_ : first_, &b = back ? first_ : second_;
      const auto other = matched(a, b);
      for (std::size_t i = 0; i < a.eigenvalues.size(); ++i) {
        const auto& e = a.eigenvalues[i];
        const std::string where = "at " + sweep::parameterText(a.at) + ": ";
        if (!counts(e)) continue;
        if (other[i] < 0)
          return where + "eigenvalue " + text(e.s) + " has no counterpart in the " +
                 (back ? "first" : "second") + " run";
        const auto& match = b.eigenvalues[other[i]];
        const double allowed = allowance(a, b, i, other[i]);
        if (!(std::abs(e.s - match.s) <= allowed))
          return where + formatted("eigenvalues %s and %s differ by %.2e of |s|, allowed %.2e",
                                   text(e.s).c_str(), text(match.s).c_str(),
                                   std::abs(e.s - match.s) / std::abs(e.s),
                                   allowed / std::abs(e.s));
        const std::string verdicts = verdictDifference(e, match, allowed);
        if (!verdicts.empty()) return where + "eigenvalue " + text(e.s) + " is " + verdicts;
      }
    }
    return "";
  }

 private:
  static double reach(const FoundPoint& point) { return point.top > 0 ? point.top : INFINITY; }
  double rounding(Complex s) const {
    return safety * epsilon * (1 + stiffest_ * stiffest_ / std::norm(s));
  }
  /// Within the band of both, not at its edges.
  bool counts(const FoundEigenvalue& e) const {
    const double size = std::abs(e.s);
    return size < (1 - 1e-6) * top_ && -e.s.real() < (0.5 - 1e-6) * size;
  }
  std::vector<int> matched(const FoundPoint& a, const FoundPoint& b) const {
    std::vector<std::tuple<double, int, int>> pairs;
    for (int i = 0; i < std::ssize(a.eigenvalues); ++i)
      for (int j = 0; j < std::ssize(b.eigenvalues); ++j)
        pairs.emplace_back(std::abs(a.eigenvalues[i].s - b.eigenvalues[j].s), i, j);
    std::sort(pairs.begin(), pairs.end());
    std::vector<int> other(a.eigenvalues.size(), -1);
    std::vector<bool> used(b.eigenvalues.size());
    for (const auto& [distance, i, j] : pairs)
      if (other[i] < 0 && !used[j]) other[i] = j, used[j] = true;
    return other;
  }
  double allowance(const FoundPoint& a, const FoundPoint& b, std::size_t i, std::size_t j) const {
    const double unit = rounding(a.eigenvalues[i].s), size = std::abs(a.eigenvalues[i].s);
    const Judged one = judged(a, unit)[i], two = judged(b, unit)[j];
    const double isolation = std::min(one.isolation, two.isolation);
    // |δs| max(d, |δs|) ≤ unit |s|²
    const double ofRounding =
        std::min(unit * size * size / std::max(isolation, 1e-300), std::sqrt(unit) * size);
    return one.estimate + two.estimate + ofRounding + state_ * size;
  }
  static std::string verdictDifference(const FoundEigenvalue& a, const FoundEigenvalue& b,
                                       double allowed) {
    using pencil::Verdict;
    if (a.verdict == b.verdict) return "";
    if (a.verdict == Verdict::uncertified || b.verdict == Verdict::uncertified) {
      const auto& certain = a.verdict == Verdict::uncertified ? b : a;
      const auto& bare = a.verdict == Verdict::uncertified ? a : b;
      if (certain.verdict != Verdict::unstable || bare.s.real() > -allowed) return "";
    } else if (std::abs(a.s.real()) <= allowed && std::abs(b.s.real()) <= allowed) {
      return "";
    }
    return std::string(pencil::text(a.verdict)) + " and " + pencil::text(b.verdict);
  }

  const FoundPoint &first_, &second_;
  double stiffest_, state_, top_ = INFINITY;
};

std::string steadyDifference(const FoundSteady& a, const FoundSteady& b, const Extent& extent) {
  const std::string where = "steady sliding at " + sweep::parameterText(a.at) + ": ";
  if (a.converged && !b.converged && extent.mayMiss) return "";
  if (a.converged != b.converged) return where + "only one of the runs finds it";
  if (!a.converged) return "";
  if (extent.sameUnknowns && a.open != b.open)
    return where + formatted("%d and %d open nodes", int(a.open), int(b.open));
  double largest = 0;
  for (double force : a.forces) largest = std::max(largest, std::abs(force));
  // The residual is accepted in units of the largest forces of the problem, such as those of an
  // interference before the parts give way. The imbalance relates it to the forces of this state.
  const double allowed = (1e-7 + 10 * (a.imbalance + b.imbalance)) * largest;
  for (std::size_t i = 0; i < a.interfaces.size(); ++i)
    for (std::size_t j = 0; j < b.interfaces.size(); ++j) {
      if (a.interfaces[i] != b.interfaces[j] || a.interfaces[i] == "bond") continue;
      for (int k = 0; k < 2; ++k)
        if (!(std::abs(a.forces[2 * i + k] - b.forces[2 * j + k]) <= allowed))
          return where + formatted("forces %.12g and %.12g N on interface '%s'",
                                   a.forces[2 * i + k], b.forces[2 * j + k],
                                   a.interfaces[i].c_str());
    }
  return "";
}

std::string criticalDifference(const Outcome& a, const Outcome& b, double top) {
  for (const auto& c : a.criticals) {
    if (!c.converged || c.angularFrequency > 0.98 * top) continue;
    const bool found = std::ranges::any_of(b.criticals, [&](const auto& other) {
      sweep::Parameters at = other.at;
      at.friction = c.at.friction;
      const double allowed = c.error + other.error + 1e-6 * std::max(c.at.friction, 0.01);
      return at == c.at && other.loss == c.loss &&
             std::abs(other.at.friction - c.at.friction) <= allowed &&
             std::abs(other.angularFrequency - c.angularFrequency) <=
                 1e-3 * std::max(top < INFINITY ? top : 0, c.angularFrequency);
    });
    if (!found)
      return formatted("critical friction %.10g (%s, %.6g rad/s) of one run is not in the other",
                       c.at.friction, c.loss ? "loss" : "regain", c.angularFrequency);
  }
  return "";
}

}  // namespace

std::string difference(const Outcome& first, const Outcome& second, const Extent& extent) {
  if (first.refusal.empty() != second.refusal.empty())
    return "only one run is refused: " + first.refusal + second.refusal;
  if (!first.refusal.empty()) return "";
  if (!extent.sameWay && !std::ranges::all_of(first.steady, &FoundSteady::unique)) return "";
  double top = INFINITY;
  std::size_t common = 0, commonSteady = 0;
  for (const auto& a : first.steady)
    for (const auto& b : second.steady) {
      if (a.at != b.at) continue;
      ++commonSteady;
      if (auto found = steadyDifference(a, b, extent); !found.empty()) return found;
    }
  for (const auto& a : first.points)
    for (const auto& b : second.points) {
      if (a.at != b.at) continue;
      ++common;
      for (const auto* point : {&a, &b})
        if (point->top > 0) top = std::min(top, point->top);
      if (auto found = PointComparison(a, b, first.stiffest, extent.state).difference();
          !found.empty())
        return found;
    }
  if (common < second.points.size() ||
      (extent.sameSweep && !extent.mayMiss && common < first.points.size()))
    return "the runs have other points";
  if (commonSteady < second.steady.size()) return "the runs have other steady points";
  if (!extent.criticals || !first.followed || !second.followed) return "";
  auto found = criticalDifference(first, second, top);
  return found.empty() ? criticalDifference(second, first, top) : found;
}

}  // namespace squeal::fuzz
