#include "impedance/contact_solver.hpp"

#include <slepcblaslapack.h>

#include <algorithm>
#include <cmath>

#include "linalg/block.hpp"
#include "linalg/symmetric.hpp"
#include "petsc/concatenation.hpp"

namespace squeal::impedance {

using linalg::DenseMatrix;
using linalg::DenseView;

namespace {

/// The friction is solved for to this part of what causes it. The residual of all equations is
/// refined where less is not enough.
constexpr double asked = 1e-13, accepted = 1e-8;
/// Directions of the stiffness of the open gaps that are softer than this part of the stiffest are
/// those of a loose body.
constexpr double loose = 1e-12;
/// The largest number of directions that one call adds.
constexpr PetscInt mostDirections = 500;

/// Collective. Returns the rows of all ranks, on every rank.
DenseMatrix gathered(const Concatenation& ranks, const DenseView& rows) {
  DenseMatrix all(ranks.size(), rows.columns());
  for (PetscInt j = 0; j < rows.columns(); ++j) ranks.gather(rows.column(j), all.column(j));
  return all;
}

/// The inverse of a symmetric matrix that should be positive definite.
class SymmetricInverse {
 public:
  explicit SymmetricInverse(DenseMatrix a) : factor_(std::move(a)) {
    PetscBLASInt order = factor_.rows(), info = 0;
    if (order == 0) return;
    const DenseMatrix whole = factor_;
    LAPACKpotrf_("L", &order, factor_.data(), &order, &info);
    if (info == 0) return;
    factor_ = whole;
    values_ = linalg::symmetricEigen(factor_);
  }
  /// Replaces the columns of x by A⁻¹ x, without the directions in which A has no stiffness.
  void apply(DenseMatrix& x) const {
    PetscBLASInt order = factor_.rows(), columns = x.columns(), info = 0;
    if (order == 0 || columns == 0) return;
    if (values_.empty()) {
      LAPACKpotrs_("L", &order, &columns, factor_.data(), &order, x.data(), &order, &info);
      return;
    }
    DenseMatrix parts = linalg::transposedProduct(factor_, x);
    for (PetscInt j = 0; j < parts.columns(); ++j)
      for (PetscInt i = 0; i < parts.rows(); ++i)
        parts(i, j) = values_[i] > loose * values_.back() ? parts(i, j) / values_[i] : 0;
    x = linalg::product(factor_, parts);
  }

 private:
  DenseMatrix factor_;          // Cholesky factor, or eigenvectors
  std::vector<double> values_;  // eigenvalues, if the matrix is not positive definite
};

/// Collective. Returns the coefficients a for which |b − G a| is least. The normal equations are
/// refined, which gives all digits as long as the condition of G is below some 1e7.
DenseMatrix leastSquares(MPI_Comm comm, const DenseView& g, const DenseView& b) {
  const SymmetricInverse inverse(linalg::transposedProduct(comm, g, g));
  DenseMatrix sum(g.columns(), 1), rest(b);
  for (int pass = 0; pass < 3; ++pass) {
    DenseMatrix step = linalg::transposedProduct(comm, g, rest);
    inverse.apply(step);
    linalg::addScaled(sum, 1, step);
    linalg::multiplyAdd(g, step, rest, -1);
  }
  return sum;
}

}  // namespace

/// A FreeBlock holds what the conditions decide: the stiffness of the free unknowns, and what
/// friction does while they are free.
struct ContactSolver::FreeBlock {
  std::vector<unsigned char> free;  // [released unknown]
  OwnedMat direct;                  // kept, so that its address stays its own
  std::vector<PetscInt> local;      // free unknowns of this rank
  std::vector<PetscInt> places;     // [free unknown of any rank] its column
  Concatenation ranks;              // of `local`
  SymmetricInverse stiffness;       // F of w among the free unknowns
  DenseMatrix responses, freed;     // of the friction magnitudes with the free unknowns released
};

ContactSolver::ContactSolver(const Impedance& impedance)
    : impedance_(impedance),
      columns_(impedance.length()),
      magnitudes_(impedance.nodes()),
      responses_(impedance.length()) {
  const PetscInt own = impedance.nodeOf().size();
  check(MPI_Scan(&own, &first_, 1, MPIU_INT, MPI_SUM, impedance.comm()));
  first_ -= own;
}

ContactSolver::~ContactSolver() = default;

/// Finds the columns of unknowns that have not been free before.
void ContactSolver::learn(const std::vector<unsigned char>& free) {
  std::vector<PetscInt> wanted;
  for (std::size_t i = 0; i < free.size(); ++i)
    if (free[i] && place_.count(first_ + i) == 0) wanted.push_back(first_ + i);
  const auto all = concatenated(impedance_.comm(), wanted);
  if (all.empty()) return;
  const PetscInt n = impedance_.nodes(), m = free.size();
  DenseMatrix units(n + m, std::ssize(all));
  for (PetscInt j = 0; j < units.columns(); ++j) {
    if (const PetscInt i = all[j] - first_; i >= 0 && i < m) units(n + i, j) = 1;
    place_.emplace(all[j], place_.size());
  }
  columns_.append(impedance_.responses(units));
}

double ContactSolver::gapStiffness(std::size_t node) const {
  const auto place = place_.find(first_ + node);
  return place == place_.end() ? 0 : columns_(impedance_.nodes() + node, place->second);
}

ContactSolver::FreeBlock& ContactSolver::blockOf(const ContactConditions& conditions) {
  const MPI_Comm comm = impedance_.comm();
  const auto& free = conditions.free;
  const PetscInt n = impedance_.nodes();
  int isClosed = std::none_of(free.begin(), free.begin() + n, [](unsigned char f) { return f; });
  check(MPI_Allreduce(MPI_IN_PLACE, &isClosed, 1, MPI_INT, MPI_LAND, comm));
  auto& last = isClosed ? closed_ : open_;
  int same = last && last->free == free && last->direct.get() == conditions.direct;
  check(MPI_Allreduce(MPI_IN_PLACE, &same, 1, MPI_INT, MPI_LAND, comm));
  if (same) return *last;
  learn(free);
  std::vector<PetscInt> local, mine;
  for (std::size_t i = 0; i < free.size(); ++i)
    if (free[i]) local.push_back(i), mine.push_back(place_.at(first_ + i));
  const Concatenation ranks(comm, local.size());
  auto places = ranks.gathered(mine);
  DenseMatrix rows(local.size(), std::ssize(places));
  for (PetscInt j = 0; j < rows.columns(); ++j)
    for (std::size_t i = 0; i < local.size(); ++i) rows(i, j) = columns_(n + local[i], places[j]);
  DenseMatrix stiffness = linalg::symmetricPart(gathered(ranks, rows));
  OwnedMat direct;
  if (conditions.direct) {
    check(PetscObjectReference(reinterpret_cast<PetscObject>(conditions.direct)));
    direct = OwnedMat(conditions.direct);
  }
  last.reset(new FreeBlock{free, std::move(direct), std::move(local), std::move(places), ranks,
                           SymmetricInverse(std::move(stiffness)), DenseMatrix(impedance_.length()),
                           DenseMatrix(ranks.size())});
  return *last;
}

/// Releases the free unknowns until F = 0 there. Returns them, [free unknown of any rank], and adds
/// what they do to the effects.
DenseMatrix ContactSolver::release(const FreeBlock& block, DenseMatrix& effects) const {
  const PetscInt n = impedance_.nodes();
  DenseMatrix rows(block.local.size(), effects.columns());
  for (PetscInt j = 0; j < effects.columns(); ++j)
    for (std::size_t i = 0; i < block.local.size(); ++i)
      rows(i, j) = -effects(n + block.local[i], j);
  DenseMatrix freed = gathered(block.ranks, rows);
  block.stiffness.apply(freed);
  DenseMatrix amounts(columns_.columns(), freed.columns());
  for (PetscInt j = 0; j < freed.columns(); ++j)
    for (PetscInt i = 0; i < freed.rows(); ++i) amounts(block.places[i], j) = freed(i, j);
  if (!amounts.empty()) linalg::multiplyAdd(columns_, amounts, effects);
  return freed;
}

/// Adds a direction to the space of friction magnitudes, unless it lies in it.
bool ContactSolver::extend(std::vector<double> direction) {
  const PetscInt n = impedance_.nodes();
  const double before = linalg::length(impedance_.comm(), direction);
  DenseMatrix column(n, 1, std::move(direction));
  for (int pass = 0; pass < 2; ++pass)
    linalg::multiplyAdd(
        magnitudes_, linalg::transposedProduct(impedance_.comm(), magnitudes_, column), column, -1);
  const double length = linalg::length(impedance_.comm(), column.entries());
  if (!(length > 1e-10 * before)) return false;
  DenseMatrix cause(impedance_.length(), 1);
  for (PetscInt i = 0; i < n; ++i) column(i, 0) /= length, cause(i, 0) = column(i, 0);
  magnitudes_.append(column);
  responses_.append(impedance_.responses(cause));
  return true;
}

ContactSolution ContactSolver::solve(const ContactConditions& conditions,
                                     const ContactVector& given) {
  FreeBlock& block = blockOf(conditions);
  const auto& coefficient = conditions.coefficient;
  const PetscInt n = impedance_.nodes(), length = impedance_.length();
  const MPI_Comm comm = impedance_.comm();
  DenseMatrix effects(length, 1, given), freed = release(block, effects);
  DenseMatrix wanted(n, 1);  // t without its own effects
  for (PetscInt i = 0; i < n; ++i) wanted(i, 0) = coefficient[i] * effects(i, 0);
  const double size = linalg::length(comm, wanted.entries());
  DenseMatrix weights;
  double left = size;
  for (PetscInt added = 0; size > 0; ++added) {
    if (const PetscInt known = block.responses.columns(); known < responses_.columns()) {
      DenseMatrix fresh(responses_.columnRange(known, responses_.columns()));
      if (block.direct) {
        DenseMatrix forces(length - n);
        linalg::appendProduct(block.direct, magnitudes_.columnRange(known, magnitudes_.columns()),
                              forces);
        for (PetscInt j = 0; j < forces.columns(); ++j)
          for (PetscInt i = 0; i < forces.rows(); ++i) fresh(n + i, j) += forces(i, j);
      }
      block.freed.append(release(block, fresh));
      block.responses.append(fresh);
    }
    DenseMatrix balance = magnitudes_;  // t − c R
    for (PetscInt j = 0; j < balance.columns(); ++j)
      for (PetscInt i = 0; i < n; ++i) balance(i, j) -= coefficient[i] * block.responses(i, j);
    weights = leastSquares(comm, balance, wanted);
    DenseMatrix rest = wanted;
    linalg::multiplyAdd(balance, weights, rest, -1);
    left = linalg::length(comm, rest.entries());
    if (left <= asked * size || added == mostDirections ||
        !extend({rest.entries().begin(), rest.entries().end()}))
      break;
  }
  ContactSolution solution;
  solution.found = std::isfinite(left) && left <= accepted * size;
  solution.causes.assign(length, 0.0);
  if (size > 0) {
    const DenseMatrix t = linalg::product(magnitudes_, weights);
    std::copy(t.data(), t.data() + n, solution.causes.begin());
    linalg::multiplyAdd(block.responses, weights, effects);
    linalg::multiplyAdd(block.freed, weights, freed);
  }
  for (std::size_t i = 0; i < block.local.size(); ++i)
    solution.causes[n + block.local[i]] = freed(block.ranks.ownBegin() + i, 0);
  solution.effects.assign(effects.data(), effects.data() + length);
  return solution;
}

ContactSolution ContactSolver::withGaps(const std::vector<double>& gaps,
                                        ContactConditions conditions, const ContactVector& given) {
  const PetscInt n = impedance_.nodes();
  std::vector<unsigned char> open(conditions.free.size(), 0);
  for (PetscInt i = 0; i < n; ++i) open[i] = gaps[i] != 0;
  learn(open);
  DenseMatrix weights(columns_.columns(), 1), effects(impedance_.length(), 1, given);
  for (PetscInt i = 0; i < n; ++i)
    if (open[i]) weights(place_.at(first_ + i), 0) = gaps[i];
  check(MPI_Allreduce(MPI_IN_PLACE, weights.data(), weights.size(), MPI_DOUBLE, MPI_SUM,
                      impedance_.comm()));
  if (!weights.empty()) linalg::multiplyAdd(columns_, weights, effects);
  std::fill(conditions.free.begin(), conditions.free.begin() + n, 0);
  auto solution = solve(conditions, {effects.data(), effects.data() + effects.rows()});
  std::copy(gaps.begin(), gaps.end(), solution.causes.begin() + n);
  return solution;
}

}  // namespace squeal::impedance
