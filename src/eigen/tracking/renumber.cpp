// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/tracking/renumber.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace squeal::tracking {
namespace {

using Eigenvalues = std::map<int, Complex>;  // [branch] at one station

constexpr double rounding = 1e-7;  // relative to |s|, as in coincide()

/// Orders a list by descending keys. Runs of keys that differ by at most `tolerance` are reordered
/// in place by `further`.
template <class Key, class Further>
void orderBy(std::vector<int>& list, const Key& key, double tolerance, const Further& further) {
  std::stable_sort(list.begin(), list.end(), [&](int a, int b) { return key(a) > key(b); });
  for (auto first = list.begin(); first != list.end();) {
    auto last = std::next(first);
    while (last != list.end() && key(*std::prev(last)) - key(*last) <= tolerance) ++last;
    std::vector<int> equal(first, last);
    if (equal.size() > 1) further(equal);
    first = std::copy(equal.begin(), equal.end(), first);
  }
}

class Order {
 public:
  explicit Order(const std::vector<Station>& stations) {
    for (const auto& station : stations) {
      Eigenvalues& here = at_.emplace_back();
      for (std::size_t i = 0; i < station.pairs.size(); ++i)
        here.emplace(station.branch[i], station.pairs[i].s);
    }
  }

  /// Orders a list of branches by their eigenvalues at the station; equal ones are ordered by the
  /// next stations. Branches that have ended before the station keep their order, after the others.
  void apply(std::vector<int>& list, std::size_t station) const {
    if (list.size() < 2 || station == at_.size()) return;
    const Eigenvalues& here = at_[station];
    const auto ended = std::stable_partition(list.begin(), list.end(),
                                             [&](int branch) { return here.count(branch) > 0; });
    std::vector<int> present(list.begin(), ended);
    const auto s = [&](int branch) { return here.at(branch); };
    double tolerance = 0;
    for (int branch : present) tolerance = std::max(tolerance, rounding * std::abs(s(branch)));
    orderBy(
        present, [&](int branch) { return -s(branch).imag(); }, tolerance,
        [&](std::vector<int>& frequency) {
          orderBy(
              frequency, [&](int branch) { return s(branch).real(); }, tolerance,
              [&](std::vector<int>& equal) { apply(equal, station + 1); });
        });
    std::copy(present.begin(), present.end(), list.begin());
  }

 private:
  std::vector<Eigenvalues> at_;  // [station]
};

}  // namespace

void renumber(Branches& branches) {
  auto& [band, stations, events, gaps, count, entered, left, omitted] = branches;
  std::map<int, int> number;  // of the branches that are in the band somewhere; 0: to be given
  for (const auto& station : stations)
    for (std::size_t i = 0; i < station.pairs.size(); ++i)
      if (station.inBand[i]) number.emplace(station.branch[i], 0);
  const Order order(stations);
  count = 0;
  for (std::size_t k = 0; k < stations.size(); ++k) {
    std::vector<int> fresh;
    for (int branch : stations[k].branch)
      if (const auto entry = number.find(branch); entry != number.end() && entry->second == 0)
        fresh.push_back(branch);
    order.apply(fresh, k);
    for (int branch : fresh) number[branch] = ++count;
  }
  const auto of = [&](int branch) {
    const auto entry = number.find(branch);
    return entry == number.end() ? 0 : entry->second;
  };
  for (auto& station : stations)
    for (int& branch : station.branch) branch = of(branch);
  for (auto& event : events) {
    event.branch = of(event.branch);
    event.partner = event.partner < 0 ? 0 : of(event.partner);
  }
  std::erase_if(events, [](const Event& event) { return event.branch == 0; });
}

}  // namespace squeal::tracking
