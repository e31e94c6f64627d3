// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Reduced models made by hand, and the tube on a shaft whose stick-slip waves are known exactly
/// (after Moirot, Nguyen and Oueslati, Eur. J. Mech. A/Solids 22, 2003).
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include "regime/march/model.hpp"
#include "regime/march/scheme.hpp"

namespace squeal::test {

using march::ReducedModel;
using march::Start;

/// Returns a model with these numbers of modes and nodes, all matrices zero, in the plane.
inline ReducedModel emptyModel(PetscInt modes, PetscInt nodes) {
  ReducedModel model;
  model.dimension = 2;
  model.nodes.resize(nodes);
  model.stiffness.resize(modes);
  model.damping = linalg::DenseMatrix(modes, modes);
  const PetscInt rows = 2 * nodes;
  model.jump = model.couplingDamping = model.couplingStiffness = linalg::DenseMatrix(rows, modes);
  model.boundaryMass = model.boundaryDamping = model.boundaryStiffness =
      linalg::DenseMatrix(rows, rows);
  model.moves.assign(rows, 1);
  return model;
}

/// Sets a node that slides with the velocity v against a friction force.
inline void slide(march::Node& node, double friction, double normalForce, double v) {
  node.friction = node.lawCoefficient = friction, node.normalForce = normalForce;
  node.shear[0] = -friction * normalForce, node.velocity[0] = v;
}

/// The mass on a belt of Hoffmann, Fischer, Allgaier and Gaul (2002),
///   ẍ + 0.05 ẋ + 2 x + y = F,   ÿ + 0.05 ẏ + x + 2 y = 0,
/// with the contact spring k₃ = 4/3 among the stiffnesses of y. Its end, which has no mass, lifts
/// off where the spring would pull; F* = −R_T* of the belt, which runs with v, under the preload 1.
/// The modes are (1, ±1)/√2 with Λ = 3 and 1; the gap z compresses the spring: K_z = k₃, K_zq = k₃
/// y.
inline ReducedModel massOnBelt(double v) {
  constexpr double spring = 4.0 / 3, root = 0.70710678118654752440;
  ReducedModel model = emptyModel(2, 1);
  model.stiffness = {3, 1};
  model.damping(0, 0) = model.damping(1, 1) = 0.05;
  model.boundaryStiffness(0, 0) = spring;
  model.couplingStiffness(0, 0) = spring * root, model.couplingStiffness(0, 1) = -spring * root;
  // The slip is −x; a stiff spring in series stands for none.
  model.jump(1, 0) = model.jump(1, 1) = -root;
  model.boundaryStiffness(1, 1) = 1e9;
  slide(model.nodes[0], 0.9, 1, v);
  model.nodes[0].sweptFriction = 1;
  return model;
}

/// A tube of an elastic material, outside held, on a shaft that turns with speed 1, its
/// displacements X(r) U(θ, t) and X(r) V(θ, t) with X = (ξ/r − 1)/(ξ − 1):
///   Ü − b U″ + d V′ + g U = P,   V̈ − a V″ − d U′ + h V = Q.
struct Tube {
  double a, b, d, g, h;
};

/// Returns the coefficients by Galerkin's method in the plane, lengths over R, times over
/// R √(ρ/(λ + 2μ)): with ε_r = X′U, ε_θ = X (V′ + U)/r, γ = X U′/r + X′ V − X V/r, and the moduli
/// 1 = λ + 2μ, λ and μ, each over the mass ∫ X² r dr.
inline Tube tubeOf(double xi, double poisson) {
  const double lambda = poisson / (1 - poisson), mu = (1 - 2 * poisson) / (2 - 2 * poisson);
  double mass = 0, xx = 0, xdx = 0, dxdx = 0;  // ∫ X² r, ∫ X²/r, ∫ X X′, ∫ X′² r
  constexpr int points = 20'000;
  for (int i = 0; i < points; ++i) {
    const double step = (xi - 1) / points, r = 1 + (i + 0.5) * step;
    const double x = (xi / r - 1) / (xi - 1), dx = -xi / (r * r) / (xi - 1);
    mass += step * x * x * r, xx += step * x * x / r, xdx += step * x * dx,
        dxdx += step * dx * dx * r;
  }
  Tube tube;
  tube.a = xx / mass;
  tube.b = mu * xx / mass;
  tube.d = ((1 + mu) * xx + (lambda - mu) * xdx) / mass;
  tube.g = (dxdx + 2 * lambda * xdx + xx) / mass;
  tube.h = mu * (dxdx - 2 * xdx + xx) / mass;
  return tube;
}

/// The stick-slip wave V = f g δ/h + Y(φ)/c, φ = θ + c t, of a tube in contact everywhere. It slips
/// on (0, L): (c² − a) Y″ − f d Y′ + h Y = 0 from Y = f d/h, Y′ = 1 to Y′ = 1, Y = f d/h − (2π/k −
/// L), and sticks on the rest, Y′ = 1.
struct Wave {
  double c = 0, slipLength = 0, wavelength = 0;
  std::complex<double> root, factor;  // Y = Re(factor e^{root φ})
  double stickFraction() const { return 1 - slipLength / wavelength; }
  double y(double phi) const {
    return phi < slipLength ? (factor * std::exp(root * phi)).real()
                            : (factor * std::exp(root * slipLength)).real() + phi - slipLength;
  }
  double slope(double phi) const {
    return phi < slipLength ? (root * factor * std::exp(root * phi)).real() : 1;
  }
};

/// Solves for c and L by Newton's method from a guess of ω = k c and the stick fraction.
inline Wave waveOf(const Tube& tube, int k, double f, double omega, double stick) {
  Wave wave;
  wave.wavelength = 2 * M_PI / k;
  const auto at = [&](double c, double length) {
    wave.c = c, wave.slipLength = length;
    const double m = c * c - tube.a, half = f * tube.d / (2 * m);
    wave.root = half + std::sqrt(std::complex<double>(half * half - tube.h / m));
    // Re(factor) = f d/h and Re(root factor) = 1.
    const double y0 = f * tube.d / tube.h;
    wave.factor = {y0, (wave.root.real() * y0 - 1) / wave.root.imag()};
    return std::array{wave.slope(length - 1e-15) - 1,
                      wave.y(length) - y0 + wave.wavelength - length};
  };
  double c = omega / k, length = (1 - stick) * wave.wavelength;
  for (int step = 0; step < 50; ++step) {
    constexpr double e = 1e-7;
    const auto r = at(c, length), rc = at(c + e, length), rl = at(c, length + e);
    const double a11 = (rc[0] - r[0]) / e, a12 = (rl[0] - r[0]) / e, a21 = (rc[1] - r[1]) / e,
                 a22 = (rl[1] - r[1]) / e, det = a11 * a22 - a12 * a21;
    c -= (a22 * r[0] - a12 * r[1]) / det, length -= (a11 * r[1] - a21 * r[0]) / det;
  }
  at(c, length);
  return wave;
}

/// One wavelength of a tube with linear cells and lumped masses: U and V of all nodes are z. A
/// viscosity η adds −η U̇″ and −η V̇″ to the left sides of its equations.
struct TubeModel {
  ReducedModel model;
  double spacing;
};
inline TubeModel tubeModel(const Tube& tube, int k, double f, double delta, int count,
                           double viscosity) {
  TubeModel result{emptyModel(0, count), 2 * M_PI / k / count};
  ReducedModel& model = result.model;
  const double s = result.spacing;
  // The slip is −V, since the shaft drags the tube along +V.
  for (int i = 0; i < count; ++i) {
    const int u[2] = {2 * i, 2 * ((i + 1) % count)};
    auto& stiff = model.boundaryStiffness;
    for (int p = 0; p < 2; ++p) {
      stiff(u[p], u[p]) += tube.g * s / 2, stiff(u[p] + 1, u[p] + 1) += tube.h * s / 2;
      model.boundaryMass(u[p], u[p]) += s / 2, model.boundaryMass(u[p] + 1, u[p] + 1) += s / 2;
      for (int q = 0; q < 2; ++q) {
        const double sign = p == q ? 1 : -1;
        stiff(u[p], u[q]) += sign * tube.b / s;
        stiff(u[p] + 1, u[q] + 1) += sign * tube.a / s;
        for (int c = 0; c < 2; ++c)
          model.boundaryDamping(u[p] + c, u[q] + c) += sign * viscosity / s;
        // −d ∫ (V δU′ + U′ δV), with V the mean of its ends in a cell, and −V the unknown.
        const double slope = (p == 0 ? -1 : 1) / s;
        stiff(u[p], u[q] + 1) += tube.d * slope * s / 2;
        stiff(u[q] + 1, u[p]) += tube.d * slope * s / 2;
      }
    }
  }
  for (auto& node : model.nodes) slide(node, f, tube.g * delta * s, 1), node.area = s;
  return result;
}

/// The phase of the first harmonic of the slips, and the numbers of open and sticking nodes.
inline std::complex<double> harmonic(const std::vector<double>& jump, int row) {
  const int count = jump.size() / 2;
  std::complex<double> sum = 0;
  for (int i = 0; i < count; ++i) sum += jump[2 * i + row] * std::polar(1.0, 2 * M_PI * i / count);
  return sum;
}

struct Marched {
  double omega = 0, stick = 0, open = 0;
};
/// A node is open if it carries no force and lies above the shaft: in a scheme with conditions on
/// velocities, a node that is below it by round-off may carry its force only in some steps.
inline Marched marched(const ReducedModel& model, const Start& start, double h, double settle,
                       double measure) {
  const auto scheme = march::moreauScheme(model, start, h);
  while (scheme->state().time < settle) scheme->step();
  Marched result;
  const double from = scheme->state().time;
  double turned = 0;
  long nodes = 0;
  std::complex<double> before = harmonic(scheme->state().jump, 1);
  while (scheme->state().time < from + measure) {
    scheme->step();
    const auto now = harmonic(scheme->state().jump, 1);
    turned += std::arg(now / before);
    before = now;
    for (std::size_t i = 0; i < model.nodes.size(); ++i, ++nodes) {
      const bool open = scheme->state().force[2 * i] == 0 && scheme->state().jump[2 * i] >= 0;
      result.open += open;
      result.stick += !open && std::abs(scheme->state().rate[2 * i + 1]) < 1e-6;
    }
  }
  result.omega = std::abs(turned) / (scheme->state().time - from);
  result.stick /= nodes, result.open /= nodes;
  return result;
}

inline Start onWave(const Wave& wave, const ReducedModel& model) {
  Start start;
  const int count = model.nodes.size();
  for (int i = 0; i < count; ++i) {
    const double phi = wave.wavelength * i / count;
    start.z.push_back(0), start.z.push_back(-wave.y(phi) / wave.c);
    start.zRate.push_back(0), start.zRate.push_back(-wave.slope(phi));
  }
  return start;
}

}  // namespace squeal::test
