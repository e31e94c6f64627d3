// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/proof/enclosure.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "eigen/proof/expansion.hpp"

namespace squeal::proof {
namespace {

constexpr double margin = 1e-6;
constexpr double sameImage = 1e-9;  // distance of conjugates in the plane of z

/// The radii in the plane of z between which the circles about an eigenvalue were found to be free
/// of eigenvalues of P; both 0 if none was.
struct Radii {
  double inner = 0, outer = 0;
};

/// Returns the radii for free(radius). At large radii other eigenvalues spoil it, and at small ones
/// the coupling of this eigenvalue.
template <class Free>
Radii search(double largest, const Free& free) {
  constexpr double shrink = 0.6, smallest = 1e-16;
  double radius = largest;
  while (radius > smallest && !free(radius)) radius *= shrink;
  if (!(radius > smallest)) return {};
  Radii radii{radius, radius};
  while (radii.inner > smallest && free(shrink * radii.inner)) radii.inner *= shrink;
  double tooSmall = shrink * radii.inner;
  for (int i = 0; i < 10; ++i) {
    const double middle = std::sqrt(tooSmall * radii.inner);
    (free(middle) ? radii.inner : tooSmall) = middle;
  }
  return radii;
}

/// Returns the distance from the whole boundary: the contour is its upper half.
double fromBoundary(const Contour& contour, Complex z) {
  return contour.distance({z.real(), std::abs(z.imag())});
}

/// Returns the part of the poles outside the region. It is analytic in the region, and so at most
/// as large as on the boundary, where all poles together are bounded by the proof of the count and
/// the others by the sum of their terms.
FarPart farPart(const DiagonalForm& form, const Contour& contour, const CountProof& count) {
  const auto values = form.eigenvaluesInPlane();
  FarPart far{std::vector<unsigned char>(values.size()), count.bound};
  const double reach = contour.reach();
  const auto atReach = [&](const std::vector<std::vector<double>>& lengths, std::size_t k) {
    double sum = 0, power = 1;
    for (const auto& list : lengths) {
      sum += power * list[k];
      power *= reach;
    }
    return sum;
  };
  for (std::size_t k = 0; k < values.size(); ++k) {
    far.poles[k] = !contour.encloses(values[k]);
    if (!far.poles[k])
      far.bound += atReach(form.aLengths(), k) * atReach(form.bLengths(), k) /
                   (std::abs(form.nu()[k]) * fromBoundary(contour, values[k]));
  }
  return far;
}

/// An eigenvalue of P_VV among all in the plane of z, all borrowed.
struct Pole {
  const DiagonalForm& form;
  std::span<const Complex> values;
  std::size_t number;
  double inside;       // distance from the boundary of the region
  const FarPart* far;  // null: unknown
};

/// Returns the radii about an eigenvalue, and what prevents a proof otherwise.
std::pair<Radii, Isolation> radiiAbout(const Pole& pole, const LeftOut& bounds) {
  const auto& [form, values, k, inside, far] = pole;
  const Complex centre = values[k];
  double nearest = 1;
  for (std::size_t j = 0; j < values.size(); ++j)
    if (j != k) nearest = std::min(nearest, std::abs(values[j] - centre));
  const auto delta = [&](double radius) {
    const double size = std::abs(centre) + radius, top = form.top();
    return form.squared() ? definiteness(bounds, top * std::sqrt(size), top * std::sqrt(size))
                          : definiteness(bounds, top * size, top * (radius - centre.real()));
  };
  if (!(delta(0) > margin)) return {Radii{}, Isolation::indefinite};
  const auto searched = [&](const Expansion& expansion, double largest) {
    return search(largest, [&](double radius) {
      const double allowed = (1 - margin) * delta(radius);
      return allowed > margin && expansion.boundOnCircle(radius) < allowed;
    });
  };
  const auto number = static_cast<PetscInt>(k);
  Radii radii;
  if (far) radii = searched(Expansion(form, centre, *far, number), std::min(0.9 * nearest, inside));
  if (radii.outer == 0)  // the norm of the sum over the poles costs a product of matrices
    radii = searched(Expansion(form, centre, 0, number), 0.9 * nearest);
  return {radii, radii.outer > 0 ? Isolation::single : Isolation::neighbour};
}

/// Returns the enclosure in the plane of s.
Enclosure enclosure(const DiagonalForm& form, Complex z, const Radii& radii) {
  Enclosure result{form.outOfPlane(z), Isolation::single, form.top() * radii.inner,
                   form.top() * radii.outer};
  if (!form.squared()) return result;
  // s = s_k √(1 + u), |u| ≤ r / |z|, lies within |s_k| (1 − √(1 − |u|)); and |s − s_k| ≤ ρ is in
  // the disc |z − z_k| ≤ r if ρ (2 |s_k| + ρ) ≤ r / top^-2
  const double size = std::abs(z), s = form.top() * std::sqrt(size),
               inner = std::min(radii.inner / size, 1.0), outer = radii.outer / size;
  result.inner = s * inner / (1 + std::sqrt(1 - inner));
  result.outer = std::min(s * outer / (1 + std::sqrt(1 + outer)), 0.9 * s);
  if (!(radii.inner < size) || !(result.inner <= result.outer)) {
    result.isolation = Isolation::neighbour;  // ±s are too near to each other
    result.inner = result.outer = 0;
  }
  // A disc that is symmetric about the real axis of z and holds one eigenvalue holds a real one.
  result.neutral = result.isolation == Isolation::single &&
                   radii.inner + 2 * std::abs(z.imag()) <= radii.outer &&
                   z.real() + radii.inner + std::abs(z.imag()) < 0;
  return result;
}

}  // namespace

std::vector<Enclosure> enclose(const DiagonalForm& form, const LeftOut& bounds,
                               const Region& region, const CountProof& count,
                               const linalg::EigenvalueFilter& wanted) {
  std::vector<Enclosure> result;
  if (!form.regular()) return result;
  const Contour contour(std::abs(form.inPlane(region.top)), region.left / form.top(),
                        form.squared());
  const auto values = form.eigenvaluesInPlane();
  std::optional<FarPart> far;
  if (count.verdict == Verdict::proved) far = farPart(form, contour, count);
  std::vector<std::pair<Complex, Enclosure>> upper;  // with Im z > 0, whose images are to come
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto z = values[k], s = form.outOfPlane(z);
    if (!contour.encloses(z) || (wanted && !wanted(s) && !(form.squared() && wanted(-s)))) continue;
    const auto image = std::ranges::find_if(
        upper, [&](const auto& other) { return std::abs(other.first - std::conj(z)) < sameImage; });
    Enclosure found{s};
    if (z.imag() < -sameImage && image != upper.end()) {
      found = image->second;
      upper.erase(image);  // each is the image of one
      found.s = form.squared() ? -std::conj(found.s) : std::conj(found.s);
    } else {
      const auto [radii, isolation] =
          radiiAbout({form, values, k, fromBoundary(contour, z), far ? &*far : nullptr}, bounds);
      if (isolation == Isolation::single)
        found = enclosure(form, z, radii);
      else
        found.isolation = isolation;
      if (z.imag() > 0) upper.emplace_back(z, found);
    }
    result.push_back(found);
    if (!form.squared()) continue;
    found.s = -found.s;
    result.push_back(found);
  }
  return result;
}

namespace {

/// Returns false for the mirror image of an eigenvalue with Im s > 0.
bool upper(const Enclosure& enclosure) { return enclosure.s.imag() >= -enclosure.inner; }

bool isSingle(const Enclosure& disc) { return disc.isolation == Isolation::single; }

/// Judges the entries of a list; the members are borrowed.
struct Judge {
  std::span<const Complex> list;
  const std::vector<Enclosure>& discs;
  const Region& region;
  double tolerance;
  JudgedList judged = {};
  std::vector<std::optional<std::size_t>> entryOf = {};  // [disc]

  double apart(std::size_t entry, std::size_t disc) const {
    return std::abs(list[entry] - discs[disc].s);
  }
  /// Returns the nearest disc among those of eigenvalues with Im s ≥ 0 that the filter admits.
  template <class Filter>
  std::optional<std::size_t> nearest(std::size_t entry, const Filter& filter) const {
    std::optional<std::size_t> found;
    for (std::size_t d = 0; d < discs.size(); ++d)
      if (upper(discs[d]) && filter(d) && (!found || apart(entry, d) < apart(entry, *found)))
        found = d;
    return found;
  }
  bool isInside(std::size_t entry) const {
    return std::abs(list[entry]) < region.top && list[entry].real() > -region.left;
  }
  bool isRight(std::size_t entry, std::size_t disc) const {
    return apart(entry, disc) <= discs[disc].inner + tolerance;
  }
  std::vector<std::size_t> discsFor(std::size_t entry, std::size_t closest) const;
  bool assign(std::size_t entry, const std::vector<std::vector<std::size_t>>& candidates,
              std::vector<unsigned char>& tried);
  void setUnresolved(std::size_t entry, std::size_t disc);
  void setSingle(std::vector<std::size_t> entries);
};

/// Returns the single discs that the entry may belong to, the closest one first: the others must
/// contain it within the tolerance relative to |s|. Of eigenvalues that are closer to each other
/// than the errors of the list, each takes one entry.
std::vector<std::size_t> Judge::discsFor(std::size_t entry, std::size_t closest) const {
  std::vector<std::size_t> found{closest};
  const double relative = tolerance * std::min(1.0, std::abs(list[entry]) / region.top);
  for (std::size_t d = 0; d < discs.size(); ++d)
    if (d != closest && isSingle(discs[d]) && upper(discs[d]) &&
        apart(entry, d) <= discs[d].inner + relative)
      found.push_back(d);
  std::sort(found.begin() + 1, found.end(),
            [&](auto a, auto b) { return apart(entry, a) < apart(entry, b); });
  return found;
}

/// Assigns the entry to a disc, and moves other entries to other discs if that is necessary (an
/// augmenting path, H. W. Kuhn, Naval Research Logistics Quarterly 2, 1955). Returns false if it
/// is impossible.
bool Judge::assign(std::size_t entry, const std::vector<std::vector<std::size_t>>& candidates,
                   std::vector<unsigned char>& tried) {
  for (const std::size_t d : candidates[entry]) {
    if (tried[d]) continue;
    tried[d] = 1;
    if (entryOf[d] && !assign(*entryOf[d], candidates, tried)) continue;
    entryOf[d] = entry;
    judged.entries[entry].disc = d;
    return true;
  }
  return false;
}

/// Judges an entry whose nearest disc is not single. Of equal eigenvalues, each takes one entry, in
/// any order.
void Judge::setUnresolved(std::size_t entry, std::size_t disc) {
  std::optional<std::size_t> taken = disc;
  if (entryOf[disc])
    taken = nearest(entry, [&](std::size_t d) {
      return !isSingle(discs[d]) && !entryOf[d] &&
             std::abs(discs[d].s - discs[disc].s) <= apart(entry, disc) + tolerance;
    });
  if (taken) entryOf[*taken] = entry;
  if (isInside(entry)) judged.entries[entry].agreement = Agreement::unproved;
}

/// Judges the entries whose nearest disc, in JudgedEntry::disc, is single.
void Judge::setSingle(std::vector<std::size_t> entries) {
  auto& all = judged.entries;
  std::ranges::stable_sort(entries, {}, [&](auto i) { return apart(i, *all[i].disc); });
  std::vector<std::vector<std::size_t>> candidates(list.size());
  for (const auto i : entries)
    if (isRight(i, *all[i].disc)) candidates[i] = discsFor(i, *all[i].disc);
  for (const auto i : entries) {
    std::vector<unsigned char> tried(discs.size());
    if (!candidates[i].empty())
      all[i].agreement = assign(i, candidates, tried) ? Agreement::right : Agreement::repeated;
  }
  for (const auto i : entries) {
    const std::size_t disc = *all[i].disc;
    if (!candidates[i].empty() || !isInside(i) || apart(i, disc) > discs[disc].outer) continue;
    all[i].agreement = entryOf[disc] ? Agreement::repeated : Agreement::inexact;
    if (!entryOf[disc]) entryOf[disc] = i;
  }
  for (const auto i : entries) {
    auto& entry = all[i];
    const auto& disc = discs[*entry.disc];
    const bool holds = entry.agreement == Agreement::right || entry.agreement == Agreement::inexact;
    if (holds && 2 * apart(i, *entry.disc) + disc.inner <= disc.outer)
      entry.radius = apart(i, *entry.disc) + disc.inner;
  }
}

}  // namespace

JudgedList judge(std::span<const Complex> list, const std::vector<Enclosure>& enclosures,
                 const Region& region, double tolerance) {
  Judge judge{list, enclosures, region, tolerance};
  auto& judged = judge.judged;
  judged.entries.resize(list.size());
  judge.entryOf.resize(enclosures.size());
  std::vector<std::size_t> single;
  for (std::size_t i = 0; i < list.size(); ++i) {
    auto& entry = judged.entries[i];
    entry.agreement = judge.isInside(i) ? Agreement::wrong : Agreement::outside;
    const auto disc = judge.nearest(i, [](std::size_t) { return true; });
    if (!disc) continue;
    if (!isSingle(enclosures[*disc])) {
      judge.setUnresolved(i, *disc);
      continue;
    }
    entry.disc = disc;
    single.push_back(i);
  }
  judge.setSingle(std::move(single));
  for (std::size_t d = 0; d < enclosures.size(); ++d)
    if (upper(enclosures[d]) && !judge.entryOf[d])
      (isSingle(enclosures[d]) ? judged.missing : judged.unresolved).push_back(enclosures[d]);
  return std::move(judged);
}

}  // namespace squeal::proof
