#pragma once
/// After flutter [§ 17]: the motion of an unstable mode that has grown is followed on a reduced
/// model with stick, slip and separation at every contact node, and classified.
#include <cmath>
#include <string>
#include <vector>

#include "algebra/linalg/block.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "regime/march/onset.hpp"
#include "regime/regime/cycle.hpp"
#include "regime/regime/record.hpp"
#include "regime/regime/reduced_model.hpp"
#include "regime/regime/settings.hpp"
#include "regime/sound/outside.hpp"

namespace squeal::regime {

using march::Onset;
using mesh::Point;

/// Throws Error for settings of the stage that no march can satisfy, and for options of other
/// stages that it cannot follow.
void checkOptions(const Settings& settings, bool ofMesh);

/// Throws Error if there is no contact, and for convective terms and prestress, which are not
/// followed in time.
void requireSupported(const Settings& settings, const elasticity::Bodies& bodies,
                      const contact::Contact& contact);

/// One march from one start. Where it has measured nothing, `failure` says why.
struct Run {
  std::string start;    ///< the number of the unstable mode, or "all"
  Complex s;            ///< of the mode, or of the fastest growing one
  std::string failure;  ///< empty: none
  Onset onset;
  Point onsetPosition{};      ///< m
  double onsetKinetic = NAN;  ///< largest over a cycle at the onset, J; NaN: not known
  double step = NAN;          ///< s; NaN: not known
  Regime regime;
  Cycles cycles;  ///< where `-regime_cycle` asks for them
  sound::Outside outside;
};

/// What was found at one point of the sweep.
struct Study {
  sweep::Parameters at;
  int unstable = 0;          ///< modes that are unstable there
  int modes = 0, rows = 0;   ///< of the reduced model; 0: there is none
  double modelError = NAN;   ///< largest |δs|/|s| of the reduced against the certified ones
  double stableStep = 0;     ///< with all contact nodes held, s
  double steadyPower = NAN;  ///< heat of friction of steady sliding, W
  std::vector<Node> nodes;
  /// [node] its place among the contact nodes of this rank; −1 on other ranks
  std::vector<PetscInt> contactNode;
  std::vector<Run> runs;  ///< of all starts that are wanted
  /// What has failed at the point, by its name, that of its start and the remedy; these have been
  /// printed.
  std::vector<std::string> failures;
};

/// The first event of an unstable mode of the mesh as it grows.
struct ModeOnset {
  sweep::Parameters at;
  std::size_t mode = 0;  ///< index into ComplexModes::eigenvalues
  Complex s;             ///< 1/s
  Onset onset;           ///< its factor is that of pencil::Shape, its node 0
  Point position{};      ///< of the node, m
  int interface = -1;    ///< of the node
  double kinetic = 0;    ///< largest kinetic energy over a cycle at the event, J
};

/// Collective. Returns the first events of the unstable modes whose shapes the point has [M.75].
/// `prestress` is K_σ of the steady state; it may be null.
std::vector<ModeOnset> onsets(const elasticity::Bodies& bodies, const contact::Contact& contact,
                              const steady::Solution& solution, const pencil::ComplexModes& point,
                              Mat prestress);

/// Collective. Returns the regime at one point. `free` are the free modes, nodal displacements,
/// this rank's rows; the shapes of the unstable modes are those of the point. An Error, such as a
/// reduced model without the certified eigenvalues, is a failure of the point, or of one start: it
/// is printed and returned, not thrown. Throws Interrupted within a second of a request to stop.
Study study(const FullModel& full, const Settings& settings, linalg::Block free,
            const pencil::ComplexModes& point);

}  // namespace squeal::regime
