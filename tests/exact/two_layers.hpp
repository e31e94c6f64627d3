// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Two elastic layers of period Lx = 3 in plane strain, one sliding on the other: the disc, −1 ≤ y
/// ≤ 0, clamped at y = −1, whose matter moves along +x, and the pad, 0 ≤ y ≤ 0.6, held at y = 0.6.
/// In the tables the speed enters the direction of friction alone (approximation A); the
/// characteristic equation holds for moving matter and for friction that follows the speed as well.
#include "eigen/pencil/complex_modes.hpp"
#include "exact/waves.hpp"

namespace squeal::exact::two_layers {

inline constexpr Material disc{1, 0.3, 1}, pad{0.4, 0.25, 0.6};
inline constexpr double discThickness = 1, padThickness = 0.6, period = 3;

/// Steady sliding, the top of the pad displaced down by `depth`: uniform strain in each layer, the
/// same normal stress −p and shear stress in both. The shortenings p h/(λ+2μ) of the layers add up
/// to `depth`; the disc drags the pad along +x with f p: σ_xy = f σ_yy = −f p, and u = 0 where the
/// layers are held.
struct Steady {
  double friction, depth;
  double padThickness = two_layers::padThickness;
  double softness = 0;  ///< 1/k of a soft layer between the two, m³/N
  double pressure() const {
    return depth / (discThickness / disc.uniaxial() + padThickness / pad.uniaxial() + softness);
  }
  double u(double y, bool inPad) const {
    return inPad ? friction * pressure() / pad.mu() * (padThickness - y)
                 : -friction * pressure() / disc.mu() * (y + discThickness);
  }
  double v(double y, bool inPad) const {
    return inPad ? -depth + pressure() / pad.uniaxial() * (padThickness - y)
                 : -pressure() / disc.uniaxial() * (y + discThickness);
  }
};

/// The effect on the waves of steady sliding under the pressure p, the disc's matter moving at W >
/// 0; φ is the friction law.
struct Sliding {
  double friction = 0;  ///< f φ(W)
  double along = 0;     ///< f φ'(W) p, Pa·s/m: change of the friction stress with the relative
                        ///< velocity along the sliding direction
  double across = 0;  ///< f φ(W) p / W, Pa·s/m: the same across it, where the stress turns with the
                      ///< relative velocity
  double carried = 0;  ///< W, m/s, where matter carries its displacement along; 0: approximation A
  double padThickness = two_layers::padThickness;
  double softness = 0;  ///< 1/k, m³/N: a massless layer that the normal stress compresses by σ/k

  double k(int n) const { return 2 * M_PI * n / period; }
  /// D u + u_t = (s + ikW) u: as s in the disc at rest, for its axes travel with the matter.
  Complex discRate(int n, Complex s) const { return s + Complex(0, k(n) * carried); }
};

/// Zero where s is an eigenvalue of wave number index n: u = v = 0 where the layers are held; σ_yy
/// continuous, v_P − v_D = σ_yy/k, and on both sides of the interface σ_xy = f φ σ_yy + f φ' p w*:
/// the pad, whose outer normal is −y, is drawn along +x with −σ_xy, pressed with R_N = −σ_yy, and
/// w* = s u_P − (s
/// + ikW) u_D adds to w = −W, so that it lowers the sliding speed. [4.7] A layer whose rate is zero
/// has a = b, where only two of its four potentials differ in displacement: a fourfold zero of the
/// determinant that is not an eigenvalue, divided out.
inline Complex characteristic(const Sliding& sliding, int n, Complex s) {
  const double k = sliding.k(n);
  const Complex discRate = sliding.discRate(n, s);
  const Waves bottom = wavesAt(disc, k, discRate, -discThickness),
              below = wavesAt(disc, k, discRate, 0);
  const Waves above = wavesAt(pad, k, s, 0), top = wavesAt(pad, k, s, sliding.padThickness);
  Matrix<8> conditions{};
  for (std::size_t j = 0; j < 4; ++j) {
    conditions[0][j] = bottom.u[j], conditions[1][j] = bottom.v[j];
    conditions[2][4 + j] = top.u[j], conditions[3][4 + j] = top.v[j];
    conditions[4][j] = below.v[j] + sliding.softness * below.yy[j],
    conditions[4][4 + j] = -above.v[j];
    conditions[5][j] = below.yy[j], conditions[5][4 + j] = -above.yy[j];
    conditions[6][j] =
        below.xy[j] - sliding.friction * below.yy[j] + sliding.along * discRate * below.u[j];
    conditions[6][4 + j] = -sliding.along * s * above.u[j];
    conditions[7][j] = sliding.along * discRate * below.u[j];
    conditions[7][4 + j] =
        above.xy[j] - sliding.friction * above.yy[j] - sliding.along * s * above.u[j];
  }
  return determinant(conditions) / std::pow(s * discRate, 4);
}

// The lowest eigenvalues with Im s ≥ 0 by ascending Im s: roots of the characteristic equation for
// all n, converged to 1e-8 or better.

/// f = 0.1
inline constexpr std::array<Eigenvalue, 30> friction01{{
    {0, 0, 0.97416652744},
    {0, 0, 1.35192622526},
    {1, -5.8183788984e-03, 1.95764988226},
    {-1, 5.8183788980e-03, 1.95764988226},
    {0, 0, 1.96165178465},
    {-1, 1.5978651984e-03, 2.2269235958},
    {1, -1.5978652015e-03, 2.2269235958},
    {-1, 5.0724461958e-04, 2.41482739745},
    {1, -5.0724461962e-04, 2.41482739745},
    {-2, 9.8148024739e-04, 2.58047862043},
    {2, -9.8148024743e-04, 2.58047862043},
    {0, 0, 2.92249958232},
    {3, 1.2055287125e-02, 3.52354249581},
    {-3, -1.2055287126e-02, 3.52354249581},
    {-2, -3.3427193462e-02, 3.58184531094},
    {2, 3.3427193463e-02, 3.58184531094},
    {-1, 2.7272816829e-03, 3.59193505731},
    {1, -2.7272816827e-03, 3.59193505731},
    {2, -2.0725558323e-02, 3.91621054829},
    {-2, 2.0725558324e-02, 3.91621054829},
    {0, 0, 4.05577867599},
    {-1, -5.8814305477e-02, 4.16755502029},
    {1, 5.8814305477e-02, 4.16755502029},
    {0, 0, 4.27637722803},
    {-3, -2.4943791987e-02, 4.50001998478},
    {3, 2.4943791979e-02, 4.50001998479},
    {-4, -2.4340710190e-02, 4.53713327078},
    {4, 2.4340710190e-02, 4.53713327078},
    {-2, -9.1644661855e-03, 4.65432204308},
    {2, 9.1644661836e-03, 4.65432204308},
}};

/// f = 0.3
inline constexpr std::array<Eigenvalue, 30> friction03{{
    {0, 0, 0.974166527442},
    {0, 0, 1.3519262253},
    {1, -1.7466859809e-02, 1.95742019332},
    {-1, 1.7466859809e-02, 1.95742019332},
    {0, 0, 1.96165178465},
    {-1, 4.7581604999e-03, 2.22650870626},
    {1, -4.7581605000e-03, 2.22650870626},
    {-1, 1.5059632759e-03, 2.41468042139},
    {1, -1.5059632758e-03, 2.41468042139},
    {2, -2.9295487068e-03, 2.58028521689},
    {-2, 2.9295487110e-03, 2.58028521689},
    {0, 0, 2.92249958232},
    {3, 3.6082395115e-02, 3.52580798288},
    {-3, -3.6082395116e-02, 3.52580798289},
    {-2, -9.5046468647e-02, 3.5709040255},
    {2, 9.5046468647e-02, 3.5709040255},
    {1, -7.8089097376e-03, 3.59038573377},
    {-1, 7.8089097376e-03, 3.59038573377},
    {2, -5.6950823131e-02, 3.92772601876},
    {-2, 5.6950823130e-02, 3.92772601876},
    {0, 0, 4.05577867597},
    {-1, -1.6851276882e-01, 4.14865604435},
    {1, 1.6851276882e-01, 4.14865604435},
    {0, 0, 4.27637722804},
    {-3, -7.4643128555e-02, 4.4959279195},
    {3, 7.4643128555e-02, 4.4959279195},
    {-4, -7.3034341042e-02, 4.539853126},
    {4, 7.3034341038e-02, 4.539853126},
    {2, 2.7485887211e-02, 4.65413007069},
    {-2, -2.7485887224e-02, 4.6541300707},
}};

/// f = 0.5
inline constexpr std::array<Eigenvalue, 30> friction05{{
    {0, 0, 0.974166527441},
    {0, 0, 1.3519262253},
    {1, -2.9149287694e-02, 1.95695126008},
    {-1, 2.9149287693e-02, 1.95695126009},
    {0, 0, 1.96165178466},
    {-1, 7.8132745088e-03, 2.22569228735},
    {1, -7.8132745094e-03, 2.22569228735},
    {1, -2.4588302109e-03, 2.41439503445},
    {-1, 2.4588302108e-03, 2.41439503445},
    {-2, 4.8337888305e-03, 2.57990461384},
    {2, -4.8337888313e-03, 2.57990461384},
    {0, 0, 2.92249958231},
    {-3, -5.9855982463e-02, 3.53034801625},
    {3, 5.9855982463e-02, 3.53034801625},
    {-2, -1.4832447826e-01, 3.55666401054},
    {2, 1.4832447826e-01, 3.55666401054},
    {-1, 1.1958781158e-02, 3.58770953859},
    {1, -1.1958781158e-02, 3.58770953859},
    {2, -8.4862237018e-02, 3.94311141653},
    {-2, 8.4862237018e-02, 3.94311141653},
    {0, 0, 4.05577867598},
    {-1, -2.6290259126e-01, 4.12104758397},
    {1, 2.6290259126e-01, 4.12104758397},
    {0, 0, 4.27637722803},
    {3, 1.2378805498e-01, 4.48784039142},
    {-3, -1.2378805498e-01, 4.48784039142},
    {-4, -1.2176742107e-01, 4.54529504455},
    {4, 1.2176742106e-01, 4.54529504456},
    {-2, -4.5783882275e-02, 4.65373223198},
    {2, 4.5783882275e-02, 4.65373223198},
}};

}  // namespace squeal::exact::two_layers
