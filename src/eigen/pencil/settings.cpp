// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/pencil/settings.hpp"

#include <algorithm>
#include <cmath>

#include "base/options/options.hpp"

namespace squeal::pencil {
namespace {

const ChoiceOption methodOption(
    "flutter", "flutter_method", {"reduced", "direct"}, "reduced",
    "method for the complex modes; reduced: dense problem in a basis of free modes and "
    "corrections; direct: problem in all unknowns, for verification");
const RealListOption modalOption("flutter", "flutter_modal_damping", "0", "", nonNegative,
                                 "modal damping ratios, one per free mode; the last value applies "
                                 "to all further modes; reduced method only");
const RealOption bandOption(
    "flutter", "flutter_band", 0, "Hz", nonNegative,
    "upper limit of |s|/(2 pi), which is the frequency at low damping, for corrected and listed "
    "eigenvalues; a limit above the highest free mode of the active set is lowered to just below "
    "this mode; 0 = automatic (just above the mode at 55 % of the list of free modes)");
const RealOption bandDampingOption("flutter", "flutter_band_damping", 0.5, "", positive,
                                   "largest damping ratio of listed eigenvalues");
const RealOption accuracyOption("flutter", "flutter_accuracy", 1e-9, "", positive,
                                "largest backward error, in the full-order problem, that a "
                                "certified eigenvalue may have; corrections aim at it");
const RealOption toleranceOption("flutter", "flutter_unstable_tolerance", 0, "", nonNegative,
                                 "threshold z of the growth rate, as a fraction of |s|: an "
                                 "eigenvalue is unstable if Re s exceeds z |s| by more than its "
                                 "error estimate; critical frictions are always those of Re s = 0");
const IntegerOption shapesOption("flutter", "flutter_shapes", 3, 0, 100'000,
                                 "largest number of complex modes stored per point; those with the "
                                 "largest growth rates are stored");
const FlagOption stableShapesOption(
    "flutter", "flutter_shapes_stable", false,
    "storage of all complex modes of the band, up to -flutter_shapes per point; off: only unstable "
    "ones are stored");
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
