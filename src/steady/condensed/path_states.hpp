// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// The states of the contact on many active sets along a line in the space of parameters.
#include <map>
#include <optional>
#include <vector>

#include "algebra/linalg/dense.hpp"
#include "steady/condensed/condensed_problem.hpp"

namespace squeal::condensed {

/// A straight line from one point to another; s = 0 and s = 1 are its ends.
struct Line {
  sweep::Parameters from, to;
  sweep::Parameters at(double s) const;
};

/// Returns the same states as CondensedProblem::onSet() along a line, but faster if many are needed
/// on sets that differ in few nodes.
///
/// On a part of the line, the state of one set, the base, and the responses to changes of some
/// unknowns are computed at some places. The state of another set at such a place is then the sum
/// of that of the base and of responses, with amounts such that the changed unknowns fulfil their
/// conditions (F = 0 or w = 0). Between the places the state is interpolated by a polynomial. Every
/// state is checked: if friction is unbalanced or the given forces differ by more than round-off,
/// or if forces act on free unknowns, the state is computed by CondensedProblem::onSet().
class PathStates {
 public:
  /// Collective. Borrows the problem.
  PathStates(CondensedProblem& problem, const Line& line);
  /// Collective. Prepares for states from the place s on, on sets that differ little from this one.
  /// Returns the end of the prepared part.
  double reach(double s, const contact::Mask& closed, const Sticking& sticking);
  /// Collective. Returns the state of a set at the place s.
  impedance::ContactSolution at(double s, const contact::Mask& closed, const Sticking& sticking);
  /// Returns the number of states so far that could not be interpolated.
  int computedSingly() const { return computedSingly_; }

 private:
  /// A place with the state of the base and the responses there.
  struct Support {
    double s;
    linalg::DenseMatrix causes, effects;  // column 0 for the base, one for each changed unknown
    linalg::DenseMatrix conditions = {};  // [changed unknown]×[column]: F or w, to be zero
    impedance::ContactVector given;
    linalg::DenseMatrix stateCauses = {}, stateEffects = {};  // of the current set, one column
  };
  /// A part of the line.
  struct Part {
    double begin, end;
    ChosenSet base;
    std::vector<unsigned char> free;             // on the base, [released unknown]
    std::vector<Support> supports = {};          // empty: states are computed one by one
    std::vector<PetscInt> changed = {};          // unknowns of all ranks with responses
    std::vector<double> unit = {};               // [changed] of w or F that is of the order of 1
    std::map<PetscInt, std::size_t> index = {};  // [unknown] its index in `changed`
    std::vector<unsigned char> current = {};     // free unknowns of the current set
    std::vector<PetscInt> expected = {};         // unknowns of this rank that may change soon
    bool hasFailed = false;                      // a new part is needed
    double length() const { return end - begin; }
  };
  bool fits(double s, const ChosenSet& set) const;
  void build(double s, double longest, const ChosenSet& base);
  bool computeSupports();
  bool interpolatesBase();
  void noteExpected(const impedance::ContactSolution& state,
                    const std::vector<unsigned char>& free);
  PetscInt expectedOnAllRanks() const;
  std::vector<double> frictionUnits(const std::vector<PetscInt>& unknowns) const;
  bool add(std::vector<PetscInt> unknowns);
  bool moveTo(const std::vector<unsigned char>& free);
  bool combine(const std::vector<std::size_t>& active);
  std::optional<impedance::ContactSolution> interpolated(double s, const SetCase& asked) const;

  CondensedProblem& problem_;
  const Line line_;
  PetscInt first_ = 0;        // index of this rank's first released unknown
  PetscInt mostChanged_ = 0;  // the largest number of changed unknowns of a part
  std::optional<Part> part_;
  int computedSingly_ = 0;
};

}  // namespace squeal::condensed
