// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/referee/rows.hpp"

#include <algorithm>
#include <cmath>

#include "base/system/text.hpp"

namespace squeal::referee {
namespace {

bool isSingle(const proof::Enclosure& disc) { return disc.isolation == proof::Isolation::single; }

/// Returns the disc of a neutral eigenvalue about the nearest imaginary point, which is as near
/// or nearer; other discs as they are.
proof::Enclosure placed(proof::Enclosure disc) {
  if (disc.neutral) disc.s = {0, disc.s.imag()};
  return disc;
}

/// The list and the accuracy of its right entries, relative to |s|.
struct Accuracy {
  std::span<const Complex> list;
  double tolerance;

  bool isAccurate(const Row& row) const {
    return row.distance <= tolerance * std::abs(row.listed) + row.radius;
  }
  /// Returns true if another entry is the same.
  bool isTwice(const Row& row) const {
    return std::ranges::count_if(list, [&](Complex s) {
             return std::abs(s - row.listed) <= tolerance * std::abs(row.listed);
           }) > 1;
  }
};

/// Returns the verdict on an entry. An entry in none of the discs, or in that of a closer entry, is
/// an artefact only if the discs hold all eigenvalues.
Verdict verdictOf(const Row& row, proof::Agreement agreement, const Accuracy& accuracy,
                  bool allKnown) {
  const Verdict surplus = allKnown ? Verdict::artefact : Verdict::unproved;
  switch (agreement) {
    case proof::Agreement::right:
      return accuracy.isAccurate(row) ? Verdict::right : Verdict::inexact;
    case proof::Agreement::inexact:
      return Verdict::inexact;
    case proof::Agreement::repeated:
      return accuracy.isAccurate(row) || accuracy.isTwice(row) ? Verdict::repeated : surplus;
    case proof::Agreement::outside:
      return Verdict::outside;
    case proof::Agreement::wrong:
      return surplus;
    default:
      return Verdict::unproved;
  }
}

void setProved(const proof::Enclosure& disc, Row& row) {
  row.proved = disc.s;
  row.radius = disc.inner;
  row.distance = row.entry ? std::abs(row.listed - disc.s) : 0;
}

}  // namespace

void setRows(std::span<const Complex> list, const std::vector<proof::Enclosure>& discs,
             double tolerance, Judgement& judgement) {
  auto& upper = judgement.eigenvalues;
  for (const auto& disc : discs)
    if (disc.s.imag() >= -disc.inner) upper.push_back(placed(disc));
  std::ranges::sort(upper, {}, [](const auto& disc) { return disc.s.imag(); });
  const bool allKnown = judgement.proved() && std::ranges::all_of(upper, isSingle);
  const auto judged = proof::judge(list, discs, judgement.region, tolerance * judgement.region.top);
  for (std::size_t i = 0; i < list.size(); ++i) {
    Row row{.entry = i, .listed = list[i], .proved = {}};
    const auto& entry = judged.entries[i];
    if (entry.disc) setProved(placed(discs[*entry.disc]), row);
    row.verdict = verdictOf(row, entry.agreement, {list, tolerance}, allKnown);
    judgement.rows.push_back(row);
  }
  const auto add = [&](const proof::Enclosure& disc, Verdict verdict) {
    Row row{.entry = {}, .verdict = verdict, .proved = {}};
    if (isSingle(disc))
      setProved(disc, row);
    else
      row.listed = disc.s;
    judgement.rows.push_back(row);
  };
  for (const auto& disc : judged.missing) add(disc, Verdict::missing);
  // Eigenvalues that are not separated may have as many entries as there are.
  for (const auto& disc : upper) {
    const auto near = [&](Complex s) { return std::abs(s - disc.s) <= 1e-3 * std::abs(disc.s); };
    if (!isSingle(disc) && std::ranges::none_of(list, near)) add(disc, Verdict::unproved);
  }
}

const char* text(Verdict verdict) {
  constexpr std::array words{"right",   "inexact",  "double", "artefact",
                             "missing", "unproved", "outside"};
  return words[static_cast<std::size_t>(verdict)];
}

long Judgement::number(Verdict verdict) const {
  return std::ranges::count(rows, verdict, &Row::verdict);
}

long Judgement::singles() const { return std::ranges::count_if(eigenvalues, isSingle); }

bool Judgement::isComplete() const {
  return proved() && std::ranges::all_of(rows, [](const Row& row) {
           return row.verdict == Verdict::right || row.verdict == Verdict::outside;
         });
}

std::string Judgement::regionText() const {
  const std::string disc = "|s|/2π < " + roundedDown(region.top / (2 * M_PI), 6) + " Hz";
  return std::isinf(region.left) || region.left >= region.top
             ? disc
             : disc + " and Re s > -" + roundedDown(region.left, 4) + "/s";
}

std::string Judgement::sentence() const {
  std::vector<std::string> parts;
  for (const auto verdict : allVerdicts)
    if (const long found = number(verdict); found > 0)
      parts.push_back(formatted("%ld %s", found, text(verdict)));
  const std::string entries = joined(parts);
  if (!proved()) return entries + "; completeness not proved for " + regionText() + ": " + why;
  return entries +
         formatted("; proved: %" PetscInt_FMT " eigenvalues, conjugates included, with ",
                   count.count) +
         regionText() + formatted(" (largest ratio %.2g)", count.ratio);
}

}  // namespace squeal::referee
