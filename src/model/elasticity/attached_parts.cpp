// SPDX-License-Identifier: BSD-2-Clause
#include "model/elasticity/attached_parts.hpp"

#include <algorithm>

#include "base/petsc/arrays.hpp"
#include "base/system/mpi.hpp"
#include "model/elasticity/assembly.hpp"
#include "model/elasticity/carried_masses.hpp"

namespace squeal::elasticity {

using attachments::Form;

OwnedMat formMatrix(const mesh::Mesh& mesh, const std::vector<attachments::Form>& forms,
                    double attachments::Form::*factor) {
  Triples triples;
  bool any = false;
  for (const auto& form : forms) {
    if (form.*factor == 0) continue;
    any = true;
    if (mpi::rank(mesh.comm) > 0) continue;
    for (const auto& a : form.terms)
      for (const auto& b : form.terms)
        for (int i = 0; i < mesh.dimension; ++i)
          for (int j = 0; j < mesh.dimension; ++j)
            triples.add(mesh.dimension * a.node + i, mesh.dimension * b.node + j,
                        form.*factor * a.direction[i] * b.direction[j]);
  }
  if (!any) return {};
  return toMatrix(mesh, triples, SymmetryClass::symmetric);
}

std::vector<double> formValues(const mesh::Mesh& mesh, const std::vector<Form>& forms, Vec u) {
  std::vector<double> values(forms.size(), 0.0);
  {
    const ReadArray x(u);
    for (std::size_t f = 0; f < forms.size(); ++f)
      for (const auto& term : forms[f].terms)
        if (const PetscInt node = mesh.ownedNode(term.node); node >= 0)
          for (int d = 0; d < mesh.dimension; ++d)
            values[f] += term.direction[d] * x[mesh.dimension * node + d];
  }
  mpi::sumAlike(mesh.comm, values);
  return values;
}

namespace {

/// Returns the forms of each spring, bushing or mass.
std::vector<std::vector<Form>> bySubject(const std::vector<Form>& forms) {
  std::vector<std::vector<Form>> lists;
  for (const auto& form : forms) {
    if (lists.empty() || lists.back().front().kind != form.kind ||
        lists.back().front().name != form.name)
      lists.emplace_back();
    lists.back().push_back(form);
  }
  return lists;
}

/// Collective. Returns the weight of masses.
OwnedVec weightOf(const mesh::Mesh& mesh, const std::vector<Form>& masses, const Point& gravity) {
  OwnedVec weight = nodalVector(mesh);
  for (const auto& mass : masses)
    for (const auto& term : mass.terms)
      for (int d = 0; d < mesh.dimension && mesh.ownedNode(term.node) >= 0; ++d)
        check(VecSetValue(weight, mesh.dimension * term.node + d,
                          mass.mass * mesh::dot(mass.accelerated, gravity) * term.direction[d],
                          ADD_VALUES));
  check(VecAssemblyBegin(weight));
  check(VecAssemblyEnd(weight));
  return weight;
}

}  // namespace

std::vector<AttachedPart> attachedParts(const mesh::Mesh& mesh, const Bodies& bodies) {
  const auto& settings = bodies.settings;
  std::vector<AttachedPart> parts;
  for (const auto& forms : bySubject(bodies.links)) {
    const std::string head = forms.front().kind + "_" + forms.front().name;
    const auto add = [&](const std::string& what, double Form::*factor,
                         OwnedMat AttachedPart::*place) {
      OwnedMat matrix = formMatrix(mesh, forms, factor);
      if (!matrix) return;
      auto& part = parts.emplace_back();
      part.parameter = head + what;
      part.*place = std::move(matrix);
    };
    add("_stiffness", &Form::stiffness, &AttachedPart::stiffness);
    add("_damping", &Form::damping, &AttachedPart::damping);
  }
  for (const auto& forms : bySubject(attachments::massesOf(mesh, settings.attachments))) {
    AttachedPart part;
    part.parameter = "mass_" + forms.front().name;
    part.mass = formMatrix(mesh, forms, &Form::mass);
    std::vector<CarriedMass> own;
    for (const auto& one : bodies.carried)
      if (one.mass.group == forms.front().name) own.push_back(one);
    if (settings.centrifugal) {
      part.centrifugal = nodalVector(mesh);
      addCentrifugal(mesh, own, bodies.motions, part.centrifugal);
    }
    if (settings.convective) part.gyroscopic = gyroscopicOf(mesh, own, bodies.motions);
    part.weight = weightOf(mesh, forms, settings.gravity.in(mesh.dimension));
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace squeal::elasticity
