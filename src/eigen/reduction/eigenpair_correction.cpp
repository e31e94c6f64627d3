#include "eigen/reduction/eigenpair_correction.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <random>

#include "algebra/linalg/complexdense.hpp"
#include "algebra/linalg/lu.hpp"
#include "base/petsc/check.hpp"
#include "base/petsc/log_events.hpp"

namespace squeal::reduction {
namespace {

using linalg::ComplexMatrix;
using linalg::DensePair;
using linalg::DenseProblem;

double length(std::span<const Complex> x) { return std::sqrt(innerProduct(x, x).real()); }

/// Scales each column to length one.
void normalise(ComplexMatrix& x) {
  for (PetscInt j = 0; j < x.columns(); ++j) {
    const double size = length(x.column(j));
    for (auto& entry : x.column(j)) entry /= size;
  }
}

void append(ComplexMatrix& x, const ComplexMatrix& more) {
  for (PetscInt j = 0; j < more.columns(); ++j) x.append(more.column(j));
}

/// Returns the rows [first, last).
ComplexMatrix rowsOf(const ComplexMatrix& x, PetscInt first, PetscInt last) {
  ComplexMatrix result(last - first, x.columns());
  for (PetscInt j = 0; j < x.columns(); ++j)
    for (PetscInt i = first; i < last; ++i) result(i - first, j) = x(i, j);
  return result;
}

ComplexMatrix stacked(const ComplexMatrix& top, const ComplexMatrix& bottom) {
  ComplexMatrix result(2 * top.rows(), top.columns());
  for (PetscInt j = 0; j < top.columns(); ++j) {
    std::ranges::copy(top.column(j), result.column(j).begin());
    std::ranges::copy(bottom.column(j), result.column(j).begin() + top.rows());
  }
  return result;
}

/// Computes sum += factor X.
void addScaled(ComplexMatrix& sum, Complex factor, const ComplexMatrix& x) {
  ensure(sum.rows() == x.rows() && sum.columns() == x.columns(),
         "a sum is of matrices of the same size");
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const Complex entry = x.data()[i];
    sum.data()[i] += Complex(factor.real() * entry.real() - factor.imag() * entry.imag(),
                             factor.real() * entry.imag() + factor.imag() * entry.real());
  }
}

/// A Companion lifts a quadratic problem to the linear one of twice the size
///   A z = s B z,   A = [0 I; −K −Z],   B = [I 0; 0 M],   z = (x, s x / unit),
/// where `unit` makes both halves alike. A left vector y becomes the functional yᴴ[(sM + Z)u + M v]
/// of (u, v / unit), which is zero for the right vectors of all other eigenvalues.
class Companion {
 public:
  Companion(const DenseProblem& problem, double unit) : problem_(&problem), unit_(unit) {}
  const DenseProblem& problem() const { return *problem_; }
  PetscInt order() const { return problem_->order(); }
  double unit() const { return unit_; }
  /// Returns the right vectors of the pairs, 2m × pairs.
  ComplexMatrix right(const std::vector<const DensePair*>& pairs) const {
    ComplexMatrix x(order()), v;
    for (const auto* pair : pairs) x.append(std::span<const Complex>(pair->q));
    v = x;
    for (std::size_t j = 0; j < pairs.size(); ++j)
      for (auto& entry : v.column(j)) entry *= pairs[j]->s / unit_;
    return stacked(x, v);
  }
  /// Returns the functionals l of the left vectors, lᴴ(u, v / unit), of length one.
  ComplexMatrix left(const std::vector<const DensePair*>& pairs) const {
    ComplexMatrix y(order());
    for (const auto* pair : pairs) y.append(std::span<const Complex>(pair->left));
    ComplexMatrix top = linalg::product(problem_->damping, y, true),
                  bottom = linalg::product(problem_->mass, y, true);
    for (std::size_t j = 0; j < pairs.size(); ++j)
      for (PetscInt i = 0; i < order(); ++i) {
        top(i, j) += std::conj(pairs[j]->s) * bottom(i, j);
        bottom(i, j) *= unit_;
      }
    ComplexMatrix result = stacked(top, bottom);
    normalise(result);
    return result;
  }

 private:
  const DenseProblem* problem_;
  double unit_;
};

/// A ShiftInvert is the operator (A − σB)⁻¹B of a companion form.
class ShiftInvert {
 public:
  ShiftInvert(const Companion& companion, Complex shift)
      : companion_(companion), shift_(shift), factors_(matrix(companion.problem(), shift)) {}
  bool regular() const { return factors_.pivotRatio() > 0; }
  /// Returns the operator times the columns z.
  ComplexMatrix apply(const ComplexMatrix& z) const {
    //   P(σ) x = −[M v + (Z + σM) u],   and the new v is u + σ x
    const PetscInt m = companion_.order();
    const auto& problem = companion_.problem();
    const ComplexMatrix u = rowsOf(z, 0, m);
    ComplexMatrix v = rowsOf(z, m, 2 * m);
    for (auto& entry : v.entries()) entry *= -companion_.unit();
    addScaled(v, -shift_, u);
    ComplexMatrix x = linalg::product(problem.mass, v);
    addScaled(x, -1, linalg::product(problem.damping, u));
    factors_.solve(x);
    ComplexMatrix next = u;
    addScaled(next, shift_, x);
    for (auto& entry : next.entries()) entry /= companion_.unit();
    return stacked(x, next);
  }
  /// Returns t = −P(σ)⁻ᴴ (l₁ + σ̄ l₂ / unit): of a functional that is an eigenvector, the left
  /// vector of P.
  ComplexMatrix leftVectors(const ComplexMatrix& l) const {
    const PetscInt m = companion_.order();
    ComplexMatrix t = rowsOf(l, 0, m);
    addScaled(t, std::conj(shift_) / companion_.unit(), rowsOf(l, m, 2 * m));
    factors_.solve(t, true);
    for (auto& entry : t.entries()) entry = -entry;
    return t;
  }
  /// Returns the adjoint of the operator times the columns l.
  ComplexMatrix applyAdjoint(const ComplexMatrix& l) const {
    //   top: (Z + σM)ᴴ t + l₂ / unit,   bottom: unit Mᵀ t
    const PetscInt m = companion_.order();
    const auto& problem = companion_.problem();
    const ComplexMatrix t = leftVectors(l);
    ComplexMatrix bottom = linalg::product(problem.mass, t, true),
                  top = linalg::product(problem.damping, t, true);
    addScaled(top, std::conj(shift_), bottom);
    addScaled(top, 1 / companion_.unit(), rowsOf(l, m, 2 * m));
    for (auto& entry : bottom.entries()) entry *= companion_.unit();
    return stacked(top, bottom);
  }

 private:
  static ComplexMatrix matrix(const DenseProblem& problem, Complex shift) {
    const auto &mass = problem.mass, &damping = problem.damping, &stiffness = problem.stiffness;
    const PetscInt m = problem.order();
    const Complex square = shift * shift;
    ComplexMatrix sum(m, m);
    for (PetscInt j = 0; j < m; ++j)
      for (PetscInt i = 0; i < m; ++i)
        sum(i, j) = {square.real() * mass(i, j) + stiffness(i, j), square.imag() * mass(i, j)};
    for (PetscInt j = 0; j < damping.columns(); ++j)
      for (PetscInt i = 0; i < m; ++i)
        sum(i, j) += Complex(shift.real() * damping(i, j), shift.imag() * damping(i, j));
    return sum;
  }

  const Companion& companion_;
  Complex shift_;
  linalg::Lu<Complex> factors_;
};

/// A Group is a number of pairs that are improved together.
class Group {
 public:
  /// Borrows the companion form and the pairs, all of its order.
  Group(const Companion& companion, std::vector<DensePair>& pairs,
        const std::vector<UnconvergedPair>& open)
      : companion_(companion), pairs_(pairs) {
    for (const auto& one : open) {
      members_.push_back(one.pair);
      wanted_.right.push_back(one.right);
      wanted_.left.push_back(one.left);
    }
    double low = std::numeric_limits<double>::infinity(), high = -low, real = 0;
    for (const auto j : members_) {
      real += pairs_[j].s.real() / members_.size();
      low = std::min(low, pairs_[j].s.imag());
      high = std::max(high, pairs_[j].s.imag());
    }
    const Complex middle(real, 0.5 * (low + high));
    for (const auto j : members_) reach_ = std::max(reach_, std::abs(pairs_[j].s - middle));
    reach_ = std::max(reach_, 1e-3 * std::abs(middle));
    shift_ = middle + reach_ * Complex(0.1, 0.05);  // beside an eigenvalue, not on it
    for (std::size_t j = 0; j < pairs_.size(); ++j)
      if (std::ranges::find(members_, j) == members_.end() &&
          std::abs(pairs_[j].s - middle) <= neighbourhood * reach_)
        neighbours_.push_back(j);
  }

  const std::vector<std::size_t>& members() const { return members_; }

  /// Steps until the residuals are small, at least once if `anew`, and at most `patience` times.
  enum class Outcome { untouched, done, unfinished, failed };
  Outcome iterate(bool anew) {
    constexpr int patience = 2;
    Outcome outcome = done() ? Outcome::untouched : Outcome::unfinished;
    if (outcome == Outcome::untouched && !anew) return outcome;
    for (int step = 0; step < patience && outcome != Outcome::done; ++step) {
      if (!this->step()) return Outcome::failed;
      outcome = done() ? Outcome::done : Outcome::unfinished;
    }
    inverse_.reset();  // there is one of these large matrices at a time
    return outcome;
  }

 private:
  static constexpr double neighbourhood = 2.5;  // of the reach of the members

  /// Returns true if the residuals are as small as they are to be.
  bool done() {
    const Residuals now = residuals();
    if (first_.right.empty()) {
      first_ = now;
      rounding_ = rounding();
    }
    for (std::size_t j = 0; j < members_.size(); ++j)
      if (now.right[j] > std::max(wanted_.right[j] * first_.right[j], rounding_) ||
          now.left[j] > std::max(wanted_.left[j] * first_.left[j], rounding_))
        return false;
    return true;
  }

  /// Projects the operator on the vectors of the group and its neighbours, and those of the group
  /// times the operator, right and left. Takes what belongs to the members, times the operator.
  /// Returns false if that fails.
  bool step() {
    if (!inverse_) inverse_.emplace(companion_, shift_);
    if (!inverse_->regular()) return false;
    std::vector<const DensePair*> members, known;
    for (const auto j : members_) members.push_back(&pairs_[j]);
    known = members;
    for (const auto j : neighbours_) known.push_back(&pairs_[j]);
    const ComplexMatrix right = companion_.right(known), left = companion_.left(known);
    ComplexMatrix trial = right, test = left;
    append(trial, inverse_->apply(companion_.right(members)));
    append(test, inverse_->applyAdjoint(companion_.left(members)));
    for (auto* space : {&trial, &test}) {
      if (space->columns() > space->rows()) space->resizeColumns(space->rows());
      normalise(*space);
      linalg::orthonormalise(*space);
    }
    const ComplexMatrix images = inverse_->apply(trial);
    const linalg::Lu<Complex> mass(linalg::adjointProduct(test, trial));
    if (mass.pivotRatio() == 0) return false;
    ComplexMatrix projected = linalg::adjointProduct(test, images);
    mass.solve(projected);
    linalg::ComplexEigen ritz = linalg::eigen(std::move(projected));
    mass.solve(ritz.left, true);
    const auto mine =
        assigned(right, left, linalg::product(trial, ritz.right), linalg::product(test, ritz.left));
    ComplexMatrix x(trial.columns()), y(trial.columns());
    for (std::size_t j = 0; j < members_.size(); ++j) {
      if (!mine[j] || ritz.value[*mine[j]] == 0.0) return false;
      x.append(std::span<const Complex>(ritz.right.column(*mine[j])));
      y.append(std::span<const Complex>(ritz.left.column(*mine[j])));
    }
    x = linalg::product(rowsOf(images, 0, companion_.order()), x);
    y = inverse_->leftVectors(linalg::product(test, y));
    for (std::size_t j = 0; j < members_.size(); ++j) {
      DensePair& pair = pairs_[members_[j]];
      pair.s = shift_ + 1.0 / ritz.value[*mine[j]];
      for (const auto& [to, from] : {std::pair{&pair.q, &x}, std::pair{&pair.left, &y}}) {
        const double size = length(from->column(j));
        if (!(size > 0) || !std::isfinite(size)) return false;
        for (std::size_t i = 0; i < to->size(); ++i) (*to)[i] = (*from)(i, j) / size;
      }
    }
    return true;
  }

  /// The lengths of P(s) x and P(s)ᴴ y for vectors of length one, [member].
  struct Residuals {
    std::vector<double> right, left;
  };

  Residuals residuals() const {
    const DenseProblem& problem = companion_.problem();
    const auto side = [&](std::vector<Complex> DensePair::*vector, bool left) {
      ComplexMatrix x(companion_.order());
      for (const auto j : members_) x.append(std::span<const Complex>(pairs_[j].*vector));
      const ComplexMatrix k = linalg::product(problem.stiffness, x, left),
                          z = linalg::product(problem.damping, x, left),
                          m = linalg::product(problem.mass, x, left);
      std::vector<double> lengths;
      for (std::size_t j = 0; j < members_.size(); ++j) {
        const Complex s = left ? std::conj(pairs_[members_[j]].s) : pairs_[members_[j]].s;
        double sum = 0;
        for (PetscInt i = 0; i < x.rows(); ++i)
          sum += std::norm(k(i, j) + s * (z(i, j) + s * m(i, j)));
        lengths.push_back(std::sqrt(sum) / length(x.column(j)));
      }
      return lengths;
    };
    return {side(&DensePair::q, false), side(&DensePair::left, true)};
  }

  /// Returns the length of a residual that may be nothing but rounding, in the residual or in a
  /// solve.
  double rounding() const {
    constexpr double margin = 100;
    const DenseProblem& problem = companion_.problem();
    double largest = 0;
    for (const auto j : members_) largest = std::max(largest, std::abs(pairs_[j].s));
    const auto norm = [](const linalg::DenseMatrix& a) {
      return std::sqrt(linalg::squaredLength(a.entries()));
    };
    return margin * std::numeric_limits<double>::epsilon() *
           (norm(problem.stiffness) + largest * norm(problem.damping) +
            largest * largest * norm(problem.mass));
  }

  /// Assigns Ritz pairs to the known pairs, those with the largest trace of the product of their
  /// spectral projectors [M.41] first, each once. Returns those of the members, [member].
  std::vector<std::optional<std::size_t>> assigned(const ComplexMatrix& right,
                                                   const ComplexMatrix& left,
                                                   const ComplexMatrix& ritzRight,
                                                   const ComplexMatrix& ritzLeft) const {
    const ComplexMatrix there = linalg::adjointProduct(left, ritzRight),
                        back = linalg::adjointProduct(ritzLeft, right);
    const auto own = [](const ComplexMatrix& l, const ComplexMatrix& r, PetscInt j) {
      return innerProduct(std::span<const Complex>(l.column(j)),
                          std::span<const Complex>(r.column(j)));
    };
    std::multimap<double, std::pair<std::size_t, std::size_t>, std::greater<>> traces;
    for (PetscInt k = 0; k < there.columns(); ++k) {
      const Complex ofRitz = own(ritzLeft, ritzRight, k);
      for (PetscInt j = 0; j < there.rows(); ++j)
        if (const double trace =
                std::abs(there(j, k) * back(k, j) / (own(left, right, j) * ofRitz));
            std::isfinite(trace))
          traces.emplace(trace, std::pair{j, k});
    }
    std::vector<std::optional<std::size_t>> of(there.rows());
    std::vector<bool> taken(there.columns(), false);
    for (const auto& [trace, both] : traces) {
      const auto [j, k] = both;
      if (of[j] || taken[k]) continue;
      of[j] = k;
      taken[k] = true;
    }
    of.resize(members_.size());
    return of;
  }

  const Companion& companion_;
  std::vector<DensePair>& pairs_;
  std::vector<std::size_t> members_, neighbours_;
  Complex shift_ = 0;
  double reach_ = 0;  // largest distance of a member from the middle
  std::optional<ShiftInvert> inverse_;
  Residuals wanted_, first_;  // parts of the first ones, see UnconvergedPair
  double rounding_ = 0;
};

/// Returns the open pairs in groups of neighbours, none wider than a part of all pairs.
std::vector<std::vector<UnconvergedPair>> groupsOf(const std::vector<DensePair>& pairs,
                                                   std::vector<UnconvergedPair> open) {
  constexpr double widestPart = 0.2;
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const auto& pair : pairs) {
    low = std::min(low, pair.s.imag());
    high = std::max(high, pair.s.imag());
  }
  const auto place = [&](const UnconvergedPair& one) { return pairs[one.pair].s.imag(); };
  std::ranges::sort(open, {}, place);
  std::vector<std::vector<UnconvergedPair>> groups;
  for (const auto& one : open) {
    if (groups.empty() || place(one) - place(groups.back().front()) > widestPart * (high - low))
      groups.emplace_back();
    groups.back().push_back(one);
  }
  return groups;
}

/// Returns true if two pairs are the same: equal eigenvalues and parallel vectors.
bool haveMet(const std::vector<DensePair>& pairs) {
  constexpr double equal = 1e-9, parallel = 1 - 1e-8;
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t j) { return pairs[j].s.imag(); });
  for (std::size_t a = 0; a < order.size(); ++a)
    for (std::size_t b = a + 1; b < order.size(); ++b) {
      const DensePair &x = pairs[order[a]], &y = pairs[order[b]];
      if (y.s.imag() - x.s.imag() > equal * std::abs(x.s)) break;
      if (std::abs(y.s - x.s) <= equal * std::abs(x.s) &&
          std::abs(innerProduct(x.q, y.q)) > parallel * length(x.q) * length(y.q))
        return true;
    }
  return false;
}

/// A Deflation takes the part of known eigenvectors and of their conjugates out of vectors of the
/// companion form.
class Deflation {
 public:
  Deflation(const Companion& companion, const std::vector<const DensePair*>& pairs)
      : right_(companion.right(pairs)), left_(companion.left(pairs)) {
    for (std::size_t j = 0; j < pairs.size(); ++j) {
      if (pairs[j]->s.imag() == 0) continue;
      for (auto* vectors : {&right_, &left_}) {
        std::vector<Complex> conjugate(vectors->column(j).begin(), vectors->column(j).end());
        for (auto& entry : conjugate) entry = std::conj(entry);
        vectors->append(std::span<const Complex>(conjugate));
      }
    }
    gram_.emplace(linalg::adjointProduct(left_, right_));
  }
  void apply(ComplexMatrix& z) const {
    ComplexMatrix coefficients = linalg::adjointProduct(left_, z);
    gram_->solve(coefficients);
    addScaled(z, -1, linalg::product(right_, coefficients));
  }

 private:
  ComplexMatrix right_, left_;
  std::optional<linalg::Lu<Complex>> gram_;
};

/// Returns the eigenvalues s = σ + 1/t for the Ritz values t of (A − σB)⁻¹B that the Arnoldi method
/// finds where known vectors are deflated.
std::vector<Complex> arnoldi(const Companion& companion, const Deflation& deflation,
                             Complex shift) {
  constexpr PetscInt mostSteps = 16;
  constexpr double converged = 0.1;  // of a Ritz value: enough to tell where it lies
  const PetscInt rows = 2 * companion.order(), steps = std::min(mostSteps, rows);
  const ShiftInvert inverse(companion, shift);
  ComplexMatrix basis(rows), z(rows, 1), hessenberg(steps + 1, steps);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (auto& entry : z.entries()) entry = {uniform(random), uniform(random)};
  PetscInt size = 0;
  for (;; ++size) {
    deflation.apply(z);
    for (int pass = 0; pass < 2 && size > 0; ++pass) {
      const ComplexMatrix h = linalg::adjointProduct(basis, z);
      for (PetscInt i = 0; i < size; ++i) hessenberg(i, size - 1) += h(i, 0);
      addScaled(z, -1, linalg::product(basis, h));
    }
    const double rest = length(z.column(0));
    if (size > 0) hessenberg(size, size - 1) = rest;
    if (size == steps || !(rest > 0) || !std::isfinite(rest)) break;
    for (auto& entry : z.entries()) entry /= rest;
    basis.append(std::span<const Complex>(z.column(0)));
    z = inverse.apply(z);
  }
  ComplexMatrix square(size, size);
  for (PetscInt j = 0; j < size; ++j)
    for (PetscInt i = 0; i < size; ++i) square(i, j) = hessenberg(i, j);
  const linalg::ComplexEigen solved = linalg::eigen(std::move(square));
  std::vector<Complex> found;
  for (PetscInt k = 0; k < size; ++k) {
    const double residual =
        std::abs(hessenberg(size, size - 1)) * std::abs(solved.right(size - 1, k));
    if (solved.value[k] != 0.0 && residual <= converged * std::abs(solved.value[k]))
      found.push_back(shift + 1.0 / solved.value[k]);
  }
  return found;
}

/// Returns the largest |s| of a list; 1 if there is none.
double largest(const std::vector<DensePair>& pairs) {
  double size = 0;
  for (const auto& pair : pairs) size = std::max(size, std::abs(pair.s));
  return size > 0 ? size : 1;
}

/// A group of one of several problems.
struct OwnedGroup {
  std::size_t task;
  Group group;
};

/// Collective. Sends the members of these groups from the ranks that have improved them to all.
/// Group g is of the rank g modulo the number of ranks.
void share(MPI_Comm comm, const std::vector<CorrectionTask>& tasks,
           const std::vector<OwnedGroup>& groups, const std::vector<bool>& improved) {
  int rank = 0, ranks = 1;
  check(MPI_Comm_rank(comm, &rank));
  check(MPI_Comm_size(comm, &ranks));
  const auto membersOf = [&](int owner, const auto& action) {
    for (std::size_t g = owner; g < groups.size(); g += ranks)
      if (improved[g])
        for (const auto j : groups[g].group.members()) action((*tasks[groups[g].task].pairs)[j]);
  };
  const auto forAll = [](DensePair& pair, const auto& action) {
    action(std::span(&pair.s, 1));
    action(std::span(pair.q));
    action(std::span(pair.left));
  };
  std::vector<int> counts(ranks), begins(ranks + 1);
  for (int owner = 0; owner < ranks; ++owner) {
    std::size_t entries = 0;
    membersOf(owner, [&](DensePair& pair) {
      forAll(pair, [&](std::span<Complex> part) { entries += part.size(); });
    });
    if (begins[owner] + entries > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      throw Error("the eigenvectors of a batch are too many for one message: solve fewer points");
    counts[owner] = entries;
    begins[owner + 1] = begins[owner] + counts[owner];
  }
  std::vector<Complex> all(begins[ranks]);
  auto next = all.begin() + begins[rank];
  membersOf(rank, [&](DensePair& pair) {
    forAll(pair, [&](std::span<Complex> part) { next = std::ranges::copy(part, next).out; });
  });
  check(MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, all.data(), counts.data(), begins.data(),
                       MPI_C_DOUBLE_COMPLEX, comm));
  auto from = all.cbegin();
  for (int owner = 0; owner < ranks; ++owner)
    membersOf(owner, [&](DensePair& pair) {
      forAll(pair, [&](std::span<Complex> part) {
        std::copy_n(from, part.size(), part.begin());
        from += part.size();
      });
    });
}

}  // namespace

std::vector<bool> correctPairs(MPI_Comm comm, const std::vector<CorrectionTask>& tasks) {
  constexpr int mostSweeps = 4;
  int rank = 0, ranks = 1;
  check(MPI_Comm_rank(comm, &rank));
  check(MPI_Comm_size(comm, &ranks));
  std::vector<Companion> companions;
  companions.reserve(tasks.size());  // groups borrow them
  std::vector<OwnedGroup> groups;
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    const auto& [problem, pairs, open] = tasks[t];
    for (auto& pair : *pairs)
      for (auto* vector : {&pair.q, &pair.left}) vector->resize(problem->order());
    companions.emplace_back(*problem, largest(*pairs));
    for (const auto& group : groupsOf(*pairs, open))
      groups.push_back({t, Group(companions.back(), *pairs, group)});
  }
  std::vector<bool> good(tasks.size(), false), ended(tasks.size(), false);
  for (int sweep = 0; sweep < mostSweeps; ++sweep) {
    std::vector<int> outcomes(groups.size(), 0);
    std::string failure;
    for (std::size_t g = rank; g < groups.size() && failure.empty(); g += ranks)
      if (!ended[groups[g].task]) try {
          // From the second sweep on, all groups go on: those near them may need better neighbours.
          const LoggedWork logged(Work::denseEigenvalues);
          outcomes[g] = static_cast<int>(groups[g].group.iterate(sweep > 0));
        } catch (const Error& error) {
          failure = error.what();
        }
    failTogether(comm, failure);
    check(MPI_Allreduce(MPI_IN_PLACE, outcomes.data(), outcomes.size(), MPI_INT, MPI_MAX, comm));
    const auto isOutcome = [&](std::size_t g, Group::Outcome outcome) {
      return outcomes[g] == static_cast<int>(outcome);
    };
    std::vector<bool> improved(groups.size()), next = ended;
    for (std::size_t t = 0; t < tasks.size(); ++t) {
      bool failed = false, unfinished = false;
      for (std::size_t g = 0; g < groups.size(); ++g)
        if (groups[g].task == t) {
          failed = failed || isOutcome(g, Group::Outcome::failed);
          unfinished = unfinished || isOutcome(g, Group::Outcome::unfinished);
        }
      for (std::size_t g = 0; g < groups.size(); ++g)
        if (groups[g].task == t && !ended[t])
          improved[g] = !failed && !isOutcome(g, Group::Outcome::untouched);
      next[t] = ended[t] || failed || !unfinished;
      if (!ended[t]) good[t] = !failed && !unfinished;
    }
    share(comm, tasks, groups, improved);
    ended = next;
    if (std::ranges::find(ended, false) == ended.end()) break;
  }
  for (std::size_t t = 0; t < tasks.size(); ++t) good[t] = good[t] && !haveMet(*tasks[t].pairs);
  return good;
}

std::optional<Complex> findMissing(const DenseProblem& problem, const std::vector<DensePair>& pairs,
                                   Complex shift, const linalg::Wanted& wanted) {
  const LoggedWork logged(Work::denseEigenvalues);
  const Companion companion(problem, largest(pairs));
  std::vector<const DensePair*> list;
  for (const auto& pair : pairs) list.push_back(&pair);
  const Deflation deflation(companion, list);
  for (const Complex s : arnoldi(companion, deflation, shift))
    if (s.imag() >= 0 && wanted(s)) return s;
  return {};
}

}  // namespace squeal::reduction
