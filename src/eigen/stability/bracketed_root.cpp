// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/stability/bracketed_root.hpp"

#include <algorithm>
#include <cmath>

namespace squeal::stability {

void BracketedRoot::take(double value) {
  const double x = next();
  if ((value > 0) == (a_.value > 0)) {
    c_ = a_;
  } else {
    c_ = b_;
    b_ = a_;
  }
  a_ = {x, value};
  const double limit = tolerance_ / std::abs(b_.at - a_.at);
  done_ = value == 0 || limit > 0.5 || ++count_ == 100;
  if (done_) return;
  const double fa = a_.value, fb = b_.value, fc = c_.value;
  const double xi = (a_.at - b_.at) / (c_.at - b_.at), phi = (fa - fb) / (fc - fb);
  part_ = 0.5;
  if (phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi)
    part_ = fa / (fb - fa) * fc / (fb - fc) +
            (c_.at - a_.at) / (b_.at - a_.at) * fa / (fc - fa) * fb / (fc - fb);
  part_ = std::clamp(part_, limit, 1 - limit);
}

double BracketedRoot::root() const {
  return std::abs(a_.value) < std::abs(b_.value) ? a_.at : b_.at;
}

}  // namespace squeal::stability
