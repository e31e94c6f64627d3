// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The amplitude spectrum of a signal.
#include <span>
#include <vector>

namespace squeal::sound {

/// Applies a Hann window to a signal, and adds the squares of its amplitudes (0 to peak) to
/// `power`, [line]. The frequency of line i is i divided by the duration of the signal.
void addPower(std::span<const double> signal, std::vector<double>& power);

/// Applies a Hann window to a signal, and returns its amplitudes (0 to peak), [line].
std::vector<double> amplitudes(std::span<const double> signal);

}  // namespace squeal::sound
