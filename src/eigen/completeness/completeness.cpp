// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/completeness/completeness.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "algebra/linalg/rows.hpp"
#include "algebra/linalg/spread.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/stream.hpp"
#include "eigen/completeness/basis_products.hpp"
#include "eigen/completeness/list_judgement.hpp"
#include "eigen/completeness/point_bounds.hpp"
#include "eigen/pencil/serialization.hpp"
#include "eigen/proof/count.hpp"
#include "eigen/proof/enclosure.hpp"
#include "eigen/proof/reason.hpp"
#include "eigen/reduction/factored_friction.hpp"

namespace squeal::completeness {
namespace {

using linalg::DenseMatrix;

/// The bounds hold for |s| up to this multiple of the top of the band. The circles of enclose()
/// have radii of up to 0.9 in the plane of z = (s / 1.04 top)², and |s| reaches 1.47 on them.
constexpr double reach = 1.5;

/// Collective. Adds the static responses to the slip rows to the basis. Returns S_a K0⁻¹ S_aᵀ,
/// [power of the friction], r × r.
std::vector<DenseMatrix> addResponses(reduction::ReducedProblem& reduced,
                                      const pencil::FrictionFactors& factors) {
  linalg::Block forces(reduced.basis().localRows());
  for (const auto& slip : factors.slip) forces.append(columnsOf(slip.matrix));
  const DenseMatrix all = reduced.addResponses(std::move(forces));
  const PetscInt count = std::ssize(factors.slip), rows = count > 0 ? all.rows() / count : 0;
  std::vector<DenseMatrix> result;
  for (PetscInt a = 0; a < count; ++a)
    result.push_back(linalg::rowRange(DenseMatrix(all.columnRange(a * rows, (a + 1) * rows)),
                                      a * rows, (a + 1) * rows));
  return result;
}

/// The data of a point, and the approximate eigenvectors of its list in coordinates of V.
struct PointData {
  PointMatrices matrices;
  DenseMatrix vectors;
};

/// What the proof on a part of V has found.
struct Attempt {
  proof::Region region;
  proof::CountProof count;
  std::vector<proof::Enclosure> discs;
  bool isProved() const { return count.verdict == proof::Verdict::proved; }
  bool isComplete() const {
    return isProved() && std::ranges::all_of(discs, [](const auto& disc) {
             return disc.isolation == proof::Isolation::single;
           });
  }
};

/// Tries the proof on V W. Without a proved count, discs are searched only if `isLast`.
Attempt attempt(const SetBounds& set, const PointMatrices& matrices, const DenseMatrix& w,
                const Settings& settings, double bandTop, bool isLast) {
  const double wanted = wantedTop(bandTop);
  const auto bounds = pointBounds(set, matrices, w);
  const proof::DiagonalForm form(bounds.kept, wanted);
  Attempt result{{proof::placedTop(form.eigenvalues(), wanted, within)}, {}, {}};
  result.count = proof::proveCount(form, bounds.leftOut, result.region, settings.discs);
  if (result.isProved() || isLast)
    result.discs = proof::enclose(form, bounds.leftOut, result.region, result.count);
  return result;
}

/// Proves the list of a point, if the bounds suffice: on the part of V with its eigenvectors, or on
/// all of V. Not collective.
void proveList(const SetBounds& set, const PointData& data, const Settings& settings,
               const pencil::WatchedBand& band, pencil::ComplexModes& point) {
  std::optional<Attempt> found;
  try {
    if (data.vectors.columns() > 0)
      found = attempt(set, data.matrices, set.span.vectorsWith(data.vectors), settings,
                      point.bandTop, false);
    if (!found || !found->isComplete()) {
      auto whole = attempt(set, data.matrices, linalg::identity(data.matrices.problem.order()),
                           settings, point.bandTop, true);
      if (!found || !found->isProved() || whole.isProved()) found = std::move(whole);
    }
  } catch (const Error& error) {
    if (!found || !found->isProved()) {
      point.completeness->reason = error.what();
      return;
    }
  }
  recordCount(found->region, found->count, *point.completeness);
  point.completeness->reason = proof::reason(found->count, remedies("-modes_count"));
  judgeList(found->discs, found->region, band, point);
}

/// Collective. Returns the products of the whole basis that all points share. Adds the static
/// responses to the slip rows to the basis.
SetMatrices commonProducts(reduction::ReducedProblem& reduced,
                           const pencil::FrictionFactors& factors, const KnownModes& modes,
                           const std::vector<double>& lambda, Mat mass) {
  SetMatrices result;
  result.modes = modes;
  result.solved = reduced.basis().size();
  result.slipFlexibility = addResponses(reduced, factors);
  const auto& basis = reduced.basis();
  for (const auto& slip : factors.slip)
    result.slip.push_back(reduction::productWithBasis(basis, slip.matrix));
  result.normal = reduction::productWithBasis(basis, factors.normalOf(0));
  result.inertia = reduction::productWithBasis(basis, factors.normalOf(2));
  result.normalFlexibility = reduced.flexibility(columnsOf(factors.normalOf(0)));
  result.inertiaFlexibility = reduced.flexibility(columnsOf(factors.normalOf(2)));
  result.massProduct = massFlexibility(reduced, modes, lambda, mass, result.solved);
  return result;
}

/// Returns the products of a set from those of the basis. `associated` has K0 and M0 on V.
SetMatrices matricesOf(const ProvedSet& set, const subspace::PointSpace& space,
                       linalg::DenseProblem associated, const SetMatrices& common) {
  const auto rowsOnSet = [&](const DenseMatrix& rows) {
    return space.restrictedColumns(linalg::rowsOf(set.rows, rows));
  };
  const auto onSet = [&](const DenseMatrix& flexibility) {
    return linalg::principalPart(set.rows, flexibility);
  };
  SetMatrices result;
  result.modes = common.modes;
  result.modes.first = space.own();
  result.solved = space.size(common.solved);
  for (std::size_t a = 0; a < common.slip.size(); ++a) {
    result.slip.push_back(rowsOnSet(common.slip[a]));
    result.slipFlexibility.push_back(onSet(common.slipFlexibility[a]));
  }
  result.normal = rowsOnSet(common.normal);
  result.inertia = rowsOnSet(common.inertia);
  result.normalFlexibility = onSet(common.normalFlexibility);
  result.inertiaFlexibility = onSet(common.inertiaFlexibility);
  linalg::DenseProblem product;
  product.stiffness = common.massProduct;
  result.massProduct = space.restricted(std::move(product)).stiffness;
  result.energy = std::move(associated.stiffness);
  result.mass = std::move(associated.mass);
  return result;
}

/// Collective. Returns the data of a point.
PointData dataOf(const reduction::ReducedProblem& reduced, const pencil::FrictionFactors& factors,
                 const reduction::PointProblem& problem) {
  PointData data{{reduced.project(problem), {}}, {}};
  for (const auto& slip : factors.slip)
    data.matrices.slipFactors.push_back(std::pow(problem.at.friction, slip.frictionExponent));
  data.vectors = DenseMatrix(data.matrices.problem.order());
  if (const auto pairs = reduced.watchedPairs(problem.at, problem.set))
    for (const auto& pair : *pairs) appendParts(pair.q, data.vectors);
  return data;
}

/// Collective. Proves the lists of a set.
void proveSet(reduction::ReducedProblem& reduced, const pencil::FrictionFactors& factors,
              const SetMatrices& matrices, const ProvedSet& set, const Settings& settings) {
  const SetBounds bounds = setBounds(matrices, reach * set.points.front()->bandTop);
  constexpr std::size_t ofRank = 4;  // points of a rank at a time: limits the memory
  const MPI_Comm comm = reduced.basis().comm();
  const std::size_t rank = mpi::rank(comm), ranks = mpi::size(comm), atOnce = ofRank * ranks;
  for (std::size_t first = 0; first < set.points.size(); first += atOnce) {
    const std::size_t count = std::min(atOnce, set.points.size() - first);
    std::vector<PointData> own;
    for (std::size_t i = 0; i < count; ++i) {
      auto data = dataOf(reduced, factors, set.problems[first + i]);
      if (i % ranks == rank) own.push_back(std::move(data));
    }
    linalg::onOwners(comm, count, [&](std::size_t i) {
      proveList(bounds, own[i / ranks], settings, reduced.band(), *set.points[first + i]);
    });
  }
}

/// Collective. Proves the lists of all sets.
void proveSets(reduction::ReducedProblem& reduced, const pencil::FrictionFactors& factors,
               const SetMatrices& common, const std::vector<ProvedSet>& sets,
               const Settings& settings) {
  for (const auto& set : sets) {
    const auto& problem = set.problems.front();
    const auto matrices =
        matricesOf(set, reduced.space(problem.set), reduced.projectAssociated(problem.set), common);
    try {
      proveSet(reduced, factors, matrices, set, settings);
    } catch (const Error& error) {
      for (auto* point : set.points)
        if (point->completeness->top == 0) point->completeness->reason = error.what();
    }
    share(reduced.basis().comm(), set.points);
  }
}

/// Returns the points at which the number of eigenvalues or a disc is not proved, though the free
/// modes suffice (δ > 0).
std::vector<ProvedSet> openPoints(const std::vector<ProvedSet>& sets) {
  std::vector<ProvedSet> result;
  for (const auto& set : sets) {
    ProvedSet open{set.rows, {}, {}};
    for (std::size_t i = 0; i < set.points.size(); ++i) {
      const auto& found = *set.points[i]->completeness;
      const bool isDone = found.reason.empty() && set.points[i]->withoutDisc() == 0;
      if (isDone || !(found.definiteness > 0)) continue;
      const auto& problem = set.problems[i];
      open.problems.push_back({problem.at, problem.pencil.with({}), problem.set});
      open.points.push_back(set.points[i]);
    }
    if (!open.points.empty()) result.push_back(std::move(open));
  }
  return result;
}

/// Collective. Proves these lists again, and keeps the better results.
void proveAgain(reduction::ReducedProblem& reduced, const pencil::FrictionFactors& factors,
                const SetMatrices& common, const std::vector<ProvedSet>& sets,
                const Settings& settings) {
  std::vector<pencil::Completeness> before;
  for (const auto& set : sets)
    for (auto* point : set.points)
      before.push_back(std::exchange(*point->completeness, pencil::Completeness()));
  proveSets(reduced, factors, common, sets, settings);
  auto first = before.begin();
  for (const auto& set : sets)
    for (auto* point : set.points) {
      keepBetter(std::move(*first), *point->completeness);
      ++first;
    }
}

}  // namespace

bool covers(const reduction::PointProblem& problem, const pencil::FrictionFactors& factors) {
  const auto& terms = problem.pencil.terms();
  if (!factors.missing.empty()) return false;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const auto& term = terms[t];
    if (term.coefficient(problem.at) == 0) continue;
    if (t >= problem.pencil.affineCount()) return false;  // only of this point
    if (term.isAssociated()) continue;
    if (term.power == 1 || term.speedExponent != 0 || !term.containsFriction()) return false;
  }
  return true;
}

void share(MPI_Comm comm, const std::vector<pencil::ComplexModes*>& points) {
  const int ranks = mpi::size(comm);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const int owner = static_cast<int>(i % ranks);
    broadcast(comm, *points[i]->completeness, owner);
    mpi::broadcast(comm, points[i]->eigenvalues, owner);
  }
}

void prove(reduction::ReducedProblem& reduced, const factor::AssociatedSystem& system,
           const modes::Modes& modes, const pencil::FrictionFactors& factors,
           const std::vector<ProvedSet>& sets, const Settings& settings) {
  if (sets.empty()) return;
  const auto associated = sets.front().problems.front().pencil.associated();
  const auto known = knownModes(reduced, system, modes, associated);
  for (const auto& set : sets)
    for (auto* point : set.points) {
      point->completeness.emplace();
      if (!known) point->completeness->reason = unconfirmed;
    }
  if (!known) return;
  const OwnedMat mass = associated.assembled(2, {});
  auto common = commonProducts(reduced, factors, *known, modes.lambda, mass);
  proveSets(reduced, factors, common, sets, settings);
  const auto open = openPoints(sets);
  if (open.empty() || common.solved == reduced.basisSize()) return;
  // The exact products with the responses may decide.
  completeMassFlexibility(reduced, mass, common.solved, common.massProduct);
  common.solved = reduced.basisSize();
  proveAgain(reduced, factors, common, open, settings);
}

}  // namespace squeal::completeness
