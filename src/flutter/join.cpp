#include "flutter/join.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace squeal::flutter {
namespace {

constexpr double reach = 0.1;  // of a projector into another: below, two eigenvalues have nothing in common

using Complex = std::complex<double>;

std::size_t rootOf(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

std::vector<std::size_t> byFrequency(const std::vector<DensePair>& pairs) {
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) {
    const Complex s = pairs[a].s, t = pairs[b].s;
    // Members of a split pair have one frequency, but for rounding.
    return std::abs(s.imag() - t.imag()) > 1e-8 * std::abs(s) ? s.imag() < t.imag() : s.real() > t.real();
  });
  return order;
}

}  // namespace

bool neutral(Complex s, bool damped) { return std::abs(s.real()) <= (damped ? 1e-10 : 1e-6) * std::abs(s); }

bool neutralPair(const std::vector<DensePair>& two, bool damped) { return neutral(two[0].s, damped) && neutral(two[1].s, damped); }

bool splitPair(const std::vector<DensePair>& two, bool damped) {
  const Complex a = two[0].s, b = two[1].s;
  return !neutral(a, damped) && std::abs(a + std::conj(b)) <= (damped ? 1e-8 : 1e-5) * std::abs(a.real());
}

bool coincide(const std::vector<DensePair>& pairs) {
  const Complex middle = mean(pairs);
  return std::all_of(pairs.begin(), pairs.end(), [&](const auto& p) { return std::abs(p.s - middle) <= 1e-7 * std::abs(middle); });
}

std::vector<Group> groups(const Spectrum& here, const Spectrum& there) {
  const std::size_t n = here.pairs().size(), all = n + there.pairs().size();
  std::vector<Complex> overlaps(n * (all - n));
  std::vector<std::size_t> parent(all);
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = n; j < all; ++j) {
      overlaps[i * (all - n) + j - n] = here.overlap(i, there, j - n);
      if (std::abs(overlaps[i * (all - n) + j - n]) > reach) parent[rootOf(parent, i)] = rootOf(parent, j);
    }
  std::vector<Group> found(all);
  for (std::size_t k = 0; k < all; ++k) {
    Group& group = found[rootOf(parent, k)];
    (k < n ? group.here : group.there).push_back(k < n ? k : k - n);
  }
  std::erase_if(found, [](const Group& group) { return group.here.empty() && group.there.empty(); });
  for (auto& group : found) {
    Complex sum = 0;
    for (const auto i : group.here)
      for (const auto j : group.there) sum += overlaps[i * (all - n) + j];
    group.share = std::abs(sum - static_cast<double>(group.here.size()));
  }
  return found;
}

std::vector<std::size_t> assigned(const Spectrum& here, const Spectrum& there, const Group& group) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> list;
  for (std::size_t a = 0; a < group.here.size(); ++a)
    for (std::size_t b = 0; b < group.there.size(); ++b)
      list.emplace_back(-std::abs(here.overlap(group.here[a], there, group.there[b])), a, b);
  std::sort(list.begin(), list.end());
  std::vector<std::size_t> mate(group.here.size(), group.there.size());
  std::vector<bool> used(group.there.size());
  for (const auto& [size, a, b] : list)
    if (mate[a] == group.there.size() && !used[b]) {
      mate[a] = b;
      used[b] = true;
    }
  return mate;
}

std::vector<std::size_t> ordered(const std::vector<DensePair>& here, const std::vector<DensePair>& there) {
  const auto a = byFrequency(here), b = byFrequency(there);
  std::vector<std::size_t> mate(a.size());
  for (std::size_t k = 0; k < a.size(); ++k) mate[a[k]] = b[k];
  return mate;
}

std::vector<DensePair> chosen(const std::vector<DensePair>& all, const std::vector<std::size_t>& indices) {
  std::vector<DensePair> list;
  for (const auto i : indices) list.push_back(all[i]);
  return list;
}

double discriminant(const std::vector<DensePair>& two) {
  const Complex half = 0.5 * (two[0].s - two[1].s);
  return -(half * half).real();
}

Complex mean(const std::vector<DensePair>& pairs) {
  Complex sum = 0;
  for (const auto& pair : pairs) sum += pair.s;
  return sum / static_cast<double>(pairs.size());
}

}  // namespace squeal::flutter
