// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Samples of the modal velocities of a time integration, and their spectrum.
#include <vector>

#include "algebra/linalg/dense.hpp"

namespace squeal::regime {

using linalg::DenseMatrix;

/// One line of a spectrum, with the amplitude of the velocity (0 to peak). A quarter of the square
/// of `whole` is the mean kinetic energy of the line.
struct SpectralLine {
  double frequency = 0;  ///< Hz
  double whole = 0;      ///< mass-weighted amplitude of the whole model, √kg·m/s
};

/// Stores the latest samples of the modal velocities.
class ModalSignals {
 public:
  /// `period` is the period of a mode, s, and `step` the time step, s.
  ModalSignals(PetscInt modes, double period, double step);
  /// Call it with the modal velocities after each step.
  void add(const std::vector<double>& velocities);
  /// Returns the time between samples, s.
  double sampleTime() const { return stride_ * step_; }
  /// Returns the number of stored samples within the last `time` seconds; 0 if they are too few for
  /// a spectrum.
  std::size_t count(double time) const;
  /// Returns the latest `count` samples, samples × modes.
  DenseMatrix latest(std::size_t count) const;
  /// Returns the spectrum of the latest `count` samples. The squares of all modes are added.
  std::vector<SpectralLine> spectrum(std::size_t count) const;
  /// Returns the frequency of the largest line of the spectrum, Hz.
  double carrier(std::size_t count) const;

 private:
  std::vector<double> power(std::size_t count) const;

  std::vector<std::vector<double>> signals_;  // [mode] velocity at every `stride_`-th step
  double step_;
  int stride_;
  long seen_ = 0;
};

}  // namespace squeal::regime
