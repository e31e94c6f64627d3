// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// A brake of three steel parts: a pad on either side of a disc, pressed on by a uniform pressure
/// and held only by springs.
#include <cmath>
#include <string>

#include "base/system/text.hpp"
#include "support/model/model.hpp"

namespace squeal::test::steel_brake {

inline constexpr double pressure = 1e6;

/// Springs of `spring` N/m along x and along y hold each pad.
inline std::string options(int order, double size, double spring) {
  std::string text = formatted(
                         "-mesh_file meshes/steel_brake.geo -mesh_set order=%d,size=%g "
                         "-constraint_bore_clamped xyz ",
                         order, size) +
                     "-motion_disc_speed 5 -motion_disc_axis 0,0,1 -motion_disc_origin 0,0,0 "
                     "-load_centrifugal off" +
                     material("disc", "2.1e11", "0.3", "7850");
  for (const std::string pad : {"upper", "lower"})
    text += material(pad, "2.1e11", "0.3", "7850") +
            formatted(
                "-load_%s_back_pressure %g -ground_%s_back_stiffness %g,%g,0 -contact_%s_pad "
                "%s_face -contact_%s_disc %s_face ",
                pad.c_str(), pressure, pad.c_str(), spring, spring, pad.c_str(), pad.c_str(),
                pad.c_str(), pad.c_str());
  return text;
}

/// Area of a pad, a sector of a ring. Cells of h = 0.022 m make polygons of its arcs, at worst:
/// (h/r)²/12, 0.2 %, of the area is missing.
inline constexpr double padArea = M_PI / 6 * (0.145 * 0.145 - 0.085 * 0.085);

}  // namespace squeal::test::steel_brake
