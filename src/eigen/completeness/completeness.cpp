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

/// Proves the list of a point, if the bounds suffice.
void proveList(const SetBounds& set, PointMatrices matrices, const Settings& settings,
               const pencil::WatchedBand& band, pencil::ComplexModes& point) {
  auto& found = *point.completeness;
  const double wanted = wantedTop(point.bandTop);
  const auto bounds = pointBounds(set, std::move(matrices));
  const proof::DiagonalForm form(bounds.kept, wanted);
  const proof::Region region{proof::placedTop(form.eigenvalues(), wanted, within)};
  const auto count = proof::proveCount(form, bounds.leftOut, region, settings.discs);
  recordCount(region, count, found);
  found.reason = proof::reason(count, remedies("-modes_count"));
  judgeList(proof::enclose(form, bounds.leftOut, region, count), region, band, point);
}

/// The factors of friction with the vectors of the basis.
struct ProjectedFactors {
  std::vector<DenseMatrix> slip;    // [power of the friction] S_a V, r × size
  DenseMatrix normal, inertia;      // N_0 V, N_2 V, r × size
  std::vector<DenseMatrix> ofSlip;  // [power of the friction] S_a K0⁻¹ S_aᵀ, r × r
  DenseMatrix ofMass;               // Vᵀ M K0⁻¹ M V, size × size
  DenseMatrix ofNormal, ofInertia;  // N_0 K0⁻¹ N_0ᵀ, N_2 K0⁻¹ N_2ᵀ, r × r
};

/// Collective. Adds the static responses to the slip rows to the basis.
ProjectedFactors project(reduction::ReducedProblem& reduced, const pencil::FrictionFactors& factors,
                         const KnownModes& modes, const std::vector<double>& lambda, Mat mass) {
  ProjectedFactors result;
  result.ofSlip = addResponses(reduced, factors);
  const auto& basis = reduced.basis();
  for (const auto& slip : factors.slip)
    result.slip.push_back(reduction::productWithBasis(basis, slip.matrix));
  result.normal = reduction::productWithBasis(basis, factors.normalOf(0));
  result.inertia = reduction::productWithBasis(basis, factors.normalOf(2));
  result.ofNormal = reduced.flexibility(columnsOf(factors.normalOf(0)));
  result.ofInertia = reduced.flexibility(columnsOf(factors.normalOf(2)));
  result.ofMass = massFlexibility(reduced, modes, lambda, mass);
  return result;
}

/// Subtracts from N K0⁻¹ Nᵀ the part of the interior vectors of V.
void subtractKept(const DenseMatrix& rows, PetscInt boundary, DenseMatrix& flexibility) {
  const DenseMatrix inner(rows.columnRange(boundary, rows.columns()));
  linalg::addScaled(flexibility, -1, linalg::product(inner, linalg::transposed(inner)));
}

/// Returns a bound of ‖S x‖ for x in C with energy 1, from S V and S K0⁻¹ Sᵀ.
double slipError(const DenseMatrix& rows, PetscInt boundary, DenseMatrix flexibility) {
  double trace = 0;
  for (PetscInt i = 0; i < flexibility.rows(); ++i) trace += flexibility(i, i);
  subtractKept(rows, boundary, flexibility);
  const auto values = linalg::symmetricEigenvalues(linalg::symmetricPart(flexibility));
  return std::sqrt(std::max(values.empty() ? 0 : values.back(), 0.0) + 1e-15 * trace);
}

/// The matrices of an active set, the same on all ranks.
struct SetProjection {
  std::vector<DenseMatrix> slip;   // [power of the friction] S_a V, r × N
  std::vector<double> slipErrors;  // [power of the friction] ‖S_a x‖ of x in C with energy 1
  SetMatrices matrices;
};

/// Returns the matrices of a set from those of the basis. `associated` has K0 and M0 on V.
SetProjection projectionOf(const ProvedSet& set, const subspace::PointSpace& space,
                           linalg::DenseProblem associated, const KnownModes& modes,
                           const ProjectedFactors& projected) {
  const auto onSet = [&](const DenseMatrix& rows) {
    return space.restrictedColumns(linalg::rowsOf(set.rows, rows));
  };
  SetProjection result;
  SetMatrices& matrices = result.matrices;
  matrices.modes = modes;
  matrices.modes.first = space.own();
  // The vectors of V · turn are orthonormal in energy.
  const DenseMatrix turn = linalg::inverseTransposed(linalg::choleskyFactor(associated.stiffness));
  const auto turned = [&](const DenseMatrix& rows) { return linalg::product(rows, turn); };
  for (std::size_t a = 0; a < projected.slip.size(); ++a) {
    result.slip.push_back(onSet(projected.slip[a]));
    result.slipErrors.push_back(slipError(turned(result.slip[a]), space.own(),
                                          linalg::principalPart(set.rows, projected.ofSlip[a])));
  }
  matrices.normal = onSet(projected.normal);
  matrices.inertia = onSet(projected.inertia);
  matrices.leftNormal = linalg::principalPart(set.rows, projected.ofNormal);
  matrices.leftInertia = linalg::principalPart(set.rows, projected.ofInertia);
  subtractKept(turned(matrices.normal), space.own(), matrices.leftNormal);
  subtractKept(turned(matrices.inertia), space.own(), matrices.leftInertia);
  linalg::DenseProblem flexible;
  flexible.stiffness = projected.ofMass;
  matrices.leftMass = linalg::congruent(space.restricted(std::move(flexible)).stiffness, turn);
  subtractKept(linalg::congruent(associated.mass, turn), space.own(), matrices.leftMass);
  matrices.energy = std::move(associated.stiffness);
  return result;
}

/// Collective. Proves the lists of a set.
void proveSet(reduction::ReducedProblem& reduced, const pencil::FrictionFactors& factors,
              const SetProjection& projection, const ProvedSet& set, const Settings& settings) {
  const SetBounds bounds = setBounds(projection.matrices, reach * set.points.front()->bandTop);
  std::vector<linalg::DenseProblem> problems;
  for (const auto& problem : set.problems) problems.push_back(reduced.project(problem));
  linalg::onOwners(reduced.basis().comm(), set.points.size(), [&](std::size_t i) {
    auto& point = *set.points[i];
    PointMatrices matrices{std::move(problems[i]), {}, 0};
    for (std::size_t a = 0; a < projection.slip.size(); ++a) {
      const double factor = std::pow(point.at.friction, factors.slip[a].frictionExponent);
      linalg::addScaled(matrices.slip, factor, projection.slip[a]);
      matrices.slipError += factor * projection.slipErrors[a];
    }
    proveList(bounds, std::move(matrices), settings, reduced.band(), point);
  });
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
  const auto projected =
      project(reduced, factors, *known, modes.lambda, associated.assembled(2, {}));
  for (const auto& set : sets) {
    const auto& problem = set.problems.front();
    const auto projection = projectionOf(set, reduced.space(problem.set),
                                         reduced.projectAssociated(problem), *known, projected);
    try {
      proveSet(reduced, factors, projection, set, settings);
    } catch (const Error& error) {
      for (auto* point : set.points) point->completeness->reason = error.what();
    }
    share(reduced.basis().comm(), set.points);
  }
}

}  // namespace squeal::completeness
