// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/stability/followed.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/system/text.hpp"
#include "eigen/tracking/reducedfamily.hpp"
#include "eigen/tracking/renumber.hpp"

namespace squeal::stability {
namespace {

/// Returns true if the eigenvalues in the band are i ω of the lowest modes, within their errors.
/// Even at friction 0 they are not if the problem differs from that of the modes, for example by an
/// unsymmetric stiffness from a file or by the prestress of another friction.
bool areFreeModes(const Station& station, const std::vector<double>& angularFrequency,
                  std::size_t count) {
  constexpr double near = 1e-6;
  std::vector<double> found;
  for (std::size_t i = 0; i < station.pairs.size(); ++i)
    if (station.inBand[i]) found.push_back(station.pairs[i].s.imag());
  std::sort(found.begin(), found.end());
  return found.size() == count &&
         std::equal(found.begin(), found.end(), angularFrequency.begin(),
                    [&](double s, double w) { return std::abs(s - w) <= near * w; });
}

/// Returns true if a Sturm count of the free modes confirms the number of eigenvalues at friction
/// 0, the first station.
bool isCounted(const Branches& branches, const modes::Modes& modes) {
  const auto& w = modes.angularFrequency;
  const double top = branches.band.top;
  const auto below = std::ranges::count_if(w, [&](double omega) { return omega <= top; });
  return branches.stations.front().friction == 0 && modes.countConfirmed &&
         top * top <= modes.inertiaShift && areFreeModes(branches.stations.front(), w, below);
}

/// The pieces of a line, ready to be tracked.
struct TrackedPath {
  std::vector<std::unique_ptr<tracking::ReducedFamily>> families;  ///< [piece]
  std::vector<Piece> pieces;                                       ///< borrow the families
};

/// Collective. Returns the path of a line; it begins at friction 0 unless the line continues
/// another one.
TrackedPath pathOf(reduction::ReducedProblem& reduced, const Line& line, MPI_Comm comm,
                   const std::function<void(const std::string&)>& progress) {
  TrackedPath path;
  for (const auto& piece : line.pieces) {
    auto& family = path.families.emplace_back(
        std::make_unique<tracking::ReducedFamily>(reduced, comm, line.at, piece.source, progress));
    auto& added = path.pieces.emplace_back(family.get(), piece.frictions);
    for (const double friction : piece.frictions)
      added.needed.push_back(std::ranges::binary_search(line.swept, friction));
  }
  if (auto& first = path.pieces.front(); first.frictions.front() != 0 && !line.continues) {
    first.frictions.insert(first.frictions.begin(), 0);
    first.needed.insert(first.needed.begin(), 1);
  }
  return path;
}

/// Returns the steps between pieces, within which the active set changes at unknown frictions.
std::vector<std::pair<double, double>> stepsBetween(const std::vector<Piece>& pieces) {
  std::vector<std::pair<double, double>> steps;
  for (std::size_t k = 1; k < pieces.size(); ++k)
    if (const double from = pieces[k - 1].frictions.back(), to = pieces[k].frictions.front();
        from < to)
      steps.emplace_back(from, to);
  return steps;
}

/// Lets a line begin at its lowest friction of the sweep, after a step that is not followed.
void beginAfterStep(const Line& line, TrackedLine& tracked) {
  tracked.from = line.swept.front();
  auto& gaps = tracked.branches.gaps;
  std::erase_if(gaps, [&](const Gap& gap) { return gap.to <= tracked.from; });
  gaps.push_back({*line.before, tracked.from, line.whyNotFollowed});
  std::erase_if(tracked.criticals,
                [&](const Critical& critical) { return critical.friction < tracked.from; });
}

/// Collective. Follows the eigenvalues of one line.
TrackedLine trackLine(reduction::ReducedProblem& reduced, const Line& line,
                      const Settings& settings, MPI_Comm comm,
                      const std::function<void(const std::string&)>& progress) {
  TrackedLine tracked;
  tracked.line = line.at;
  tracked.begin = line.swept.front();
  tracked.continues = line.continues;
  tracked.isContinued = line.isContinued;
  PetscInt unknowns = 0;
  check(MatGetSize(reduced.basis().stiffness(), &unknowns, nullptr));
  tracked.wholeSpace = reduced.basisSize() == unknowns;
  for (const auto& piece : line.pieces) tracked.activeSet.push_back(piece.activeSet);
  const TrackedPath path = pathOf(reduced, line, comm, progress);
  tracked.unlocated = stepsBetween(path.pieces);
  tracking::TrackLimits limits;
  limits.smallest = settings.smallest;
  tracked.branches = track(path.pieces, reduced.band(), limits);
  auto& stations = tracked.branches.stations;
  for (auto& station : stations)
    station.swept = std::ranges::binary_search(line.swept, station.friction);
  if (!stations.empty()) {
    auto& family = *path.families[stations.front().piece];
    const auto problem = family.at(stations.front().friction);
    tracked.isDamped = problem && !problem->damping.empty();
    tracked.countExact = problem && !tracked.isDamped && isCounted(tracked.branches, *line.modes);
  }
  renumber(tracked.branches);
  if (line.before)
    std::erase_if(tracked.branches.events,
                  [&](const tracking::Event& event) { return event.low < line.swept.front(); });
  if (settings.critical)
    tracked.criticals = criticalFrictions(path.pieces, tracked.branches, settings.tolerance);
  if (line.before) beginAfterStep(line, tracked);
  tracked.branches.events.clear();  // their vectors take much memory
  return tracked;
}

}  // namespace

bool worthTracking(const Line& line, bool requested) {
  return line.swept.size() > 1 || line.before.value_or(0) > 0 || line.isContinued ||
         (line.swept.front() != 0 && requested);
}

std::string whyNotTracked(const reduction::ReducedProblem& reduced,
                          const std::vector<Line>& lines) {
  if (reduced.band().top == 0) return "-flutter_basis modal corrects no eigenvalue";
  return lines.empty() ? "single frictions" : "";
}

bool TrackedLine::complete() const {
  return std::all_of(branches.gaps.begin(), branches.gaps.end(),
                     [](const Gap& gap) { return gap.identityOnly; });
}

std::string TrackedLine::statement() const {
  const auto& stations = branches.stations;
  if (stations.empty()) return "completeness not shown: no reduced problem";
  const auto& first = stations.front();
  const auto& last = stations.back();
  std::string text = formatted(
      "%d eigenvalues in the band at friction %g%s (%s); ", branches.inBandAt(first),
      first.friction,
      first.friction < from ? formatted(" with the contact of friction %g", from).c_str() : "",
      wholeSpace   ? "of the full problem: the basis is the whole space"
      : countExact ? "Sturm count, exact"
                   : "of the reduced problem, not confirmed by a Sturm count");
  if (complete()) {
    text += formatted("all tracked to friction %g", last.friction);
    if (const auto changes = activeSet.size() - 1; activeSet.size() > 1)
      text +=
          formatted(", across %zu change%s of the active set", changes, changes == 1 ? "" : "s");
    text += formatted(
        "; the band contains %d eigenvalues at that friction: %d entered and %d left across its "
        "edge",
        branches.inBandAt(last), branches.entered, branches.left);
  } else {
    text += "not all tracked:";
    for (const auto& gap : branches.gaps)
      if (!gap.identityOnly)
        text += formatted(" [%g to %g: %s]", gap.from, gap.to, gap.reason.c_str());
  }
  if (const auto& jumps = unlocated; !jumps.empty()) {
    text += "; assumed: no eigenvalue changes its stability twice ";
    text += jumps.size() == 1 ? formatted("between friction %g and %g, where", jumps.front().first,
                                          jumps.front().second)
                              : formatted("in each of the %zu steps in which", jumps.size());
    text += " the active set changes at frictions that are not known";
  }
  if (branches.omitted > 0)
    text += formatted(
        "; assumed: no eigenvalue changes its stability twice among the %d active sets that were "
        "not examined",
        branches.omitted);
  if (const auto open = std::ranges::count(criticals, false, &Critical::converged); open > 0)
    text +=
        formatted("; for %td of %zu changes of stability, only an interval of friction is known",
                  open, criticals.size());
  return wholeSpace
             ? text
             : text +
                   "; assumed: every eigenvalue of the full problem that crosses the edge of "
                   "the band appears in the reduced problem";
}

std::vector<TrackedLine> trackLines(reduction::ReducedProblem& reduced,
                                    const std::vector<Line>& lines, const Settings& settings,
                                    MPI_Comm comm,
                                    const std::function<void(const std::string&)>& progress) {
  std::vector<TrackedLine> result;
  for (const auto& line : lines)
    result.push_back(trackLine(reduced, line, settings, comm, progress));
  return result;
}

}  // namespace squeal::stability
