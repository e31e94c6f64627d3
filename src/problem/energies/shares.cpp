// SPDX-License-Identifier: BSD-2-Clause
#include "problem/energies/shares.hpp"

#include <algorithm>

#include "base/petsc/arrays.hpp"
#include "base/petsc/object.hpp"
#include "base/system/mpi.hpp"

namespace squeal::energies {
namespace {

/// The forms of a motion: those of the components, and those of the whole model.
struct MotionForms {
  std::vector<Forms> components;
  double prestress = 0, rotation = 0;  // uᴴ K_σ u, v² uᴴ K^R u
  double strain() const;
  double mass() const;
};

double MotionForms::strain() const {
  double sum = prestress + rotation;
  for (const auto& one : components) sum += one.stiffness;
  return sum;
}

double MotionForms::mass() const {
  double sum = 0;
  for (const auto& one : components) sum += one.mass;
  return sum;
}

/// Collective. Returns uᴴ X u of a symmetric matrix, which is real; 0 if X is null.
double form(Mat x, const linalg::ComplexVector& u) { return x ? dot(u, product(x, u)).real() : 0; }

/// Returns the components with their shares of the energies.
std::vector<pencil::Component> shares(const Components& components, const MotionForms& forms) {
  std::vector<pencil::Component> list = components.list();
  const double strain = forms.strain(), mass = forms.mass();
  for (std::size_t i = 0; i < list.size(); ++i) {
    list[i].strain = forms.components[i].stiffness / strain;
    list[i].kinetic = forms.components[i].mass / mass;
  }
  return list;
}

/// Collective. Names the motions of the bodies, the first components.
void nameMotions(const Components& components, const std::vector<const double*>& parts,
                 std::vector<pencil::Component>& list) {
  const auto names = components.motions(parts);
  for (std::size_t body = 0; body < names.size(); ++body)
    list[body].motion = names[body].name, list[body].motionShare = names[body].share;
}

/// Collective. Returns the sums of the forms of the real and the imaginary part of a motion.
std::vector<Forms> formsOf(const Components& components, const ComplexMode& mode) {
  std::vector<Forms> sums(components.list().size());
  for (const auto part : {&linalg::ComplexVector::real, &linalg::ComplexVector::imaginary}) {
    const auto& force = mode.force;
    const ReadArray u(mode.motion.u.*part), elastic(force.elastic.*part),
        inertia(force.inertia.*part);
    NodalProducts products{u, inertia, elastic};
    std::optional<ReadArray> damped;
    if (force.damped.real) products.damping = damped.emplace(force.damped.*part);
    const auto forms = components.forms(products);
    for (std::size_t i = 0; i < forms.size(); ++i) {
      sums[i].stiffness += forms[i].stiffness;
      sums[i].mass += forms[i].mass;
      sums[i].damping += forms[i].damping;
    }
  }
  return sums;
}

}  // namespace

std::vector<pencil::Component> sharesOfFreeMode(const Components& components,
                                                const NodalProducts& mode,
                                                std::optional<double> prestress) {
  const MotionForms forms{components.forms(mode), prestress.value_or(0), 0};
  auto list = shares(components, forms);
  nameMotions(components, {mode.u.data()}, list);
  if (prestress)
    list.push_back({.kind = "prestress", .name = "model", .strain = *prestress / forms.strain()});
  return list;
}

std::string nameOfMotion(const Components& components, const elasticity::Bodies& bodies,
                         const linalg::ComplexVector& u) {
  auto list = components.list();
  const ReadArray real(u.real), imaginary(u.imaginary);
  std::vector<const double*> values;
  double whole = 0;
  const auto add = [&](Vec part, const ReadArray& entries) {
    PetscReal size = 0;
    check(VecNorm(part, NORM_INFINITY, &size));
    if (size == 0) return;  // a mode without damping is real
    OwnedVec product;
    check(VecDuplicate(part, product.out()));
    check(MatMult(bodies.mass, part, product));
    const ReadArray inertia(product);
    const auto forms = components.forms({entries, inertia});
    for (std::size_t i = 0; i < list.size(); ++i)
      list[i].kinetic += forms[i].mass, whole += forms[i].mass;
    values.push_back(entries.data());
  };
  add(u.real, real);
  add(u.imaginary, imaginary);
  for (auto& one : list) one.kinetic /= whole;
  nameMotions(components, values, list);
  return pencil::modeName(list);
}

std::vector<pencil::Component> sharesOfComplexMode(const Components& components,
                                                   const elasticity::Bodies& bodies,
                                                   const contact::Contact& contact,
                                                   const ComplexMode& mode) {
  const auto& [at, s, u, prestress] = mode.motion;
  const double v = at.speed, energy = mode.force.energy;
  const MotionForms forms{formsOf(components, mode), form(prestress, u),
                          v * v * form(bodies.rotationStiffness, u)};
  auto list = shares(components, forms);
  {
    const ReadArray real(u.real), imaginary(u.imaginary);
    nameMotions(components, {real.data(), imaginary.data()}, list);
  }
  if (bodies.damping)
    for (std::size_t i = 0; i < list.size(); ++i)
      list[i].growth.damping = -std::norm(s) * at.damping * forms.components[i].damping / energy;
  std::vector<double> sums(4 * components.ofInterfaces().size(), 0.0);
  for (std::size_t k = 0; k < mode.friction.size(); ++k) {
    double* sum = &sums[4 * contact.interfaces.nodes[k].interface];
    const auto& part = mode.friction[k];
    sum[0] += part.follower, sum[1] += part.turning, sum[2] += part.slope,
        sum[3] += part.convective;
  }
  mpi::sumAlike(commOf(u.real), sums);
  for (std::size_t i = 0; i < components.ofInterfaces().size(); ++i) {
    const auto component = components.ofInterfaces()[i];
    if (!component) continue;
    auto& growth = list[*component].growth;
    growth.follower = sums[4 * i], growth.turning = sums[4 * i + 1];
    growth.slope = sums[4 * i + 2], growth.convective = sums[4 * i + 3];
  }
  if (prestress)
    list.push_back(
        {.kind = "prestress", .name = "model", .strain = forms.prestress / forms.strain()});
  if (bodies.gyroscopic) {
    pencil::Component rotation{
        .kind = "rotation", .name = "model", .strain = forms.rotation / forms.strain()};
    const double work = (std::conj(s) * s * v * dot(u, product(bodies.gyroscopic, u))).real();
    rotation.growth.gyroscopic = -work / energy;
    list.push_back(std::move(rotation));
  }
  if (mode.modalDamping != 0)
    list.push_back(
        {.kind = "modal_damping", .name = "model", .growth = {.damping = mode.modalDamping}});
  return list;
}

double modalGrowth(const pencil::Pencil& pencil, const linalg::ComplexVector& unknowns,
                   const elasticity::Bodies& bodies, const terms::Motion& motion, double energy) {
  double damping = 0;
  for (const auto& term : pencil.terms())
    if (term.power == 1 && term.dampingExponent == 1 && !term.containsFriction())
      damping += term.factor * form(term.matrix, unknowns);
  damping -= form(bodies.damping, motion.u);
  return -std::norm(motion.s) * motion.at.damping * damping / energy;
}

}  // namespace squeal::energies
