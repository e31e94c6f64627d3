// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The referee proves which entries of a list are eigenvalues of a problem, and which eigenvalues
/// the list lacks.
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "algebra/linalg/block.hpp"
#include "eigen/modes/settings.hpp"
#include "eigen/pencil/pencil.hpp"
#include "eigen/proof/count.hpp"
#include "eigen/proof/enclosure.hpp"
#include "eigen/proof/kept.hpp"
#include "eigen/referee/kept_space.hpp"
#include "eigen/referee/settings.hpp"

namespace squeal::referee {

enum class Verdict {
  right,     ///< an eigenvalue, up to the tolerance plus the radius of its disc
  inexact,   ///< farther away, but in a disc with exactly one eigenvalue
  repeated,  ///< a second entry for a simple eigenvalue
  artefact,  ///< no eigenvalue corresponds to this entry
  missing,   ///< an eigenvalue that the list does not contain
  unproved,  ///< nothing is proved here
  outside,   ///< not in the judged region
};
inline constexpr std::array allVerdicts{Verdict::right,    Verdict::inexact, Verdict::repeated,
                                        Verdict::artefact, Verdict::missing, Verdict::unproved,
                                        Verdict::outside};
/// Returns the word for the verdict in tables and texts.
const char* text(Verdict verdict);

/// The verdict on an entry of the list, or on an eigenvalue that the list lacks.
struct Row {
  std::optional<std::size_t> entry;  ///< index in the list
  Complex listed = 0;                ///< without entry and disc: the approximate eigenvalue
  Verdict verdict = Verdict::unproved;
  std::optional<Complex> proved;  ///< centre of the nearest disc if Isolation::single
  double radius = 0;              ///< of this disc, rad/s
  double distance = 0;            ///< of the entry from the centre, rad/s
};

/// The sizes of a problem and of its proof.
struct Sizes {
  PetscInt unknowns = 0, modes = 0, basis = 0;
  double shift = 0;      ///< σ of ShiftedSystem, rad²/s²
  double asymmetry = 0;  ///< ‖K − Kᵀ‖ / ‖K‖ of the stiffness
  bool damped = false;
  long solves = 0;
};

/// A problem on V, with its couplings to C and the bounds on C. The same on all ranks.
struct BoundedProblem {
  Sizes sizes;
  double wanted = 0;       ///< the top of regions for which V is good, rad/s
  bool confirmed = false;  ///< the inertia confirms the number of free modes
  ProjectedProblem projected;
  proof::LeftOut leftOut;
};

struct Judgement {
  std::vector<Row> rows;  ///< the entries in the order of the list, then the missing eigenvalues
  /// The enclosures of the eigenvalues with Im s ≥ 0 in the region; an Isolation::single one
  /// contains its eigenvalue within the inner radius.
  std::vector<proof::Enclosure> eigenvalues;
  proof::Region region;
  proof::CountProof count;
  std::string why;  ///< why the count is not proved; empty if it is
  Sizes sizes;

  bool proved() const { return why.empty(); }
  long number(Verdict verdict) const;
  /// Returns the number of eigenvalues with Im s ≥ 0 that are proved to be alone in their discs.
  long singles() const;
  /// Returns true if the count is proved, every entry in the region is right and no eigenvalue is
  /// missing.
  bool isComplete() const;
  /// Returns the region in words.
  std::string regionText() const;
  /// Returns one sentence on the list.
  std::string sentence() const;
};

/// The name of the stage in the log, and the text at the beginning of its lines.
struct Log {
  std::string stage = "referee";
  std::string subject = "for the referee: ";
};

/// The problem at one point. Borrows the pencil.
struct Problem {
  const pencil::Pencil& pencil;
  sweep::Parameters at;
  /// Real and imaginary parts of known eigenvectors, right and left ones, as columns with this
  /// rank's rows. They spare corrections.
  linalg::Block vectors = {};
  /// Number of times that V is extended by corrections of the eigenvectors on V.
  int rounds = 2;
};

/// Collective. Reduces a problem for regions up to `top`, rad/s. If the settings of the modes give
/// a number, computes that many modes, otherwise all modes up to 1.7 times the top and a few more.
/// The lines of the log begin with the subject. Throws Error in the same cases as
/// SplitProblem, shiftedSystem() and modes::compute().
BoundedProblem bounded(const Problem& problem, double top, const modes::Settings& modes,
                       const Log& log);
/// Not collective. Judges a list of eigenvalues with Im s ≥ 0 by the reduced problem.
Judgement judge(const BoundedProblem& problem, std::span<const Complex> list,
                const Settings& settings);
/// Collective. Reduces a problem for the region of the settings, or for that of the list, and
/// judges the list. Throws Error if the top is automatic and the list has only zeros, and in the
/// same cases as bounded().
Judgement judge(const Problem& problem, std::span<const Complex> list, const Settings& settings,
                const modes::Settings& modes);

}  // namespace squeal::referee
