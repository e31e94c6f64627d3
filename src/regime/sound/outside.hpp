#pragma once
/// What a regime does outside the contact [M.76]: the sound that the visible surface radiates,
/// spectra of the velocity at points of it, and displacements of the latest cycles.
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "algebra/linalg/block.hpp"
#include "model/contact/contact.hpp"
#include "regime/sound/latest.hpp"
#include "regime/sound/settings.hpp"
#include "regime/sound/surface.hpp"

namespace squeal::sound {

/// An estimate of the sound power; NaN where there is none, without samples or a visible surface.
struct Sound {
  double meanSquareVelocity = NAN;  ///< ⟨v_n²⟩ over the surface and the time, m²/s²
  double area = NAN;                ///< of the visible surface, m² (m in the plane)
  double power = NAN;               ///< ρc S ⟨v_n²⟩, W (W/m in the plane)
  double level = NAN;               ///< dB re 1e-12 W
};

/// The amplitudes of one line: components x, y, z and the one along the normal, 0 to peak, m/s.
using Amplitudes = std::array<double, 4>;

/// A node of the visible surface as a laser vibrometer sees it.
struct SurfacePoint {
  std::string name;  ///< "largest", or "1", "2", … of -regime_spectrum_points
  Point position{}, normal{};
  double meanSquareVelocity = 0;      ///< of all components, m²/s²
  std::vector<Amplitudes> amplitude;  ///< [line] by frequency, as amplitudes() has them
};

/// The motion of the latest cycles about steady sliding.
struct Frames {
  std::vector<double> time;                   ///< [frame] s
  linalg::Block displacement;                 ///< V q + Ψ z, [frame], this rank's rows, m
  std::vector<std::vector<double>> gap;       ///< [frame][contact node of this rank] m
  std::vector<std::vector<double>> pressure;  ///< likewise, Pa
};

struct Outside {
  Sound sound;
  std::vector<SurfacePoint> points;
  Frames frames;
};

/// What leads from a reduced model back to the mesh; all of it is borrowed.
struct Shapes {
  const linalg::Block& modes;      ///< V, nodal displacements, this rank's rows
  const linalg::Block& responses;  ///< Ψ, as V
  /// [node of the model] its place among the contact nodes of this rank; −1 on other ranks
  const std::vector<PetscInt>& contactNode;
};

/// An Observer sees marches of one reduced model from outside. All of its methods are collective.
class Observer {
 public:
  /// The contact is borrowed.
  Observer(const contact::Contact& contact, const Shapes& shapes, const Settings& settings);
  /// Returns what is seen of a march, of which the rank `root` has the trace.
  Outside of(int root, const Trace& trace) const;

 private:
  /// A node that any rank may choose.
  struct Choice {
    double measure;  // the smallest is chosen
    Point position{};
    PetscInt node = -1;  // local node of its owner
  };
  Sound soundOf(const DenseMatrix& meanSquares) const;
  SurfacePoint pointOf(const std::vector<Choice>& own, double tolerance,
                       const DenseMatrix& meanSquares, DenseMatrix& shape) const;
  std::vector<Choice> byVelocity(const DenseMatrix& meanSquares) const;
  std::vector<Choice> byDistance(const Point& place) const;
  DenseMatrix rowsOf(std::span<const PetscInt> nodes) const;
  void addSpectra(int root, const Trace& trace, const DenseMatrix& meanSquares,
                  std::vector<SurfacePoint>& points) const;
  Frames framesOf(const std::vector<Sample>& samples) const;

  const contact::Contact& contact_;
  Shapes shapes_;
  Settings settings_;
  Surface surface_;
  DenseMatrix radiation_;  // ∫ (n·φ_i)(n·φ_j) dA of the modes
};

}  // namespace squeal::sound
