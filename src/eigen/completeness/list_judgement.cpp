// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/completeness/list_judgement.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/system/text.hpp"

namespace squeal::completeness {
namespace {

/// Returns true if all points of the disc are in the band.
bool inBand(const pencil::WatchedBand& band, Complex s, double radius) {
  const double size = std::abs(s);
  return size + radius <= band.top && -s.real() + radius <= band.damping * (size - radius);
}

/// Returns true if no point of the disc is in the band.
bool outsideBand(const pencil::WatchedBand& band, Complex s, double radius) {
  const double size = std::abs(s);
  return size - radius > band.top || -s.real() - radius > band.damping * (size + radius);
}

}  // namespace

proof::Remedies remedies(const char* modes) {
  return {.modes = modes, .top = "-flutter_band", .left = "", .discs = "-flutter_proof_discs"};
}

void recordCount(const proof::Region& region, const proof::CountProof& count,
                 pencil::Completeness& found) {
  found.proved = count.verdict == proof::Verdict::proved;
  found.count = static_cast<int>(count.count);
  found.top = region.top;
  found.left = region.left;
  found.definiteness = count.definiteness;
  found.ratio = count.ratio;
  found.place = count.place;
  found.discs = static_cast<int>(count.discs);
}

bool keepBetter(pencil::Completeness first, pencil::Completeness& found) {
  const bool isWorse = found.top == 0 || (first.proved && !found.proved);
  if (isWorse) found = std::move(first);
  return isWorse;
}

void judgeList(const std::vector<proof::Enclosure>& discs, const proof::Region& region,
               pencil::WatchedBand band, pencil::ComplexModes& point) {
  auto& found = *point.completeness;
  band.top = point.bandTop;
  std::vector<Complex> list;
  for (const auto& e : point.eigenvalues) list.push_back(e.s);
  const auto judged = proof::judge(list, discs, region, point.tolerance * region.top);
  const bool allKnown = found.proved && std::ranges::all_of(discs, [](const auto& disc) {
                          return disc.isolation == proof::Isolation::single;
                        });
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto& [agreement, radius, disc] = judged.entries[i];
    if (radius > 0) point.eigenvalues[i].radius = radius;
    if (allKnown &&
        (agreement == proof::Agreement::wrong || agreement == proof::Agreement::repeated))
      found.spurious.push_back(list[i]);
  }
  for (const auto& disc : judged.missing) {
    if (inBand(band, disc.s, disc.inner))
      found.missing.push_back({disc.s, disc.inner});
    else if (!outsideBand(band, disc.s, disc.inner))
      found.undecided.push_back(disc.s);
  }
  // Nothing is known about the place of such an eigenvalue of the full problem.
  for (const auto& disc : judged.unresolved) found.undecided.push_back(disc.s);
  if (found.proved && !judged.unresolved.empty())
    found.reason = formatted(
        "%zu eigenvalues near %.6g Hz have no discs of their own, so that their places in the "
        "region are not known",
        judged.unresolved.size(), judged.unresolved.front().s.imag() / (2 * M_PI));
}

}  // namespace squeal::completeness
