#include "linalg/quadratic.hpp"

#include <slepcsys.h>  // first: the next header needs it

#include <slepcblaslapack.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "linalg/block.hpp"
#include "linalg/lu.hpp"
#include "petsc/check.hpp"

extern "C" void dgebal_(const char* job, const PetscBLASInt* n, double* a, const PetscBLASInt* lda,
                        PetscBLASInt* low, PetscBLASInt* high, double* scale, PetscBLASInt* info);

namespace squeal::linalg {
namespace {

using Complex = std::complex<double>;

struct EigenPair {
  Complex value;
  std::vector<Complex> right, left;  // left: empty unless asked for
};

/// Returns column j of LAPACK's real storage of conjugate pairs; empty for an empty matrix.
std::vector<Complex> complexColumn(const std::vector<double>& vectors, std::size_t n, std::size_t j,
                                   bool conjugates) {
  std::vector<Complex> column(vectors.empty() ? 0 : n);
  for (std::size_t i = 0; i < column.size(); ++i)
    column[i] = {vectors[j * n + i], conjugates ? vectors[(j + 1) * n + i] : 0.0};
  return column;
}

std::vector<Complex> conjugated(std::vector<Complex> vector) {
  for (auto& entry : vector) entry = std::conj(entry);
  return vector;
}

/// Returns the wanted eigenvalues from LAPACK's real storage of conjugate pairs (n rows) as complex
/// numbers. Each number of a conjugate pair is tested, and listed if it is wanted.
std::vector<EigenPair> unpacked(std::size_t n, const std::vector<double>& real,
                                const std::vector<double>& imaginary,
                                const std::vector<double>& beta, const std::vector<double>& right,
                                const std::vector<double>& left, const Wanted& wanted) {
  std::vector<EigenPair> pairs;
  for (std::size_t j = 0; j < real.size(); ++j) {
    if (beta[j] == 0 && real[j] == 0)
      throw Error(
          "the reduced eigenproblem is singular: mass and stiffness have a common null vector");
    if (beta[j] == 0) continue;  // infinite: a motion without mass
    const Complex value = Complex(real[j], imaginary[j]) / beta[j];
    const bool conjugates = imaginary[j] != 0, first = wanted(value),
               second = conjugates && wanted(std::conj(value));
    if (first || second) {
      EigenPair pair{value, complexColumn(right, n, j, conjugates),
                     complexColumn(left, n, j, conjugates)};
      if (second)
        pairs.push_back({std::conj(value), conjugated(pair.right), conjugated(pair.left)});
      if (first) pairs.push_back(std::move(pair));
    }
    if (conjugates) ++j;
  }
  return pairs;
}

/// The arrays for the eigenvectors in a call of LAPACK, n × n each.
struct LapackVectors {
  LapackVectors(std::size_t n, Vectors wanted)
      : right(n * n), left(wanted == Vectors::both ? n * n : 0) {}
  const char* leftJob() const { return left.empty() ? "N" : "V"; }
  std::vector<double> right, left;
};

/// Returns the wanted eigenvalues, with eigenvectors, of A x = μ B x, by QZ.
std::vector<EigenPair> generalized(DenseMatrix a, DenseMatrix b, int size, Vectors sides,
                                   const Wanted& wanted) {
  const auto n = static_cast<std::size_t>(size);
  PetscBLASInt order = size, query = -1, info = 0;
  std::vector<double> real(n), imaginary(n), beta(n), work(1);
  LapackVectors vectors(n, sides);
  const auto call = [&](PetscBLASInt length) {
    LAPACKggev_(vectors.leftJob(), "V", &order, a.data(), &order, b.data(), &order, real.data(),
                imaginary.data(), beta.data(), vectors.left.data(), &order, vectors.right.data(),
                &order, work.data(), &length, &info);
  };
  call(query);
  work.resize(work[0]);
  call(static_cast<PetscBLASInt>(work.size()));
  if (info != 0)
    throw Error("LAPACK dggev failed on the reduced eigenproblem (info " + std::to_string(info) +
                ")");
  return unpacked(n, real, imaginary, beta, vectors.right, vectors.left, wanted);
}

/// Returns the wanted eigenvalues, with eigenvectors, of A x = μ x, from its Schur form. Only the
/// wanted eigenvectors are computed: computing all of them would take most of the time.
std::vector<EigenPair> standard(DenseMatrix a, int size, Vectors sides, const Wanted& wanted) {
  const auto n = static_cast<std::size_t>(size);
  PetscBLASInt order = size, query = -1, info = 0, sorted = 0, low = 0, high = 0;
  std::vector<double> real(n), imaginary(n), schur(n * n), scale(n), work(1);
  dgebal_("S", &order, a.data(), &order, &low, &high, scale.data(),
          &info);  // D⁻¹ A D: matrices of mixed units
  const auto call = [&](PetscBLASInt length) {
    LAPACKgees_("V", "N", nullptr, &order, a.data(), &order, &sorted, real.data(), imaginary.data(),
                schur.data(), &order, work.data(), &length, nullptr, &info);
  };
  call(query);
  work.resize(work[0]);
  call(static_cast<PetscBLASInt>(work.size()));
  if (info != 0)
    throw Error("LAPACK dgees failed on the reduced eigenproblem (info " + std::to_string(info) +
                ")");
  std::vector<PetscBLASInt> chosen(n, 0);
  std::vector<double> realParts, imaginaryParts;  // of the chosen eigenvalues
  for (std::size_t j = 0; j < n; ++j) {
    const std::size_t width = imaginary[j] != 0 ? 2 : 1;
    const Complex value(real[j], imaginary[j]);
    for (std::size_t k = j; k < j + width && (wanted(value) || wanted(std::conj(value))); ++k) {
      chosen[k] = 1;
      realParts.push_back(real[k]);
      imaginaryParts.push_back(imaginary[k]);
    }
    j += width - 1;
  }
  const std::size_t count = realParts.size();
  if (count == 0) return {};
  PetscBLASInt columns = static_cast<PetscBLASInt>(count), found = 0;
  std::vector<double> right(n * count), left(sides == Vectors::both ? n * count : 1);
  work.resize(3 * n);
  LAPACKtrevc_(sides == Vectors::both ? "B" : "R", "S", chosen.data(), &order, a.data(), &order,
               left.data(), &order, right.data(), &order, &columns, &found, work.data(), &info);
  if (info != 0)
    throw Error("LAPACK dtrevc failed on the reduced eigenproblem (info " + std::to_string(info) +
                ")");
  const auto turned = [&](const std::vector<double>& vectors, bool inverse) {
    std::vector<double> result(n * count);
    multiplyAdd(schur.data(), size, size, vectors, result);
    for (std::size_t k = 0; k < result.size(); ++k)
      result[k] *= inverse ? 1 / scale[k % n] : scale[k % n];
    return result;
  };
  return unpacked(n, realParts, imaginaryParts, std::vector<double>(count, 1.0),
                  turned(right, false),
                  sides == Vectors::both ? turned(left, true) : std::vector<double>(), wanted);
}

DenseMatrix sideBySide(const DenseMatrix& left, const DenseMatrix& right) {
  DenseMatrix both = left;
  both.insert(both.end(), right.begin(), right.end());
  return both;
}

/// Returns true if the inverse may be formed. With this bound, eigenvalues lose at worst half of
/// their digits, the largest ones none.
bool invertible(const Lu<double>& matrix) { return matrix.pivotRatio() > 1e-8; }

/// Replaces the left vectors u of M⁻¹ A, uᴴ M⁻¹ A = μ uᴴ, by the left vectors of (A, M),
///   y = M⁻ᵀ u.
void undoInverse(const Lu<double>& mass, std::vector<DensePair>& pairs) {
  DenseMatrix columns;
  for (const auto& pair : pairs) {
    for (const auto& entry : pair.left) columns.push_back(entry.real());
    for (const auto& entry : pair.left) columns.push_back(entry.imag());
  }
  mass.solve(columns, true);
  auto part = columns.begin();
  for (auto& pair : pairs) {
    const auto imaginary = part + static_cast<std::ptrdiff_t>(pair.left.size());
    for (std::size_t i = 0; i < pair.left.size(); ++i) pair.left[i] = {part[i], imaginary[i]};
    part = imaginary + static_cast<std::ptrdiff_t>(pair.left.size());
  }
}

/// Returns the root of s² = −μ with Im s ≥ 0.
Complex rootOf(Complex mu) {
  const Complex s =
      mu.imag() == 0 && mu.real() >= 0 ? Complex(0, std::sqrt(mu.real())) : std::sqrt(-mu);
  return s.imag() < 0 ? -s : s;
}

/// The leading matrix M of a quadratic problem, and its factors, both borrowed. M⁻¹ A is formed
/// where it can be, as QR takes a small part of the time of QZ.
struct Leading {
  const DenseMatrix& matrix;
  const Lu<double>& factors;
};

std::vector<DensePair> linearInSquare(const Leading& mass, const DenseMatrix& stiffness, int m,
                                      Vectors vectors, const Wanted& wanted) {
  //   K q = μ M q,   μ = −s²
  // Both roots ±s are eigenvalues. One of them has Im s ≥ 0, or both if they are real.
  const Wanted either = [&](Complex mu) {
    const Complex s = rootOf(mu);
    return wanted(s) || (s.imag() == 0 && wanted(-s));
  };
  DenseMatrix product = stiffness;
  if (invertible(mass.factors)) mass.factors.solve(product);
  const auto solved = invertible(mass.factors)
                          ? standard(std::move(product), m, vectors, either)
                          : generalized(stiffness, mass.matrix, m, vectors, either);
  std::vector<DensePair> pairs;
  for (const auto& [mu, q, left] : solved) {
    const Complex s = rootOf(mu);
    if (wanted(s)) pairs.push_back({s, q, left});
    if (s.imag() == 0 && wanted(-s)) pairs.push_back({-s, q, left});
  }
  if (vectors == Vectors::both && invertible(mass.factors)) undoInverse(mass.factors, pairs);
  return pairs;
}

/// Returns [I 0; 0 M].
DenseMatrix padded(const DenseMatrix& mass, std::size_t m) {
  DenseMatrix b(4 * m * m, 0.0);
  for (std::size_t j = 0; j < m; ++j) {
    b[j * 2 * m + j] = 1;
    std::copy_n(mass.begin() + j * m, m, b.begin() + ((m + j) * 2 * m + m));
  }
  return b;
}

std::vector<DensePair> companion(const Leading& mass, const DenseMatrix& damping,
                                 const DenseMatrix& stiffness, int size, Vectors vectors,
                                 const Wanted& wanted) {
  const auto m = static_cast<std::size_t>(size);
  const auto norm = [](const DenseMatrix& x) {
    return std::sqrt(std::inner_product(x.begin(), x.end(), x.begin(), 0.0));
  };
  const double unit =
      std::sqrt(norm(stiffness) / norm(mass.matrix));  // s = unit ŝ (Fan, Lin and Van Dooren 2004)
  //   [0 I; −K̂ −Ẑ] (q, ŝq) = ŝ [I 0; 0 M] (q, ŝq),   K̂ = K / unit², Ẑ = Z / unit
  DenseMatrix lower = sideBySide(stiffness, damping);
  if (invertible(mass.factors)) mass.factors.solve(lower);
  DenseMatrix a(4 * m * m, 0.0);
  for (std::size_t j = 0; j < m; ++j) {
    a[(m + j) * 2 * m + j] = 1;
    for (std::size_t i = 0; i < m; ++i) {
      a[j * 2 * m + m + i] = -lower[j * m + i] / (unit * unit);
      a[(m + j) * 2 * m + m + i] = -lower[(m + j) * m + i] / unit;
    }
  }
  std::vector<DensePair> pairs;
  const Wanted upper = [&](Complex value) { return value.imag() >= 0 && wanted(unit * value); };
  for (const auto& [value, right, left] :
       invertible(mass.factors)
           ? standard(a, 2 * size, vectors, upper)
           : generalized(a, padded(mass.matrix, m), 2 * size, vectors, upper)) {
    const auto half = right.begin() + (std::abs(value) > 1 ? size : 0);  // the larger of q and ŝq
    // The left vector of the companion form is (u, y) with u = −K̂ᵀ y / conj ŝ and yᴴ P = 0.
    pairs.push_back({unit * value,
                     {half, half + size},
                     {left.begin() + (left.empty() ? 0 : size), left.end()}});
  }
  if (vectors == Vectors::both && invertible(mass.factors)) undoInverse(mass.factors, pairs);
  return pairs;
}

/// Scales a vector to the 2-norm 1, with its largest entry real.
void normalise(std::vector<Complex>& vector) {
  double sum = 0;
  std::size_t largest = 0;
  for (std::size_t i = 0; i < vector.size(); ++i) {
    sum += std::norm(vector[i]);
    if (std::norm(vector[i]) > std::norm(vector[largest])) largest = i;
  }
  if (sum == 0) return;
  const Complex entry = vector[largest],
                factor =
                    (entry.imag() == 0 ? 1 : std::conj(entry) / std::abs(entry)) / std::sqrt(sum);
  for (auto& value : vector) value *= factor;
  vector[largest] = vector[largest].real();
}

/// Returns true if A = sign Aᵀ up to rounding: max |A_ij − sign A_ji| ≤ 1e-13 max |A_ij|.
bool hasSymmetry(const DenseMatrix& a, std::size_t m, double sign) {
  double size = 0, difference = 0;
  for (std::size_t j = 0; j < m; ++j)
    for (std::size_t i = 0; i <= j; ++i) {
      size = std::max({size, std::abs(a[j * m + i]), std::abs(a[i * m + j])});
      difference = std::max(difference, std::abs(a[j * m + i] - sign * a[i * m + j]));
    }
  return difference <= 1e-13 * size;
}

bool positiveDefinite(DenseMatrix a, int m) {
  PetscBLASInt order = m, info = 0;
  LAPACKpotrf_("L", &order, a.data(), &order, &info);
  return info == 0;
}

/// Returns true if M and K are symmetric positive definite and Z is antisymmetric. Gyroscopic
/// forces do no work, and all eigenvalues are imaginary: with q of length 1,
///   s² m + i s g + k = 0,   m = qᴴ M q > 0,   k = qᴴ K q > 0,   i g = qᴴ Z q,
/// has imaginary roots only.
bool conservative(const DenseProblem& problem) {
  const auto m = static_cast<std::size_t>(problem.m);
  return hasSymmetry(problem.stiffness, m, 1) && hasSymmetry(problem.mass, m, 1) &&
         hasSymmetry(problem.damping, m, -1) && positiveDefinite(problem.stiffness, problem.m) &&
         positiveDefinite(problem.mass, problem.m);
}

/// Returns the conjugate of s = 1/t for a root t of the reversed polynomial with Im t ≥ 0, so that
/// the imaginary part of the result is not negative either.
Complex turnedRound(Complex t) { return 1.0 / std::conj(t); }

}  // namespace

std::vector<DensePair> solveQuadratic(const DenseProblem& problem, Vectors vectors,
                                      const Wanted& wanted) {
  // Where K is the better matrix to invert, as in a basis that is orthonormal in energy, the roots
  // of the reversed polynomial are found:
  //   t² K + t Z + M,   t = 1/s
  constexpr double beyondDoubt = 0.01;
  const Lu<double> ofStiffness(problem.stiffness, problem.m);
  std::optional<Lu<double>> ofMass;
  if (ofStiffness.pivotRatio() < beyondDoubt) ofMass.emplace(problem.mass, problem.m);
  const bool reversed =
      !ofMass || (invertible(ofStiffness) && ofStiffness.pivotRatio() > ofMass->pivotRatio());
  const Leading leading =
      reversed ? Leading{problem.stiffness, ofStiffness} : Leading{problem.mass, *ofMass};
  const auto& last = reversed ? problem.mass : problem.stiffness;
  const Wanted root = [&](Complex t) {
    if (reversed && t == 0.0) return false;  // s is infinite: a motion without mass
    return !wanted || wanted(reversed ? turnedRound(t) : t);
  };
  auto pairs = problem.damping.empty()
                   ? linearInSquare(leading, last, problem.m, vectors, root)
                   : companion(leading, problem.damping, last, problem.m, vectors, root);
  for (auto& pair : pairs) {
    if (!reversed) break;
    pair = {turnedRound(pair.s), conjugated(std::move(pair.q)), conjugated(std::move(pair.left))};
  }
  // Growth rates are exactly zero here. If rounding errors stayed in them, eigenvalues that a small
  // friction makes unstable would be reported as unstable at friction 0.
  if (!problem.damping.empty() && conservative(problem))
    for (auto& pair : pairs)
      if (std::abs(pair.s.real()) <= 1e-6 * std::abs(pair.s)) pair.s = {0, pair.s.imag()};
  for (auto& pair : pairs) {
    normalise(pair.q);
    normalise(pair.left);
  }
  std::sort(pairs.begin(), pairs.end(), [](const DensePair& a, const DensePair& b) {
    return a.s.imag() != b.s.imag() ? a.s.imag() < b.s.imag() : a.s.real() < b.s.real();
  });
  return pairs;
}

std::vector<DensePair> solveQuadratic(const DenseMatrix& mass, const DenseMatrix& damping,
                                      const DenseMatrix& stiffness, int m, Vectors vectors) {
  return solveQuadratic({mass, damping, stiffness, m}, vectors);
}

std::vector<double> timesVectors(const DenseMatrix& a, int m, const std::vector<DensePair>& pairs) {
  std::vector<double> q, result(2 * pairs.size() * static_cast<std::size_t>(m), 0.0);
  if (a.empty()) return result;
  for (const auto& pair : pairs) {
    for (const auto& entry : pair.q) q.push_back(entry.real());
    for (const auto& entry : pair.q) q.push_back(entry.imag());
  }
  multiplyAdd(a.data(), m, m, q, result);
  return result;
}

void shareFrom(int root, MPI_Comm comm, std::vector<DensePair>& pairs, int m, Vectors vectors) {
  int count = static_cast<int>(pairs.size());
  check(MPI_Bcast(&count, 1, MPI_INT, root, comm));
  const auto n = static_cast<std::size_t>(m), length = 1 + n * (vectors == Vectors::both ? 2 : 1);
  std::vector<Complex> packed;
  packed.reserve(length * static_cast<std::size_t>(count));
  for (const auto& pair : pairs) {
    packed.push_back(pair.s);
    packed.insert(packed.end(), pair.q.begin(), pair.q.end());
    packed.insert(packed.end(), pair.left.begin(), pair.left.end());
  }
  packed.resize(length * static_cast<std::size_t>(count));
  check(
      MPI_Bcast(packed.data(), static_cast<int>(packed.size()), MPI_C_DOUBLE_COMPLEX, root, comm));
  pairs.clear();
  for (auto entry = packed.begin(); entry != packed.end();
       entry += static_cast<std::ptrdiff_t>(length)) {
    const auto q = entry + 1, left = q + m, end = entry + static_cast<std::ptrdiff_t>(length);
    pairs.push_back({*entry, {q, left}, {left, end}});
  }
}

std::vector<std::vector<DensePair>> solveSpread(MPI_Comm comm,
                                                const std::vector<DenseProblem>& problems,
                                                Vectors vectors, const Wanted& wanted) {
  int rank = 0, ranks = 1;
  check(MPI_Comm_rank(comm, &rank));
  check(MPI_Comm_size(comm, &ranks));
  std::vector<std::vector<DensePair>> solved(problems.size());
  std::string failure;
  for (auto i = static_cast<std::size_t>(rank); i < problems.size() && failure.empty();
       i += static_cast<std::size_t>(ranks))
    try {
      solved[i] = solveQuadratic(problems[i], vectors, wanted);
    } catch (const Error& error) {
      failure = error.what();
    }
  failTogether(comm, failure);
  for (std::size_t i = 0; i < problems.size(); ++i)
    shareFrom(static_cast<int>(i) % ranks, comm, solved[i], problems[i].m, vectors);
  return solved;
}

std::vector<DensePair> solveTogether(MPI_Comm comm, const DenseMatrix& mass,
                                     const DenseMatrix& damping, const DenseMatrix& stiffness,
                                     int m, Vectors vectors) {
  return solveSpread(comm, {{mass, damping, stiffness, m}}, vectors)[0];
}

}  // namespace squeal::linalg
