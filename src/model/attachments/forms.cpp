// SPDX-License-Identifier: BSD-2-Clause
#include "model/attachments/forms.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/linalg/symmetric.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/error.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/frame/frame.hpp"
#include "model/mesh/point_node.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::attachments {
namespace {

using mesh::cross;
using mesh::Matrix3;
using mesh::minus;
using mesh::PointNode;
using mesh::scaled;

/// Returns the components of a vector on a rotation: in the plane that about z is the first.
Point onRotation(const Point& direction, int dimension) {
  return dimension == 3 ? direction : Point{direction[2], 0, 0};
}

/// Adds factor · e·(u + θ × arm) of a node to a form.
void addTranslation(Form& form, const PointNode& node, const Point& e, const Point& arm,
                    double factor, int dimension) {
  form.terms.push_back({node.displacement, scaled(e, factor), false});
  const Point turn = cross(arm, e);
  if (node.rotation >= 0 && mesh::length(turn) > 0)
    form.terms.push_back({node.rotation, scaled(onRotation(turn, dimension), factor), false});
}

/// The components of a bushing: the first of the six axes, then the number of translations and of
/// rotations.
struct BushingAxes {
  int translations, rotations;
  int axis(int component) const {
    if (component < translations) return component;
    return translations == 2 ? 2 : component - 3;  // in the plane about z
  }
  bool turns(int component) const { return component >= translations; }
};

/// Returns the list of six (in the plane three) values, with zeros for those not given.
std::vector<double> componentsOf(std::vector<double> values, int dimension,
                                 const std::string& option) {
  const std::size_t few = dimension, all = dimension == 3 ? 6 : 3;
  if (values.size() != few && values.size() != all && values != std::vector<double>{0, 0, 0})
    throw Error(formatted("option %s: %zu components; must have %zu or %zu", option.c_str(),
                          values.size(), few, all));
  values.resize(all, 0);
  return values;
}

Form springOf(const mesh::Mesh& mesh, const SpringSettings& spring) {
  const PointNode from = mesh::pointNode(mesh, spring.from,
                                         "option " + springFromName(spring.name) + ": "),
                  to = mesh::pointNode(mesh, spring.to,
                                       "option " + springToName(spring.name) + ": ");
  const Point line = minus(to.position, from.position);
  if (!(mesh::length(line) > mesh.coincidence(to.position)))
    throw Error("option " + springToName(spring.name) + ": both ends lie at " +
                mesh::text(to.position) + ", so the spring has no direction; use " +
                bushingStiffnessName(spring.name));
  const Point n = mesh::unit(line);
  return {.kind = "spring",
          .name = spring.name,
          .stiffness = spring.stiffness,
          .damping = spring.damping,
          .terms = {{to.displacement, n, true}, {from.displacement, scaled(n, -1), false}}};
}

/// The two ends of a bushing and the point where it acts.
struct BushingEnds {
  PointNode from;
  std::optional<PointNode> to;
  Point centre;
};

BushingEnds endsOf(const mesh::Mesh& mesh, const BushingSettings& bushing) {
  BushingEnds ends{
      mesh::pointNode(mesh, bushing.from, "option " + bushingFromName(bushing.name) + ": "),
      {},
      {}};
  ends.centre = ends.from.position;
  if (bushing.to.empty()) return ends;
  ends.to = mesh::pointNode(mesh, bushing.to, "option " + bushingToName(bushing.name) + ": ");
  if (ends.to->displacement == ends.from.displacement)
    throw Error("option " + bushingToName(bushing.name) + " " + bushing.to +
                ": both ends are the same node; without this option the second end is the ground");
  const Point gap = minus(ends.to->position, ends.from.position);
  const bool fromTurns = ends.from.rotation >= 0, toTurns = ends.to->rotation >= 0;
  if (fromTurns && toTurns)
    ends.centre = mesh::plus(ends.from.position, gap, 0.5);
  else if (fromTurns)
    ends.centre = ends.to->position;
  else if (!toTurns && mesh::length(gap) > 1e-9 * (1 + mesh::length(ends.centre)))
    throw Error("option " + bushingToName(bushing.name) +
                formatted(": the ends lie %.3g m apart and have no rotation, so the bushing would "
                          "resist rigid rotations; use reference nodes, or -spring_%s_stiffness "
                          "along the line",
                          mesh::length(gap), bushing.name.c_str()));
  return ends;
}

void addBushing(const mesh::Mesh& mesh, const BushingSettings& bushing, const Settings& settings,
                std::vector<Form>& forms) {
  const int dimension = mesh.dimension;
  const BushingEnds ends = endsOf(mesh, bushing);
  const auto stiffness =
                 componentsOf(bushing.stiffness, dimension, bushingStiffnessName(bushing.name)),
             damping = componentsOf(bushing.damping, dimension, bushingDampingName(bushing.name));
  const Matrix3 axes =
      frame::named(settings.frames, bushing.frame, bushingFrameName(bushing.name), mesh)
          .axesAt(ends.centre);
  const BushingAxes layout{dimension, dimension == 3 ? 3 : 1};
  for (int k = 0; k < std::ssize(stiffness); ++k) {
    if (stiffness[k] == 0 && damping[k] == 0) continue;
    Form form{
        .kind = "bushing", .name = bushing.name, .stiffness = stiffness[k], .damping = damping[k]};
    const Point& e = axes[layout.axis(k)];
    const auto addEnd = [&](const PointNode& end, double factor) {
      if (!layout.turns(k)) {
        addTranslation(form, end, e, minus(ends.centre, end.position), factor, dimension);
        return;
      }
      if (end.rotation < 0)
        throw Error("option " + bushingStiffnessName(bushing.name) +
                    ": stiffness about an axis needs reference nodes at both ends; the other "
                    "nodes have no rotation");
      form.terms.push_back({end.rotation, scaled(onRotation(e, dimension), factor), false});
    };
    addEnd(ends.from, -1);
    const std::size_t ofFrom = form.terms.size();
    if (ends.to) addEnd(*ends.to, 1);
    for (std::size_t i = ofFrom; i < form.terms.size(); ++i) form.terms[i].isTo = true;
    forms.push_back(std::move(form));
  }
}

/// Throws Error unless the moments of inertia are those of a mass: each is at most the sum of the
/// other two.
void requireInertia(const std::vector<double>& moments, const std::string& group) {
  const double slack = 1e-9 * moments.back();
  if (moments.front() < -slack || moments.back() > moments[0] + moments[1] + slack)
    throw Error(
        formatted("option %s: the principal moments of inertia are %g, %g and %g kg m2; "
                  "none may be negative or exceed the sum of the others",
                  inertiaName(group).c_str(), moments[0], moments[1], moments[2]));
}

/// Returns the rotary inertia of the mass of a reference node in global axes; in the plane Jzz.
Matrix3 inertiaOf(const mesh::Mesh& mesh, const MassSettings& mass, const Matrix3& axes) {
  if (!mass.hasInertia) return {};
  if (mesh.dimension == 2) {
    const double j = mass.inertia.size() == 6 ? mass.inertia[2] : mass.inertia[0];
    if (mass.inertia.size() != 6 && mass.inertia.size() != 1)
      throw Error("option " + inertiaName(mass.group) +
                  ": in plane problems must be one number, Jzz");
    if (j < 0) throw Error("option " + inertiaName(mass.group) + ": Jzz must not be negative");
    Matrix3 inertia{};
    inertia[2][2] = j;
    return inertia;
  }
  if (mass.inertia.size() != 6)
    throw Error(formatted("option %s: %zu numbers; must be six, Jxx,Jyy,Jzz,Jxy,Jxz,Jyz",
                          inertiaName(mass.group).c_str(), mass.inertia.size()));
  return inertiaTensor(mass.inertia, axes);
}

/// Adds the rotary inertia of a mass.
void addInertia(const PointMass& mass, int dimension, std::vector<Form>& forms) {
  if (dimension == 2) {
    if (const double j = mass.inertia[2][2]; j > 0)
      forms.push_back({.kind = "mass",
                       .name = mass.group,
                       .mass = j,
                       .terms = {{mass.node.rotation, {1, 0, 0}, false}}});
    return;
  }
  linalg::DenseMatrix tensor(3, 3);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) tensor(a, b) = mass.inertia[a][b];
  const auto moments = linalg::symmetricEigen(tensor);
  requireInertia(moments, mass.group);
  for (int k = 0; k < 3; ++k)
    if (moments[k] > 0)
      forms.push_back(
          {.kind = "mass",
           .name = mass.group,
           .mass = moments[k],
           .terms = {{mass.node.rotation, {tensor(0, k), tensor(1, k), tensor(2, k)}, false}}});
}

/// Adds the masses of a group or a reference node.
void addMasses(const mesh::Mesh& mesh, const MassSettings& given, const Settings& settings,
               std::vector<PointMass>& masses) {
  if (mesh.reference(given.group)) {
    const PointNode node = mesh::pointNode(mesh, given.group, "");
    const Matrix3 axes =
        frame::named(settings.frames, given.frame, massFrameName(given.group), mesh)
            .axesAt(node.position);
    const Point local = given.offset.in(mesh.dimension);
    masses.push_back({given.group, node, given.total, mesh::along(axes, local),
                      inertiaOf(mesh, given, axes), given.hasInertia});
    return;
  }
  if (given.hasInertia || given.hasOffset)
    throw Error("option " + (given.hasInertia ? inertiaName : massOffsetName)(given.group) + ": '" +
                given.group +
                "' is not a reference node; only these have a rotation. Make one with -reference_" +
                given.group + "_position");
  std::vector<PointNode> own;
  for (PetscInt node : mesh.nodeGroups.at(given.group))
    own.push_back({mesh.firstNode + node, -1, mesh.coordinates[node]});
  const auto all = concatenated(mesh.comm, own);
  for (const auto& node : all)
    masses.push_back({given.group, node, given.total / all.size(), {}, {}, false});
}

/// Adds the moment on the reference node of a group.
void addMoment(const mesh::Mesh& mesh, const ForceSettings& given, const frame::Frame& frame,
               std::vector<NodalForce>& forces) {
  const mesh::Reference* reference = mesh.reference(given.group);
  if (!reference)
    throw Error("option " + momentName(given.group) + ": '" + given.group +
                "' is not a reference node; only these have a rotation. Make one with -reference_" +
                given.group + "_position");
  const Point local = given.moment.in(3);
  if (mesh.dimension == 2 && (local[0] != 0 || local[1] != 0))
    throw Error("option " + momentName(given.group) + ": in plane problems must be 0,0,Mz");
  const Matrix3 axes = frame.axesAt(reference->position);  // on all ranks, as it may throw
  if (mesh.ownedNode(reference->rotation) < 0) return;
  const Point moment = mesh::along(axes, local);
  forces.push_back({reference->rotation, onRotation(moment, mesh.dimension), given.hydraulic});
}

}  // namespace

Matrix3 inertiaTensor(const std::vector<double>& j, const Matrix3& axes) {
  const Matrix3 local{{{j[0], j[3], j[4]}, {j[3], j[1], j[5]}, {j[4], j[5], j[2]}}};
  Matrix3 tensor{};
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l) tensor[a][b] += axes[k][a] * local[k][l] * axes[l][b];
  return tensor;
}

std::vector<Form> linksOf(const mesh::Mesh& mesh, const Settings& settings) {
  std::vector<Form> forms;
  for (const auto& spring : settings.springs) forms.push_back(springOf(mesh, spring));
  for (const auto& bushing : settings.bushings) addBushing(mesh, bushing, settings, forms);
  return forms;
}

std::vector<PointMass> pointMasses(const mesh::Mesh& mesh, const Settings& settings) {
  std::vector<PointMass> masses;
  for (const auto& given : settings.masses) addMasses(mesh, given, settings, masses);
  return masses;
}

std::vector<Form> massesOf(const mesh::Mesh& mesh, const Settings& settings) {
  std::vector<Form> forms;
  for (const auto& mass : pointMasses(mesh, settings)) {
    for (int d = 0; d < mesh.dimension; ++d) {
      const Point e = mesh::axis(d);
      Form form{.kind = "mass", .name = mass.group, .mass = mass.mass, .accelerated = e};
      addTranslation(form, mass.node, e, mass.arm, 1, mesh.dimension);
      forms.push_back(std::move(form));
    }
    if (mass.hasInertia) addInertia(mass, mesh.dimension, forms);
  }
  return forms;
}

std::vector<NodalForce> forcesOf(const mesh::Mesh& mesh, const Settings& settings) {
  std::vector<NodalForce> forces;
  std::string failure;
  for (const auto& given : settings.forces) {
    const auto frame =
        frame::named(settings.frames, given.frame, forceFrameName(given.group), mesh);
    if (given.hasMoment) addMoment(mesh, given, frame, forces);
    const Point local = given.force.in(mesh.dimension);
    const auto& nodes = mesh.nodeGroups.at(given.group);
    const PetscInt count = mpi::sum(mesh.comm, PetscInt(nodes.size()));
    for (const PetscInt node : nodes) try {
        const Matrix3 axes = frame.axesAt(mesh.coordinates[node]);
        const Point force = mesh::along(axes, mesh::scaled(local, 1.0 / count));
        forces.push_back({mesh.firstNode + node, force, given.hydraulic});
      } catch (const Error& error) {
        failure = error.what();
      }
  }
  failTogether(mesh.comm, failure);
  return forces;
}

}  // namespace squeal::attachments
