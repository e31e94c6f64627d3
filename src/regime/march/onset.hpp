// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The onset of nonlinearity. The motion of a growing mode is linear until a contact node
/// separates, a sliding node comes to rest, or a sticking node slides [M.75].
#include <span>
#include <string>
#include <vector>

#include "algebra/linalg/complex.hpp"
#include "regime/march/model.hpp"

namespace squeal::march {

/// The complex amplitudes of a mode at one contact node.
struct NodeMotion {
  Complex normalForce;             ///< R_N*, N
  std::array<Complex, 2> shear{};  ///< R_T* along the tangents, N
  std::array<Complex, 2> rate{};   ///< w* along the tangents, m/s
};

enum class OnsetEvent { none, opens, rests, slides };
const char* text(OnsetEvent event);

/// The first event of a growing mode u e^{st}.
struct Onset {
  OnsetEvent event = OnsetEvent::none;
  double factor = 0;     ///< factor on the given mode at which the event occurs
  std::size_t node = 0;  ///< index of the node of the event among the given nodes
  double turning = 0;    ///< largest |w*_⊥| / |w| of the sliding nodes at this factor
};

/// Not collective. Returns the first event. A closed node opens at |R_N*| = R_N. A sliding node
/// comes to rest at |τ·w*| = |w|. A sticking node slides when |R_T + R_T*| reaches f (R_N + R_N*)
/// at some phase.
Onset firstEvent(std::span<const Node> nodes, std::span<const NodeMotion> motion);

/// Not collective. Returns the amplitudes of a mode of the reduced model at its contact nodes,
/// [node].
std::vector<NodeMotion> motionAt(const ReducedModel& model, const LinearMode& mode);

/// Returns the largest kinetic energy over a cycle of the mode of the reduced model, J.
double largestKinetic(const LinearMode& mode);

}  // namespace squeal::march
