// SPDX-License-Identifier: BSD-2-Clause
#include "regime/sound/spectrum.hpp"

#include <fftw3.h>

#include <cmath>

namespace squeal::sound {

void addPower(std::span<const double> signal, std::vector<double>& power) {
  const int n = signal.size();
  std::vector<double> in(n);
  std::vector<fftw_complex> out(n / 2 + 1);
  fftw_plan plan = fftw_plan_dft_r2c_1d(n, in.data(), out.data(), FFTW_ESTIMATE);
  for (int i = 0; i < n; ++i) in[i] = signal[i] * (0.5 - 0.5 * std::cos(2 * M_PI * i / n));
  fftw_execute(plan);
  fftw_destroy_plan(plan);
  power.resize(n / 2 + 1);
  // A sine of amplitude a gives n a / 4 in its line.
  for (int i = 0; i <= n / 2; ++i)
    power[i] += (out[i][0] * out[i][0] + out[i][1] * out[i][1]) * 16.0 / n / n;
}

std::vector<double> amplitudes(std::span<const double> signal) {
  std::vector<double> result;
  addPower(signal, result);
  for (double& line : result) line = std::sqrt(line);
  return result;
}

}  // namespace squeal::sound
