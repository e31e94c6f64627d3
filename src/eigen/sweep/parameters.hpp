// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The parameters that a sweep varies.
#include <array>
#include <string>
#include <vector>

namespace squeal::sweep {

/// One point of a sweep.
struct Parameters {
  double friction = 0;  ///< f, coefficient of friction
  double speed = 1;     ///< v, a factor on the base motions of all bodies and obstacles
  double pressure = 1;  ///< p, a factor on surface pressures, forces, moments, held displacements
                        ///< and displacements of obstacles
  double damping = 1;   ///< c, a factor on the damping of materials, dashpots and modes, but not
                        ///< on friction damping

  bool operator==(const Parameters&) const = default;
};

/// The name of a parameter, and its member.
struct Parameter {
  const char* name;
  double Parameters::*value;
};
/// All parameters, in their order in tables and names.
inline constexpr std::array<Parameter, 4> allParameters{{{"friction", &Parameters::friction},
                                                         {"speed", &Parameters::speed},
                                                         {"pressure", &Parameters::pressure},
                                                         {"damping", &Parameters::damping}}};

/// Returns the parameters that do not have the same value at all points.
std::vector<Parameter> sweptParameters(const std::vector<Parameters>& points);
/// Returns true if `at` has a larger friction than `before` and equal other parameters.
bool growsInFriction(const Parameters& before, const Parameters& at);
/// Returns the header row of a comma-separated table, "friction,speed,…".
std::string parameterColumns();
/// Returns the values in the row of this table for a point.
std::string parameterValues(const Parameters& at);
/// Returns a text such as "friction 0.4, speed 2" for messages; factors of 1 are omitted.
std::string parameterText(const Parameters& at, int digits = 6);

}  // namespace squeal::sweep
