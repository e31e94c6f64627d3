// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The motion of the visible surface of the bodies after flutter [M.76]: the radiated sound,
/// velocity spectra at points of the surface, and the displacements of the latest cycles.
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "algebra/linalg/block.hpp"
#include "model/contact/contact.hpp"
#include "regime/sound/recent_history.hpp"
#include "regime/sound/settings.hpp"
#include "regime/sound/surface.hpp"

namespace squeal::sound {

/// An estimate of the sound power; NaN without samples or without a visible surface.
struct Sound {
  double meanSquareVelocity = NAN;  ///< ⟨v_n²⟩, the mean over surface and time, m²/s²
  double area = NAN;                ///< S, area of the visible surface, m² (m in plane problems)
  double power = NAN;               ///< ρc S ⟨v_n²⟩, W (W/m in plane problems)
  double level = NAN;               ///< dB re 1e-12 W
};

/// The velocity amplitudes of one spectral line: components along x, y, z and along the normal, 0
/// to peak, m/s.
using Amplitudes = std::array<double, 4>;

/// A node of the visible surface with a velocity spectrum, as a laser vibrometer would measure it.
struct SpectrumPoint {
  std::string name = {};  ///< "largest", or "1", "2", … of -regime_spectrum_points
  Point position{}, normal{};
  double meanSquareVelocity = 0;           ///< sum over the components, m²/s²
  std::vector<Amplitudes> amplitude = {};  ///< [line], with the frequencies of amplitudes()
};

/// The motion of the latest cycles relative to steady sliding. Gap and pressure include their
/// steady values.
struct Frames {
  std::vector<double> time;                   ///< [frame] s
  linalg::Block displacement;                 ///< V q + Ψ z, [frame], this rank's rows, m
  std::vector<std::vector<double>> gap;       ///< [frame][contact node of this rank] m
  std::vector<std::vector<double>> pressure;  ///< likewise, Pa
};

struct VisibleSurface {
  Sound sound = {};
  std::vector<SpectrumPoint> points = {};
  Frames frames = {};
};

/// The vectors of nodal displacements in a reduced model; all members are borrowed.
struct Shapes {
  const linalg::Block& modes;      ///< V, columns of nodal displacements, this rank's rows
  const linalg::Block& responses;  ///< Ψ, likewise
  /// [node of the model] its index among the contact nodes of this rank; −1 if another rank has it
  const std::vector<PetscInt>& contactNode;
};

/// Computes the motion of the visible surface from time integrations of one reduced model. All
/// methods are collective.
class Observer {
 public:
  /// Borrows the contact.
  Observer(const contact::Contact& contact, const Shapes& shapes, const Settings& settings);
  /// Returns the results for the time integration that the rank `root` computed. `trace` is the
  /// history of this time integration; it is used only on `root`.
  VisibleSurface of(int root, const Trace& trace) const;

 private:
  /// A node of the surface. The candidate with the smallest `measure` over all ranks is chosen.
  struct Candidate {
    double measure;
    Point position{};
    PetscInt node = -1;  // local node of its owner
  };
  /// A chosen node and its rows of V.
  struct Observed {
    SpectrumPoint point;
    DenseMatrix shape;
  };
  Sound soundOf(const DenseMatrix& meanSquares) const;
  Observed observed(const std::vector<Candidate>& own, double tolerance) const;
  std::vector<Candidate> byVelocity(const DenseMatrix& meanSquares) const;
  std::vector<Candidate> byDistance(const Point& place) const;
  DenseMatrix rowsOf(std::span<const PetscInt> nodes) const;
  std::vector<Amplitudes> spectrum(const Observed& node, const DenseMatrix& velocities) const;
  std::vector<SpectrumPoint> spectrumPoints(int root, const Trace& trace,
                                            const DenseMatrix& meanSquares) const;
  Frames framesOf(const std::vector<Sample>& samples) const;

  const contact::Contact& contact_;
  Shapes shapes_;
  Settings settings_;
  RadiatingSurface surface_;
  DenseMatrix radiation_;  // ∫ (n·φ_i)(n·φ_j) dA of the modes φ
};

}  // namespace squeal::sound
