// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/contact_path.hpp"

#include <algorithm>

#include "base/system/concatenation.hpp"

namespace squeal::analysis {

std::vector<PathEvent> contactPath(const Analysis& analysis) {
  std::vector<PathEvent> own;
  for (const auto& event : analysis.steady.path) {
    const auto& node = analysis.model.contact.interfaces.nodes[event.node];
    own.push_back({event.order, event.at, node.position, node.interface, event.change});
  }
  auto events = concatenated(analysis.comm, own);
  std::ranges::sort(events, [](const auto& a, const auto& b) {
    return a.order != b.order ? a.order < b.order : a.position < b.position;
  });
  return events;
}

}  // namespace squeal::analysis
