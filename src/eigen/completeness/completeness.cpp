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

/// Returns the unit matrix.
DenseMatrix unit(PetscInt size) {
  DenseMatrix result(size, size);
  for (PetscInt i = 0; i < size; ++i) result(i, i) = 1;
  return result;
}

/// Proves the list of a point, if the bounds suffice.
void proveList(const SetBounds& set, PointMatrices matrices, const Settings& settings,
               const pencil::WatchedBand& band, pencil::ComplexModes& point) {
  auto& found = *point.completeness;
  const double wanted = wantedTop(point.bandTop);
  const auto isSingle = [](const auto& disc) { return disc.isolation == proof::Isolation::single; };
  bool isLast = matrices.vectors.columns() == 0;
  for (bool isDone = false; !isDone; isLast = true) {
    if (isLast) matrices.vectors = unit(matrices.problem.order());  // all of V
    const auto bounds = pointBounds(set, matrices);
    const proof::DiagonalForm form(bounds.kept, wanted);
    const proof::Region region{proof::placedTop(form.eigenvalues(), wanted, within)};
    const auto count = proof::proveCount(form, bounds.leftOut, region, settings.discs);
    const auto discs = proof::enclose(form, bounds.leftOut, region, count);
    isDone =
        isLast || (count.verdict == proof::Verdict::proved && std::ranges::all_of(discs, isSingle));
    if (!isDone) continue;
    recordCount(region, count, found);
    found.reason = proof::reason(count, remedies("-modes_count"));
    judgeList(discs, region, band, point);
  }
}

/// Collective. Returns the products of the whole basis that all points share. Adds the static
/// responses to the slip rows to the basis.
SetMatrices commonProducts(reduction::ReducedProblem& reduced,
                           const pencil::FrictionFactors& factors, const KnownModes& modes,
                           const std::vector<double>& lambda, Mat mass) {
  SetMatrices result;
  result.modes = modes;
  result.slipFlexibility = addResponses(reduced, factors);
  const auto& basis = reduced.basis();
  for (const auto& slip : factors.slip)
    result.slip.push_back(reduction::productWithBasis(basis, slip.matrix));
  result.normal = reduction::productWithBasis(basis, factors.normalOf(0));
  result.inertia = reduction::productWithBasis(basis, factors.normalOf(2));
  result.normalFlexibility = reduced.flexibility(columnsOf(factors.normalOf(0)));
  result.inertiaFlexibility = reduced.flexibility(columnsOf(factors.normalOf(2)));
  result.massProduct = massFlexibility(reduced, modes, lambda, mass);
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
PointMatrices dataOf(const reduction::ReducedProblem& reduced,
                     const pencil::FrictionFactors& factors,
                     const reduction::PointProblem& problem) {
  PointMatrices data{reduced.project(problem), {}, {}};
  for (const auto& slip : factors.slip)
    data.slipFactors.push_back(std::pow(problem.at.friction, slip.frictionExponent));
  data.vectors = DenseMatrix(data.problem.order());
  if (const auto pairs = reduced.watchedPairs(problem.at, problem.set))
    for (const auto& pair : *pairs) appendParts(pair.q, data.vectors);
  return data;
}

/// Collective. Proves the lists of a set.
void proveSet(reduction::ReducedProblem& reduced, const pencil::FrictionFactors& factors,
              const SetMatrices& matrices, const ProvedSet& set, const Settings& settings) {
  const SetBounds bounds = setBounds(matrices, reach * set.points.front()->bandTop);
  const MPI_Comm comm = reduced.basis().comm();
  const std::size_t ranks = mpi::size(comm);
  for (std::size_t first = 0; first < set.points.size(); first += ranks) {
    const std::size_t count = std::min(ranks, set.points.size() - first);
    std::optional<PointMatrices> own;
    for (std::size_t i = 0; i < count; ++i) {
      auto data = dataOf(reduced, factors, set.problems[first + i]);
      if (mpi::rank(comm) == static_cast<int>(i)) own = std::move(data);
    }
    linalg::onOwners(comm, count, [&](std::size_t i) {
      proveList(bounds, std::move(*own), settings, reduced.band(), *set.points[first + i]);
    });
  }
}

}  // namespace

bool covers(const reduction::PointProblem& problem, const pencil::FrictionFactors& factors) {
  const auto& terms = problem.pencil.terms();
  if (!factors.missing.empty()) return false;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const auto& term = terms[t];
    if (term.coefficient(problem.at) == 0 || term.isAssociated()) continue;
    if (t >= problem.pencil.affineCount() || term.power == 1 || term.speedExponent != 0 ||
        !term.containsFriction())
      return false;
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
  const auto common =
      commonProducts(reduced, factors, *known, modes.lambda, associated.assembled(2, {}));
  for (const auto& set : sets) {
    const auto& problem = set.problems.front();
    const auto matrices =
        matricesOf(set, reduced.space(problem.set), reduced.projectAssociated(problem.set), common);
    try {
      proveSet(reduced, factors, matrices, set, settings);
    } catch (const Error& error) {
      for (auto* point : set.points)
        if (!point->completeness->proved) point->completeness->reason = error.what();
    }
    share(reduced.basis().comm(), set.points);
  }
}

}  // namespace squeal::completeness
