// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Amplitudes of a signal by frequency.
#include <span>
#include <vector>

namespace squeal::sound {

/// Adds the squared amplitudes, 0 to peak, of a signal with a Hann window to `power`, [line]. The
/// frequency of line i is i over the duration of the signal.
void addPower(std::span<const double> signal, std::vector<double>& power);

/// Returns the amplitudes, 0 to peak, of a signal with a Hann window, [line].
std::vector<double> amplitudes(std::span<const double> signal);

}  // namespace squeal::sound
