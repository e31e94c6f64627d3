// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The results of the friction-perturbed eigenproblem (section 4 of the paper that docs/method.md
/// cites): eigenvalues with their verdicts, complex modes, sensitivities and critical modes.
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "algebra/linalg/complexvector.hpp"
#include "eigen/pencil/settings.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::pencil {

/// The stability of an eigenvalue, given its error [M.24]. The excess is its growth rate minus the
/// threshold, `-flutter_unstable_tolerance` times |s|, which is zero by default.
enum class Verdict {
  unstable,    ///< the excess is positive, beyond the error
  stable,      ///< the excess is negative, beyond the error
  undecided,   ///< the magnitude of the excess is within the error
  neutral,     ///< by a symmetry of the problem, the eigenvalue lies on the imaginary axis
  uncertified  ///< its error is not estimated
};
/// All verdicts in the order of the enumeration.
inline constexpr std::array allVerdicts{Verdict::unstable, Verdict::stable, Verdict::undecided,
                                        Verdict::neutral, Verdict::uncertified};
/// Returns the word for the verdict in tables and texts.
const char* text(Verdict verdict);

/// A symmetry of the problem that restricts its eigenvalues.
enum class Symmetry {
  none,
  even,         ///< real and even in s: −s is an eigenvalue whenever s is
  conservative  ///< all eigenvalues are imaginary
};

/// An eigenvalue s of the pencil with estimates of its error.
struct Eigenvalue {
  Complex s;                 ///< growth rate + i angular frequency, 1/s
  double backwardError = 0;  ///< backward error in the full-order problem [M.33]
  double error = 0;          ///< estimate of |δs|, 1/s; NaN: none (direct method)
  bool certified = false;    ///< the known errors are within their tolerances
  /// Radius of a disc about s that is proved to contain exactly one eigenvalue of the full problem,
  /// 1/s; NaN if no such disc is known.
  double radius = std::numeric_limits<double>::quiet_NaN();
  Verdict verdict = Verdict::uncertified;
  /// True if the eigenvalue is treated as unstable: by its verdict or, if it is uncertified,
  /// because Re s exceeds both 1e-6 |s| and `-flutter_unstable_tolerance` times |s|.
  bool unstable = false;

  /// Returns −Re s/|s|, or 0 for s = 0.
  double dampingRatio() const { return s == 0.0 ? 0 : -s.real() / std::abs(s); }
  /// Returns true if s is zero within its error.
  bool mayBeZero() const { return std::abs(s) <= error; }
  /// Returns the estimate of the relative error |δs|/|s|: 1 if s is zero within its error, NaN if
  /// there is none.
  double errorEstimate() const { return mayBeZero() ? 1 : error / std::abs(s); }
};

/// Contributions to the growth rate of a mode, by cause, 1/s. The contributions of all components
/// of the model add up to Re s.
struct GrowthParts {
  double damping = 0;     ///< of materials, dashpots and free modes; never positive
  double follower = 0;    ///< friction follows the change of the normal force
  double turning = 0;     ///< friction turns with the relative velocity (friction damping)
  double slope = 0;       ///< friction changes with the slip speed by the friction law
  double convective = 0;  ///< friction changes with the convective velocity of the strained disc
  double gyroscopic = 0;  ///< zero up to round-off, since G is skew
  double sum() const { return damping + follower + turning + slope + convective + gyroscopic; }
};

/// The share of one component of the model in a mode.
struct Component {
  std::string
      kind;  ///< body, spring, bushing, mass, ground or interface, or a term of the whole model
  std::string name;
  double strain = 0;        ///< share of the strain energy; all shares add up to 1
  double kinetic = 0;       ///< share of the kinetic energy; all shares add up to 1
  std::string motion = {};  ///< motion of a body, e.g. "(0,4) out of plane"; empty if unclear
  double motionShare = 0;   ///< share of this motion in the kinetic energy of the body
  GrowthParts growth = {};
};

/// The participation of a free mode in a complex mode [M.88].
struct Participation {
  std::size_t mode;   ///< index of the free mode
  Complex amplitude;  ///< mass-weighted, relative to the norm of the complex mode
  double energy = 0;  ///< share of the energy of the complex mode
  double mac = 0;     ///< mass-weighted modal assurance criterion (MAC)
};

/// The MAC of a complex mode with a free mode, body by body.
struct BodyCorrelation {
  std::size_t mode;         ///< index of the free mode
  std::vector<double> mac;  ///< [body]
};

/// Returns the name of a mode from the motions of the bodies that have at least 0.15 of its kinetic
/// energy, at most three, largest first: "disc (0,4) out of plane + pad rigid about x". If the
/// motion of a body is unclear, the name gives only the body. The name is empty if all motions are
/// unclear.
std::string modeName(const std::vector<Component>& components);

/// A complex mode d = real + i imaginary in nodal displacements, N entries. It is scaled so that
/// the largest magnitude of a real or imaginary part is 1.
struct Shape {
  std::size_t index;  ///< index into ComplexModes::eigenvalues
  OwnedVec real, imaginary;
  linalg::ComplexVector unknowns;    ///< the same d in the unknowns x
  std::vector<double> frictionWork;  ///< [contact node] contribution of friction at the node to the
                                     ///< growth rate, 1/s [M.52]; empty without contact
  std::vector<Component> components;  ///< the same on all ranks; empty for matrices from files
  std::vector<Participation> participations;  ///< [free mode]; not in checkpoints
  std::vector<BodyCorrelation> correlations;  ///< in descending order of energy; not in checkpoints
};

/// The derivative of an eigenvalue with respect to one parameter θ.
struct Derivative {
  std::string parameter;  ///< name of θ
  Complex value;          ///< ds/dθ, 1/s per unit of the parameter
  /// d²s/dθ², estimated from the nearest eigenvalue [M.90], 1/s per unit²; NaN: unknown
  Complex second = {NAN, NAN};

  /// Returns the change of θ at which the second-order change of the growth rate is a tenth of the
  /// first-order one; NaN if the second derivative is unknown.
  double growthHoldsTo() const;
};

/// Condition number and derivatives of one eigenvalue.
struct Sensitivity {
  /// Condition number [M.50], which is 1 for a symmetric problem and infinite where two eigenvalues
  /// and their vectors meet:
  ///   2 |s| ‖x‖_M0 ‖y‖_M0 / |yᴴ P′(s) x|.
  double condition = 0;
  /// Distance to the nearest of the other eigenvalues found, relative to |s|.
  double separation = 0;
  double leftBackwardError = 0;         ///< backward error of the left vector
  std::vector<Derivative> derivatives;  ///< empty if not regular()
  /// Returns true if derivatives can be computed: the left vector is accurate enough, and the
  /// eigenvalue is not close to meeting another one. Eigenvalues that meet have no derivatives.
  bool regular() const;
};

/// The derivative of a critical friction f* with respect to one parameter θ.
struct CriticalDerivative {
  std::string parameter;  ///< name of θ
  double value = 0;       ///< df*/dθ, per unit of the parameter
};

/// The mode at a critical friction, where two eigenvalues meet or one lies on the imaginary axis.
struct CriticalMode {
  std::string name;                                          ///< as returned by modeName()
  std::vector<Participation> participations;                 ///< [free mode]
  double rightBackwardError = NAN, leftBackwardError = NAN;  ///< of the null vectors x and y
  std::vector<CriticalDerivative> derivatives = {};          ///< empty if there are none
};

/// An eigenvalue of the full problem that is missing from the list of a point. It is the only one
/// in the disc with this centre and radius.
struct MissingEigenvalue {
  Complex centre;     ///< 1/s
  double radius = 0;  ///< 1/s
};

/// The result of the proof for the list of a point (docs/method.md, section 13).
struct Completeness {
  bool proved = false;  ///< the number of eigenvalues of the full problem with |s| < top is proved
  int count = 0;        ///< number of these eigenvalues, with multiplicities and conjugates
  /// Returns the number of conjugate pairs, since a list has one entry per pair; a real eigenvalue
  /// counts as half a pair.
  double pairs() const { return count / 2.0; }
  double top = 0;  ///< radius of the region of the proof, rad/s
  /// If this is finite, the region ends on the left at Re s = −left, 1/s.
  double left = std::numeric_limits<double>::infinity();
  double definiteness = 0;  ///< δ of section 13
  double ratio = 0;         ///< largest φ found on the boundary of the region; below 1 if proved
  Complex place = 0;        ///< where `ratio` is reached, or where the proof fails, 1/s
  int discs = 0;            ///< number of discs that cover the upper half of the boundary
  std::string reason;       ///< why the count or the place of an eigenvalue is not proved, or empty
  std::vector<MissingEigenvalue> missing;  ///< eigenvalues that the list should contain
  std::vector<Complex> spurious;  ///< listed values that are proved to be wrong or repeated, 1/s
  /// Eigenvalues of the reduced problem that the list does not contain, 1/s. Whether the
  /// eigenvalues of the full problem there lie in the band is not proved.
  std::vector<Complex> undecided;
};

/// The results of one point of the sweep.
struct ComplexModes {
  sweep::Parameters at;
  std::vector<Eigenvalue> eigenvalues;     ///< Im s ≥ 0, by ascending frequency
  std::vector<Shape> shapes;               ///< those of shapesToStore(): the fastest growing
  std::vector<Sensitivity> sensitivities;  ///< [shape]; empty unless requested
  /// Top of the band, rad/s: eigenvalues with |s| up to this value are listed and corrected. 0:
  /// none are corrected (direct method); infinite: the basis spans the whole space.
  double bandTop = 0;
  int freeModesInBand = 0;  ///< number of free modes up to bandTop
  bool damped =
      false;  ///< the reduced problem has a term linear in s; false with the direct method
  double accuracy = 0;       ///< largest admissible backward error
  double tolerance = 0;      ///< largest admissible estimate of |δs|/|s|; 0: none (direct method)
  double directBandTop = 0;  ///< upper end of the band of the direct method, rad/s; 0: none
  /// The list contains all eigenvalues of the direct method's band with |s| below this value,
  /// rad/s; 0 without a band.
  double coveredTo = 0;
  std::optional<Completeness> completeness = {};  ///< none if no proof is wanted
  /// For a damped problem, returns the number of free modes in the band minus that of the listed
  /// eigenvalues, but at least 0; otherwise returns 0. The missing eigenvalues are damped too
  /// strongly to be listed, or lie beyond the top.
  int modesWithoutEigenvalue() const;
  /// Returns the number of listed eigenvalues in the region of the proof without a proved disc
  /// (Eigenvalue::radius).
  int withoutDisc() const;
  /// Returns true if the full problem is proved to have exactly the listed eigenvalues in the band,
  /// each in its own proved disc.
  bool listIsProved() const;
  /// Returns true if no eigenvalue is listed and it is not proved that the band contains none.
  bool stabilityIsUnknown() const { return eigenvalues.empty() && !listIsProved(); }
  /// Returns the number of eigenvalues that are treated as unstable.
  int unstableCount() const;
  /// Returns the number of eigenvalues with this verdict.
  int count(Verdict verdict) const;
  /// Returns the verdict on the point. This is the worst verdict of its eigenvalues, in the order
  /// unstable, uncertified, undecided, neutral, stable. A point without eigenvalues is uncertified.
  Verdict verdict() const;
  /// Returns the number of eigenvalues that are not certified.
  int uncertifiedCount() const;
  /// Returns the largest backward error; 0 if there are no eigenvalues, NaN if one is NaN.
  double worstBackwardError() const;
  /// Returns the largest estimate of the relative error; 0 if there are no eigenvalues, NaN if one
  /// is NaN.
  double worstErrorEstimate() const;
  /// Returns the eigenvalue with the largest growth rate, borrowed; null if there are none.
  const Eigenvalue* fastestGrowing() const;
};

/// Sets `verdict` and `unstable` of each eigenvalue of the point by [M.24].
void setVerdicts(ComplexModes& point, Symmetry symmetry, const Criteria& criteria);

/// Returns the indices of the eigenvalues whose shapes are stored, in order of descending growth
/// rate: at most `shapes`, all below `shapesBelow`, and only unstable ones unless `stableShapes`.
std::vector<std::size_t> shapesToStore(const ComplexModes& point, const Criteria& criteria);
/// Collective. Appends the shapes of the eigenvalues with these indices to the point. Consumes
/// `modes`, the eigenvectors of these eigenvalues in the unknowns x, in any scaling; `trial` is the
/// matrix T of u = T x.
void storeShapes(ComplexModes& point, Mat trial, const std::vector<std::size_t>& indices,
                 std::vector<linalg::ComplexVector> modes);

}  // namespace squeal::pencil
