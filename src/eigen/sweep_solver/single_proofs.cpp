// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/sweep_solver/single_proofs.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "algebra/linalg/rows.hpp"
#include "algebra/linalg/spread.hpp"
#include "base/petsc/matrix.hpp"
#include "base/session/stages.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/termination.hpp"
#include "base/system/text.hpp"
#include "eigen/completeness/completeness.hpp"
#include "eigen/completeness/list_judgement.hpp"
#include "eigen/referee/referee.hpp"
#include "eigen/sweep/parameters.hpp"
#include "eigen/sweep_solver/point_text.hpp"

namespace squeal::sweep_solver {
namespace {

/// Collective. Returns the unknowns of a point among the `rows` unknowns of this rank: all except
/// the boundary unknowns of other points.
std::vector<PetscInt> unknownsOf(const SweepProblem& problem, const PointRange& range,
                                 PetscInt rows) {
  const auto& boundary = problem.substructure.boundary;
  const Concatenation all(problem.pencil->comm(), boundary.size());
  std::vector<unsigned char> has(rows, 1);
  for (std::size_t i = 0; i < boundary.size(); ++i)
    has[boundary[i]] = range.has[all.ownBegin() + i];
  std::vector<PetscInt> unknowns;
  for (PetscInt i = 0; i < rows; ++i)
    if (has[i]) unknowns.push_back(i);
  return unknowns;
}

/// Returns the terms of a point whose coefficient is not zero.
pencil::Pencil activeTerms(const ListedPoint& point) {
  std::vector<pencil::Term> terms;
  for (const auto& term : point.problem.pencil.terms())
    if (term.coefficient(point.list->at) != 0) terms.push_back(term.share());
  return pencil::Pencil(std::move(terms));
}

/// Collective. Returns the sum of the terms with each power of s, in the unknowns of the point.
pencil::Pencil sumsOf(const pencil::Pencil& terms, const sweep::Parameters& at,
                      const std::vector<PetscInt>& unknowns) {
  std::vector<pencil::Term> sums;
  for (const int power : {0, 1, 2}) {
    const OwnedMat sum = terms.assembled(power, at);
    if (!sum) continue;
    PetscInt first = 0;
    check(MatGetOwnershipRange(sum, &first, nullptr));
    std::vector<PetscInt> rows = unknowns;
    for (PetscInt& row : rows) row += first;
    OwnedIS set;
    check(ISCreateGeneral(commOf(sum), rows.size(), rows.data(), PETSC_COPY_VALUES, set.out()));
    pencil::Term& term = sums.emplace_back();
    check(MatCreateSubMatrix(sum, set, set, MAT_INITIAL_MATRIX, term.matrix.out()));
    term.power = power;
    term.ofFriction = true;
  }
  return pencil::Pencil(std::move(sums));
}

/// Collective. Returns the real and imaginary parts of the right and left vectors of the solved
/// watched pairs, in the unknowns of the point; no columns if the pairs are not stored.
linalg::Block vectorsOf(const reduction::ReducedProblem& reduced,
                        const reduction::PointProblem& problem,
                        const std::vector<PetscInt>& unknowns) {
  constexpr double nothing = 1e-6;  // of one part, relative to the other
  const auto pairs = reduced.watchedPairs(problem.at, problem.set);
  linalg::DenseMatrix coordinates(reduced.basisSize());
  for (const auto& pair : pairs.value_or(std::vector<linalg::DensePair>())) {
    for (const auto& vector : {pair.q, pair.left}) {
      const auto q = reduced.lifted(problem.set, vector);
      std::array<std::vector<double>, 2> parts;
      for (auto& part : parts) part.resize(reduced.basisSize());
      for (std::size_t i = 0; i < q.size(); ++i)
        parts[0][i] = q[i].real(), parts[1][i] = q[i].imag();
      const std::array lengths{linalg::squaredLength(parts[0]), linalg::squaredLength(parts[1])};
      for (const int k : {0, 1})
        if (lengths[k] > nothing * nothing * lengths[1 - k]) coordinates.append(parts[k]);
    }
  }
  return linalg::rowsOf(unknowns, linalg::product(reduced.basis().columns(), coordinates));
}

/// Collective. Returns the problem of a point on its own basis; none, with the reason, if that
/// fails. The basis is corrected `rounds` times, or twice if the eigenvectors are not stored.
std::optional<referee::BoundedProblem> boundedProblem(const SweepProblem& problem,
                                                      const reduction::ReducedProblem& reduced,
                                                      const modes::Settings& modes, int rounds,
                                                      ListedPoint& point) {
  auto& found = point.list->completeness.emplace();
  const auto& at = point.list->at;
  const auto terms = activeTerms(point);
  if (!std::ranges::all_of(terms.terms(), [](const auto& term) { return isSparse(term.matrix); })) {
    found.reason = "modal damping is not a sparse matrix";
    return {};
  }
  try {
    const auto unknowns =
        unknownsOf(problem, problem.ranges[point.place.range], reduced.basis().localRows());
    const auto pencil = sumsOf(terms, at, unknowns);
    auto vectors = vectorsOf(reduced, point.problem, unknowns);
    if (vectors.columns() == 0) rounds = 2;
    return referee::bounded({pencil, at, std::move(vectors), rounds},
                            completeness::wantedTop(point.list->bandTop), modes,
                            {"proof", sweep::parameterText(at) + ": "});
  } catch (const Error& error) {
    found.reason = error.what();
    return {};
  }
}

/// Sets what is proved about the list of a point.
void judgeList(const referee::BoundedProblem& problem, const pencil::WatchedBand& band, int discs,
               pencil::ComplexModes& point) {
  auto& found = *point.completeness;
  std::vector<Complex> list;
  for (const auto& e : point.eigenvalues) list.push_back(e.s);
  try {
    const auto judged = referee::judge(problem, list,
                                       {.top = problem.wanted,
                                        .within = completeness::within,
                                        .tolerance = point.tolerance,
                                        .discs = discs,
                                        .remedies = completeness::remedies("")});
    completeness::recordCount(judged.region, judged.count, found);
    found.proved = judged.proved();
    found.reason = judged.why;
    completeness::judgeList(judged.eigenvalues, judged.region, band, point);
  } catch (const Error& error) {
    found = {};
    found.reason = error.what();
  }
}

/// Collective. Judges the lists of at most as many points as there are ranks, whose dense work is
/// done at the same time. Their bases are corrected `rounds` times.
void proveTogether(const SweepProblem& problem, const reduction::ReducedProblem& reduced,
                   std::span<ListedPoint* const> points, const ProofRequest& request, int rounds) {
  const MPI_Comm comm = reduced.basis().comm();
  modes::Settings modes = request.modes;
  modes.countGiven = false;
  std::vector<pencil::ComplexModes*> lists;
  std::optional<referee::BoundedProblem> own;  // of the point that this rank owns
  for (auto* point : points) {
    const bool isOwn = mpi::rank(comm) == std::ssize(lists);
    lists.push_back(point->list);
    auto bounded = boundedProblem(problem, reduced, modes, rounds, *point);
    if (isOwn) own = std::move(bounded);
  }
  Stage stage(comm, "proof");
  linalg::onOwners(comm, lists.size(), [&](std::size_t i) {
    if (own) judgeList(*own, reduced.band(), request.settings.discs, *lists[i]);
  });
  completeness::share(comm, lists);
  for (const auto* list : lists)
    if (list != lists.back()) stage.printLine(completenessText(*list));
  stage.finish(completenessText(*lists.back()));
}

/// Returns true if corrections of the basis may complete the proof. They reduce the ratio, which
/// must be below 1, to a fifth at best, and make the discs smaller.
bool mayBeCompleted(const pencil::ComplexModes& point) {
  constexpr double mostRatio = 5;
  const auto& found = *point.completeness;
  if (found.proved) return !point.listIsProved() && found.missing.empty() && found.spurious.empty();
  return found.definiteness > 0 && found.ratio > 0 && found.ratio < mostRatio;
}

/// Collective. Proves the lists of points again, with corrected bases, and keeps the better
/// results.
void proveAgain(const SweepProblem& problem, const reduction::ReducedProblem& reduced,
                const std::vector<ListedPoint*>& points, const ProofRequest& request) {
  if (points.empty()) return;
  printLine(reduced.basis().comm(),
            formatted("proof: %zu points again, with corrections of the basis", points.size()));
  std::vector<pencil::Completeness> first;
  for (const auto* point : points) first.push_back(*point->list->completeness);
  proveTogether(problem, reduced, points, request, 1);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (completeness::keepBetter(std::move(first[i]), *points[i]->list->completeness))
      printLine(reduced.basis().comm(),
                "proof: the first result remains at " + sweep::parameterText(points[i]->list->at));
}

}  // namespace

void proveSingly(const SweepProblem& problem, const reduction::ReducedProblem& reduced,
                 const std::vector<ListedPoint*>& points, const ProofRequest& request) {
  const MPI_Comm comm = reduced.basis().comm();
  const std::size_t ranks = mpi::size(comm);
  for (std::size_t first = 0; first < points.size(); first += ranks) {
    stopIfRequested(comm);
    const std::span some(points.begin() + static_cast<std::ptrdiff_t>(first),
                         std::min(ranks, points.size() - first));
    proveTogether(problem, reduced, some, request, 0);
    std::vector<ListedPoint*> others;
    for (auto* point : some)
      if (mayBeCompleted(*point->list)) others.push_back(point);
    proveAgain(problem, reduced, others, request);
    if (request.afterPoints) request.afterPoints();
  }
}

}  // namespace squeal::sweep_solver
