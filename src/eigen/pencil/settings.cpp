// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/pencil/settings.hpp"

#include <algorithm>
#include <cmath>

#include "base/options/options.hpp"

namespace squeal::pencil {
namespace {

const ChoiceOption methodOption(
    "flutter", "flutter_method", {"reduced", "direct"}, "reduced",
    "reduced: dense problem in a basis of free modes and corrections; direct: all unknowns, for "
    "verification");
const RealListOption modalOption(
    "flutter", "flutter_modal_damping", "0", "", nonNegative,
    "modal damping ratios, one per free mode; the last value applies to all further modes (reduced "
    "method only)");
const RealOption bandOption(
    "flutter", "flutter_band", 0, "Hz", nonNegative,
    "upper limit of |s|/(2 pi) (the frequency, at low damping) for corrected and listed "
    "eigenvalues, below the highest free mode of the active set; 0 = automatic (the mode at 55 % "
    "of the list of free modes)");
const RealOption bandDampingOption("flutter", "flutter_band_damping", 0.5, "", positive,
                                   "largest damping ratio of listed eigenvalues");
const RealOption accuracyOption(
    "flutter", "flutter_accuracy", 1e-9, "", positive,
    "largest full-order backward error of a certified eigenvalue; target of the corrections");
const RealOption toleranceOption(
    "flutter", "flutter_unstable_tolerance", 0, "", nonNegative,
    "minimum growth rate of unstable eigenvalues as a fraction of |s|, which they exceed by more "
    "than their error estimates; critical frictions: always zero growth");
const IntegerOption shapesOption(
    "flutter", "flutter_shapes", 3, 0, 100'000,
    "largest number of complex modes stored per point, in order of descending growth rate");
const FlagOption stableShapesOption("flutter", "flutter_shapes_stable", false,
                                    "storage of stable complex modes too, so that -flutter_shapes "
                                    "can cover all modes of the band; off: only unstable ones");
const RealOption shapesBelowOption("flutter", "flutter_shapes_below", 20000, "Hz", positive,
                                   "upper frequency limit of stored complex modes (audible range)");

}  // namespace

bool Settings::isModallyDamped() const {
  return std::ranges::any_of(modalDamping, [](double ratio) { return ratio > 0; });
}

Settings Settings::given() {
  Settings settings;
  settings.method = methodOption.get() == "direct" ? Method::direct : Method::reduced;
  settings.criteria = {.accuracy = accuracyOption.get(),
                       .unstable = toleranceOption.get(),
                       .shapes = shapesOption.get(),
                       .stableShapes = stableShapesOption.get(),
                       .shapesBelow = 2 * M_PI * shapesBelowOption.get()};
  settings.modalDamping = modalOption.get();
  if (settings.method == Method::reduced)
    settings.band = {.top = 2 * M_PI * bandOption.get(), .damping = bandDampingOption.get()};
  return settings;
}

}  // namespace squeal::pencil
