// SPDX-License-Identifier: BSD-2-Clause
#include "eigen/pencil/pencil.hpp"
#include "base/petsc/object.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

namespace squeal::pencil {

double Term::coefficient(const sweep::Parameters& at) const {
  return factor * std::pow(at.friction, frictionExponent) * std::pow(at.speed, speedExponent) *
         std::pow(at.damping, dampingExponent);
}

double Term::slope(const sweep::Parameters& at, double sweep::Parameters::*parameter) const {
  const int exponent = parameter == &sweep::Parameters::friction  ? frictionExponent
                       : parameter == &sweep::Parameters::speed   ? speedExponent
                       : parameter == &sweep::Parameters::damping ? dampingExponent
                                                                  : 0;
  if (exponent == 0) return 0;
  sweep::Parameters unit = at;
  unit.*parameter = 1;  // the other powers remain
  return exponent * coefficient(unit) * std::pow(at.*parameter, exponent - 1);
}

Term Term::share() const {
  return {matrix.share(), power,           frictionExponent, factor,
          speedExponent,  dampingExponent, ofFriction};
}

namespace {

/// Collective. Returns true for a term in s whose matrix is zero. The matrices, not the options,
/// decide whether a pencil has terms in s.
bool vanishes(const Term& term) {
  if (term.power != 1) return false;
  PetscBool known = PETSC_FALSE;
  check(MatHasOperation(term.matrix, MATOP_NORM, &known));
  if (!known) return false;
  PetscReal norm = 0;
  check(MatNorm(term.matrix, NORM_FROBENIUS, &norm));
  return norm == 0;
}

std::vector<Term> withoutZeros(std::vector<Term> terms) {
  std::erase_if(terms, vanishes);
  return terms;
}

/// Collective. Adds a term, multiplied by its coefficient, to a sum; null: starts the sum.
void addTo(OwnedMat& sum, const Term& term, const sweep::Parameters& at) {
  if (!sum) {
    check(MatDuplicate(term.matrix, MAT_COPY_VALUES, sum.out()));
    check(MatScale(sum, term.coefficient(at)));
  } else {
    check(MatAXPY(sum, term.coefficient(at), term.matrix, DIFFERENT_NONZERO_PATTERN));
  }
  check(MatSetOption(sum, MAT_SYMMETRIC, PETSC_FALSE));
}

}  // namespace

Pencil::Pencil(std::vector<Term> terms)
    : terms_(withoutZeros(std::move(terms))),
      affineCount_(terms_.size()),
      singular_(std::make_shared<std::array<OwnedVec, 3>>()) {}

void Pencil::add(std::vector<Term> terms) {
  std::ranges::move(withoutZeros(std::move(terms)), std::back_inserter(terms_));
  affineCount_ = terms_.size();
}

/// Returns a pencil with the terms for which `included` returns true, whose matrices it shares.
Pencil Pencil::part(const std::function<bool(std::size_t)>& included) const {
  Pencil pencil({});
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    if (!included(i)) continue;
    pencil.terms_.push_back(terms_[i].share());
    if (i < affineCount_) ++pencil.affineCount_;
  }
  pencil.singular_ = singular_;
  return pencil;
}

Pencil Pencil::with(std::vector<Term> pointTerms) const {
  Pencil pencil = part([](std::size_t) { return true; });
  std::ranges::move(withoutZeros(std::move(pointTerms)), std::back_inserter(pencil.terms_));
  return pencil;
}

Pencil Pencil::associated() const {
  return part([&](std::size_t i) { return i < affineCount_ && terms_[i].isAssociated(); });
}

std::vector<Term> Pencil::pointSums(const sweep::Parameters& at) const {
  std::vector<std::vector<const Term*>> groups;
  for (const Term& term : std::span(terms_).subspan(affineCount_)) {
    const auto same = std::ranges::find_if(groups, [&](const auto& group) {
      return group.front()->power == term.power &&
             group.front()->isAssociated() == term.isAssociated();
    });
    (same == groups.end() ? groups.emplace_back() : *same).push_back(&term);
  }
  std::vector<Term> sums;
  for (const auto& group : groups) {
    const Term& first = *group.front();
    if (group.size() == 1) {
      sums.push_back(first.share());
      continue;
    }
    OwnedMat sum;
    for (const Term* term : group) addTo(sum, *term, at);
    sums.push_back(
        {.matrix = std::move(sum), .power = first.power, .ofFriction = !first.isAssociated()});
  }
  return sums;
}

bool Pencil::hasPower(int power) const {
  return std::any_of(terms_.begin(), terms_.end(),
                     [&](const Term& term) { return term.power == power; });
}

MPI_Comm Pencil::comm() const { return commOf(terms_.at(0).matrix.get()); }

OwnedMat Pencil::assembled(int power, const sweep::Parameters& at) const {
  OwnedMat sum;
  for (const auto& term : terms_)
    if (term.power == power) addTo(sum, term, at);
  return sum;
}

void Pencil::apply(int power, const sweep::Parameters& at, Vec x, Vec y) const {
  check(VecZeroEntries(y));
  OwnedVec part;
  check(VecDuplicate(y, part.out()));
  for (const auto& term : terms_)
    if (const double c = term.coefficient(at); term.power == power && c != 0) {
      check(MatMult(term.matrix, x, part));
      check(VecAXPY(y, c, part));
    }
}

void Pencil::applyTranspose(int power, const sweep::Parameters& at, Vec x, Vec y) const {
  check(VecZeroEntries(y));
  OwnedVec part;
  check(VecDuplicate(y, part.out()));
  for (const auto& term : terms_)
    if (const double c = term.coefficient(at); term.power == power && c != 0) {
      check(MatMultTranspose(term.matrix, x, part));
      check(VecAXPY(y, c, part));
    }
}

double Pencil::norm(int power, const sweep::Parameters& at) const {
  if (!hasPower(power)) return 0;
  OwnedVec& v = (*singular_)[power];
  const bool fresh = !v;
  OwnedVec product;
  check(MatCreateVecs(terms_[0].matrix, product.out(), nullptr));
  if (fresh) {
    // The largest eigenvalues belong to rough vectors; a fixed pseudo-random start contains them.
    PetscInt first = 0, end = 0;
    check(VecDuplicate(product, v.out()));
    check(VecGetOwnershipRange(v, &first, &end));
    for (PetscInt i = first; i < end; ++i)
      check(VecSetValue(v, i, std::sin(12.9898 * (i + 1)), INSERT_VALUES));
    check(VecAssemblyBegin(v));
    check(VecAssemblyEnd(v));
  }
  double estimate = 0;
  for (int sweep = 0; sweep < (fresh ? 20 : 1); ++sweep) {
    PetscReal size = 0;
    check(VecNormalize(v, nullptr));
    apply(power, at, v, product);
    check(VecNorm(product, NORM_2, &size));
    estimate = std::max<double>(estimate, size);
    if (size == 0) {  // the terms vanish at this friction; the next call starts from scratch
      v = OwnedVec();
      return 0;
    }
    applyTranspose(power, at, product, v);
  }
  return estimate;
}

linalg::ComplexVector residual(const Pencil& pencil, const sweep::Parameters& at, Complex s,
                               const linalg::ComplexVector& d, Side side) {
  linalg::ComplexVector sum = linalg::ComplexVector::like(d.real),
                        part = linalg::ComplexVector::like(d.real);
  for (int power = 0; power <= 2; ++power) {
    if (!pencil.hasPower(power)) continue;
    for (const bool imaginary : {false, true}) {
      const Vec from = imaginary ? d.imaginary : d.real,
                to = imaginary ? part.imaginary : part.real;
      side == Side::left ? pencil.applyTranspose(power, at, from, to)
                         : pencil.apply(power, at, from, to);
    }
    add(sum, std::pow(side == Side::left ? std::conj(s) : s, power), part);
  }
  return sum;
}

double backwardError(const Pencil& pencil, const sweep::Parameters& at, Complex s,
                     const linalg::ComplexVector& d) {
  double scale = 0;
  for (int power = 0; power <= 2; ++power)
    scale += std::pow(std::abs(s), power) * pencil.norm(power, at);
  return length(residual(pencil, at, s, d, Side::right)) / (scale * length(d));
}

}  // namespace squeal::pencil
