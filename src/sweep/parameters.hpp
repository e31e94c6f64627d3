#pragma once
/// What a sweep varies.
#include <array>
#include <string>

namespace squeal::sweep {

/// One point of a sweep.
struct Parameters {
  double friction = 0;  ///< f, coefficient of friction
  double speed = 1;     ///< v, a factor on the base motions of all bodies and obstacles
  double pressure = 1;  ///< p, a factor on all that presses: surface pressures, held displacements,
                        ///< displacements of obstacles
  double damping = 1;   ///< a factor on the damping of the bodies: materials, dashpots, modal; not
                        ///< on that of friction

  bool operator==(const Parameters&) const = default;
};

struct Parameter {
  const char* name;
  double Parameters::*value;
};
/// All of them, in the order of tables and names.
inline constexpr std::array<Parameter, 4> allParameters{{{"friction", &Parameters::friction},
                                                         {"speed", &Parameters::speed},
                                                         {"pressure", &Parameters::pressure},
                                                         {"damping", &Parameters::damping}}};

/// Head of a comma-separated table, "friction,speed,…", and the values of one row.
std::string parameterColumns();
std::string parameterValues(const Parameters& at);
/// "friction 0.4, speed 2": for messages; factors of 1 are left out.
std::string parameterText(const Parameters& at);

}  // namespace squeal::sweep
