// SPDX-License-Identifier: BSD-2-Clause
#include "regime/regime/signals.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "regime/regime/statistics.hpp"
#include "regime/sound/spectrum.hpp"

namespace squeal::regime {

ModalSignals::ModalSignals(PetscInt modes, double period, double step)
    : signals_(modes), step_(step), stride_(std::max(1, int(period / 16 / step))) {}

void ModalSignals::add(const std::vector<double>& velocities) {
  if (++seen_ % stride_ != 0) return;
  constexpr std::size_t mostSamples = 32 * 1024;  // at least the latest thousand cycles
  for (std::size_t i = 0; i < signals_.size(); ++i) {
    auto& signal = signals_[i];
    if (signal.size() >= mostSamples)
      signal.erase(signal.begin(), signal.begin() + mostSamples / 2);
    signal.push_back(velocities[i]);
  }
}

std::size_t ModalSignals::count(double time) const {
  const std::size_t wanted = time / sampleTime(),
                    count = signals_.empty() ? 0 : std::min(wanted, signals_[0].size());
  return count < 8 ? 0 : count;
}

DenseMatrix ModalSignals::latest(std::size_t count) const {
  DenseMatrix result(count);
  for (const auto& signal : signals_) result.append(std::span(signal).last(count));
  return result;
}

std::vector<double> ModalSignals::power(std::size_t count) const {
  std::vector<double> power;
  for (const auto& signal : signals_) sound::addPower(std::span(signal).last(count), power);
  return power;
}

std::vector<SpectralLine> ModalSignals::spectrum(std::size_t count) const {
  std::vector<SpectralLine> lines;
  if (count == 0) return lines;
  const double line = 1 / (count * sampleTime());
  for (const double square : power(count))
    lines.push_back({lines.size() * line, std::sqrt(square)});
  return lines;
}

double ModalSignals::carrier(std::size_t count) const {
  if (count == 0) return 0;
  return 1 / (count * sampleTime()) * peakPlace(power(count), 2);
}

}  // namespace squeal::regime
