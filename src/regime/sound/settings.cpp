// SPDX-License-Identifier: BSD-2-Clause
#include "regime/sound/settings.hpp"

#include <algorithm>
#include <cmath>

#include "base/petsc/check.hpp"
#include "base/system/text.hpp"

namespace squeal::sound {
namespace {

const IntegerOption keptOption("regime", "regime_cycles_kept", 2, 0, 1000,
                               "number of periods of the flutter mode, at the end of the motion, "
                               "whose displacements are stored for an animation");
const IntegerOption framesOption("regime", "regime_frames", 16, 4, 1000,
                                 "number of stored frames per period (-regime_cycles_kept)");
const RealOption airOption("regime", "regime_air_impedance", 415, "N s/m3", positive,
                           "characteristic impedance of the air, density times speed of sound, for "
                           "the estimate of the sound power");
const TextOption pointsOption(
    "regime", "regime_spectrum_points", "",
    "points x,y,z; x,y,z; … in m; velocity spectra are reported at the nodes of the visible "
    "surface that are nearest to them; none: at the node with the largest motion");

/// Returns the point that a text such as "1,2,3" gives.
Point pointFrom(const std::string& text) {
  Point point{};
  const auto words = split(text, ',');
  bool right = words.size() == 2 || words.size() == 3;
  for (std::size_t d = 0; right && d < words.size(); ++d) {
    const std::string word = trimmed(words[d]);
    char* end = nullptr;
    point[d] = std::strtod(word.c_str(), &end);
    right = !word.empty() && *end == 0 && std::isfinite(point[d]);
  }
  if (!right)
    throw Error("option -" + pointsOption.name + ": '" + trimmed(text) +
                "' is not a point; give x,y,z, and semicolons between points");
  return point;
}

}  // namespace

int Settings::framesOfPeriod(double period, double step) const {
  const double steps = std::floor(period / step + 1e-6);
  return int(std::clamp(steps, 1.0, double(frames)));
}

Settings Settings::given() {
  Settings settings{.cyclesKept = keptOption.get()};
  if (framesOption.given() && settings.cyclesKept == 0)
    throw Error("option -" + framesOption.name + ": no period is stored (-" + keptOption.name +
                ")");
  settings.frames = framesOption.get();
  settings.airImpedance = airOption.get();
  for (const auto& item : split(trimmed(pointsOption.get()), ';'))
    settings.spectrumPoints.push_back(pointFrom(item));
  return settings;
}

std::vector<const Option*> Settings::options() {
  return {&keptOption, &framesOption, &airOption, &pointsOption};
}

}  // namespace squeal::sound
