// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/proof/count.hpp"

#include <algorithm>
#include <cmath>

#include "eigen/proof/expansion.hpp"

namespace squeal::proof {
namespace {

constexpr double margin = 1e-6;
constexpr double onTheEdge = 1e-6;  // distance from an eigenvalue, as a fraction of the top

/// Covers the boundary with discs on which φ < 1.
class Cover {
 public:
  Cover(const DiagonalForm& form, const Contour& contour, double allowed, PetscInt largest,
        CountProof& proof)
      : form_(form), allowed_(allowed), largest_(largest), proof_(proof) {
    for (const auto value : form.eigenvaluesInPlane())
      distances_.push_back(contour.distance(value));
  }

  /// Returns false if a verdict other than `proved` is reached.
  bool cover(const Piece& piece);

 private:
  /// Returns the radius of the largest disc about z on which the bound is below δ; 0 if none, with
  /// the verdict.
  double radiusAt(Complex z);
  const DiagonalForm& form_;
  double allowed_;
  PetscInt largest_;
  CountProof& proof_;
  std::vector<double> distances_;
};

double Cover::radiusAt(Complex z) {
  constexpr int order = 2;
  constexpr double smallest = 1e-10;  // as a fraction of the top
  ++proof_.evaluations;
  const Expansion expansion(form_, z, order);
  const double here = expansion.bound(0, distances_), ratio = here / proof_.definiteness;
  if (!(ratio <= proof_.ratio)) {
    proof_.ratio = ratio;
    proof_.place = form_.outOfPlane(z);
  }
  double low = 0, high = 2;  // from `high` on, nothing is shown
  if (here < allowed_) {
    // Where the boundary is easy, smaller discs leave enclose() a smaller bound.
    const double most = std::min(allowed_, std::max(0.5 * allowed_, 2 * here));
    double trial = 1;
    while (trial > smallest && !(expansion.bound(trial, distances_) < most)) trial /= 2;
    low = trial > smallest ? trial : 0;
    high = 2 * trial;
    for (int i = 0; i < 20 && low > 0; ++i) {
      const double middle = 0.5 * (low + high);
      (expansion.bound(middle, distances_) < most ? low : high) = middle;
    }
    proof_.bound = std::max(proof_.bound, most);
  }
  if (low > smallest) return low;
  proof_.verdict = proof_.edgeDistance < onTheEdge ? Verdict::edge : Verdict::ratio;
  proof_.place = form_.outOfPlane(z);
  return 0;
}

bool Cover::cover(const Piece& piece) {
  constexpr double ahead = 0.9;  // of the reach of the last disc beyond the covered part
  double covered = 0;
  double step = 0;  // the first disc is about the start
  while (covered < piece.length()) {
    const double t = std::min(covered + step, piece.length());
    if (proof_.evaluations >= largest_) {
      proof_.verdict = Verdict::tooManyDiscs;
      proof_.place = form_.outOfPlane(piece.at(t));
      return false;
    }
    const double radius = radiusAt(piece.at(t));
    if (radius == 0) return false;
    const double reach = piece.parameter(radius);
    if (t - reach > covered) {
      // The disc does not reach back to the covered part.
      step = std::min(ahead * reach, 0.5 * (t - covered));
      continue;
    }
    ++proof_.discs;
    covered = t + reach * (1 - margin);
    step = ahead * reach;
  }
  return true;
}

}  // namespace

CountProof proveCount(const DiagonalForm& form, const LeftOut& bounds, const Region& region,
                      PetscInt largest) {
  CountProof proof;
  if (!form.regular()) return proof;
  const double left = std::min(region.left, region.top);
  const Contour contour(std::abs(form.inPlane(region.top)), left / form.top(), form.squared());
  proof.edgeDistance = std::numeric_limits<double>::infinity();
  for (const auto value : form.eigenvaluesInPlane()) {
    if (contour.encloses(value)) proof.count += form.squared() ? 2 : 1;
    proof.edgeDistance = std::min(proof.edgeDistance, contour.distance(value));
  }
  if (form.squared()) proof.edgeDistance /= 2;  // d(s²) = 2 s ds
  proof.definiteness = definiteness(bounds, region.top, left);
  if (!(proof.definiteness > margin)) {
    proof.verdict = Verdict::indefinite;
    return proof;
  }
  Cover cover(form, contour, (1 - margin) * proof.definiteness, largest, proof);
  for (const auto& piece : contour.pieces())
    if (!cover.cover(piece)) return proof;
  proof.verdict = Verdict::proved;
  return proof;
}

namespace {

/// Returns the largest −Re s of the list, at most this.
double mostDamped(std::span<const Complex> list, double limit) {
  double decay = 0;
  for (const auto s : list)
    if (-s.real() <= limit) decay = std::max(decay, -s.real());
  return decay;
}

}  // namespace

PlacedCount proveDamped(const DiagonalForm& form, const LeftOut& bounds, double top, double left,
                        std::span<const Complex> list, PetscInt largest) {
  std::vector<double> lefts{left};
  if (left == 0)
    lefts = {std::max(leastLeft, 1.05 * mostDamped(list, mostLeft * top) / top), leastLeft};
  const auto values = form.eigenvalues();
  PlacedCount placed;
  placed.region.top = top;
  if (form.squared()) {  // the region is the whole disc
    placed.count = proveCount(form, bounds, placed.region, largest);
    return placed;
  }
  if (lefts.size() > 1 && lefts.front() == lefts.back()) lefts.pop_back();
  for (const double tried : lefts) {
    placed.region.left = tried >= 1 ? 2 * top : placedLeft(values, top, tried * top, 0.3);
    placed.count = proveCount(form, bounds, placed.region, largest);
    if (placed.count.verdict == Verdict::proved) break;
  }
  return placed;
}

}  // namespace squeal::proof
