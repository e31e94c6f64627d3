// SPDX-License-Identifier: BSD-2-Clause
#include "model/constraints/constraints.hpp"

#include <algorithm>
#include <cmath>

#include "base/petsc/check.hpp"
#include "base/session/stages.hpp"
#include "base/system/error.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/frame/frame.hpp"

namespace squeal::constraints {
namespace {

using frame::Frame;
using mesh::dot;

/// Throws Error unless the held components exist in the dimension and are listed once.
void requireComponents(const std::string& group, const std::string& components, int dimension) {
  const std::string allowed = std::string("xyz").substr(0, dimension),
                    head = "option " + clampedName(group) + " '" + components + "': ";
  if (components.empty() || components.find_first_not_of(allowed) != std::string::npos)
    throw Error(head + "must be some of the letters " + allowed);
  for (const char letter : components)
    if (std::count(components.begin(), components.end(), letter) > 1)
      throw Error(head + letter + " twice; must be some of the letters " + allowed + ", each once");
}

/// Collective. Warns of displacements of components that are not held.
void warnOfFreeComponents(MPI_Comm comm, const std::string& group, const std::string& components,
                          const Point& displacement) {
  for (const char letter : std::string("xyz"))
    if (displacement[letter - 'x'] != 0 && components.find(letter) == std::string::npos)
      printWarning(comm, "option " + displacementName(group) + ": the displacement of " + letter +
                             " was not used, since " + clampedName(group) + " " + components +
                             " does not hold it");
}

/// Collective. Warns of angles of rotations that are not held, and of turns that are too large for
/// linear kinematics: θ × r instead of the turned arm, in the plane (0, θ) instead of (1 − cos θ,
/// sin θ) times r.
void warnOfAngles(MPI_Comm comm, const std::string& group, const ClampSettings& clamp) {
  constexpr double small = 0.05;  // rad; the error is half of it
  Point held = clamp.angle.in(3);
  for (const char letter : std::string("xyz"))
    if (double& angle = held[letter - 'x'];
        angle != 0 && clamp.rotations.find(letter) == std::string::npos) {
      printWarning(comm, "option " + angleName(group) + ": the angle about " + letter +
                             " was not used, since " + clampedRotationName(group) + " " +
                             clamp.rotations + " does not hold it");
      angle = 0;
    }
  const double turn = mesh::length(held);
  if (turn <= small) return;
  const double error =
      std::hypot(1 - std::cos(turn), turn - std::sin(turn)) / std::abs(2 * std::sin(turn / 2));
  printWarning(comm, "warning: option " + angleName(group) +
                         formatted(": rotations are linear, so a turn of %.3g rad gives the nodes "
                                   "that follow it displacements with a relative error of %.2g",
                                   turn, error));
}

/// A direction that a group holds at a node.
struct Held {
  Point direction;
  double value;  // m, or rad
  int group;
};

/// Collects the supports of each node.
class Supports {
 public:
  Supports(const mesh::Mesh& mesh, const Settings& settings)
      : mesh_(mesh), settings_(settings), dimension_(mesh.dimension) {
    const std::size_t size = dimension_ * mesh.ownedNodes;
    found_.held.assign(size, 0), found_.heldBy.assign(size, -1);
    found_.displacement.assign(size, 0.0);
  }
  /// Holds components of the nodes of a group. `failure` is set where two groups disagree.
  void add(const std::string& group, const ClampSettings& clamp, std::string& failure);
  /// Turns the axes of nodes with supports in other directions.
  void turn(std::string& failure);
  Constraints finish() { return std::move(found_); }

 private:
  void hold(PetscInt node, int component, double value, std::string& failure);
  void addRotations(const std::string& group, const ClampSettings& clamp, const Frame& frame,
                    std::string& failure);
  void turnNode(PetscInt node, const std::vector<Held>& list, std::string& failure);
  std::string disagreement(int group) const {
    return "option " + displacementName(found_.groups[group]) +
           ": a node of this group is displaced differently by another group";
  }

  const mesh::Mesh& mesh_;
  const Settings& settings_;
  int dimension_;
  Constraints found_;
  std::map<PetscInt, std::vector<Held>> turned_;
};

void Supports::hold(PetscInt node, int component, double value, std::string& failure) {
  const PetscInt at = dimension_ * node + component;
  const int group = std::ssize(found_.groups) - 1;
  if (found_.held[at] && found_.displacement[at] != value) failure = disagreement(group);
  found_.held[at] = 1, found_.heldBy[at] = group, found_.displacement[at] = value;
}

void Supports::addRotations(const std::string& group, const ClampSettings& clamp,
                            const Frame& frame, std::string& failure) {
  const mesh::Reference& reference = *mesh_.reference(group);
  const Point angle = clamp.angle.in(3);
  if (dimension_ == 2 && clamp.rotations != "z")
    throw Error("option " + clampedRotationName(group) + " " + clamp.rotations +
                ": in plane problems must be z");
  const mesh::Matrix3 axes = frame.axesAt(reference.position);  // on all ranks, as it may throw
  const PetscInt node = mesh_.ownedNode(reference.rotation);
  if (node < 0) return;
  for (const char letter : clamp.rotations) {
    const int component = letter - 'x';
    if (dimension_ == 2)
      hold(node, 0, angle[2], failure);
    else if (frame.isGlobal())
      hold(node, component, angle[component], failure);
    else
      turned_[node].push_back(
          {axes[component], angle[component], int(std::ssize(found_.groups) - 1)});
  }
}

void Supports::add(const std::string& group, const ClampSettings& clamp, std::string& failure) {
  found_.groups.push_back(group);
  const Frame frame = frame::named(settings_.frames, clamp.frame, clampFrameName(group), mesh_);
  if (!clamp.rotations.empty()) {
    warnOfAngles(mesh_.comm, group, clamp);
    addRotations(group, clamp, frame, failure);
  }
  if (clamp.components.empty()) return;
  const auto values = clamp.displacement.in(dimension_);
  requireComponents(group, clamp.components, dimension_);
  warnOfFreeComponents(mesh_.comm, group, clamp.components, values);
  for (PetscInt node : mesh_.nodeGroups.at(group)) try {
      for (const char letter : clamp.components) {
        const int component = letter - 'x';
        if (frame.isGlobal())
          hold(node, component, values[component], failure);
        else
          turned_[node].push_back({frame.axesAt(mesh_.coordinates[node])[component],
                                   values[component], int(std::ssize(found_.groups) - 1)});
      }
    } catch (const Error& error) {
      failure = error.what();
    }
}

/// Replaces the supports of a node by supports along orthonormal axes.
void Supports::turnNode(PetscInt node, const std::vector<Held>& list, std::string& failure) {
  constexpr double dependent = 1e-6;  // sine of the angle with the span of other directions
  std::vector<Held> axes;
  for (const Held& held : list) {
    Held rest = held;
    for (const Held& axis : axes) {
      const double along = dot(held.direction, axis.direction);
      rest.direction = mesh::plus(rest.direction, axis.direction, -along);
      rest.value -= along * axis.value;
    }
    const double length = mesh::length(rest.direction);
    if (length > dependent) {
      rest.direction = mesh::scaled(rest.direction, 1 / length), rest.value /= length;
      axes.push_back(rest);
      found_.given[node].push_back({held.direction, held.group});
    } else if (std::abs(rest.value) > dependent * std::abs(held.value)) {
      failure = disagreement(held.group);
    }
  }
  const std::size_t count = axes.size();
  for (int d = 0; d < dimension_ && std::ssize(axes) < dimension_; ++d) {
    Point e = mesh::axis(d);
    for (const Held& axis : axes) e = mesh::plus(e, axis.direction, -dot(e, axis.direction));
    if (mesh::length(e) > 0.5) axes.push_back({mesh::unit(e), 0, -1});
  }
  ensure(std::ssize(axes) == dimension_, "supports of a node have orthonormal axes");
  Matrix3 matrix = mesh::identity3;
  for (int k = 0; k < dimension_; ++k) {
    const PetscInt at = dimension_ * node + k;
    matrix[k] = axes[k].direction;
    found_.held[at] = k < int(count), found_.heldBy[at] = axes[k].group;
    found_.displacement[at] = axes[k].value;
  }
  found_.axes[node] = matrix;
}

void Supports::turn(std::string& failure) {
  for (auto& [node, list] : turned_) {
    std::vector<Held> all;
    for (int d = 0; d < dimension_; ++d)
      if (const PetscInt at = dimension_ * node + d; found_.held[at]) {
        all.push_back({mesh::axis(d), found_.displacement[at], found_.heldBy[at]});
      }
    all.insert(all.end(), list.begin(), list.end());
    turnNode(node, all, failure);
  }
}

/// Holds the reference nodes of bolts across the normal, and their rotations.
void guideBolts(const mesh::Mesh& mesh, Constraints& constraints) {
  for (const auto& section : mesh.sections) {
    const auto& reference = mesh.references[section.reference];
    const PetscInt node = mesh.ownedNode(reference.displacement),
                   rotation = mesh.ownedNode(reference.rotation);
    if (node < 0) continue;
    Matrix3 axes = mesh::identity3;
    axes[0] = section.normal;
    if (mesh.dimension == 2) {
      axes[1] = {-section.normal[1], section.normal[0], 0};
    } else {
      axes[1] = mesh::across(section.normal);
      axes[2] = mesh::cross(axes[0], axes[1]);
    }
    constraints.axes[node] = axes;
    for (int d = 0; d < mesh.dimension; ++d) {
      constraints.held[mesh.dimension * node + d] = d > 0;
      constraints.held[mesh.dimension * rotation + d] = 1;
    }
  }
}

}  // namespace

Point Constraints::direction(PetscInt node, int component) const {
  if (const auto found = axes.find(node); found != axes.end()) return found->second[component];
  return mesh::axis(component);
}

bool Constraints::holds(PetscInt node, const Point& direction, int dimension) const {
  double rest = dot(direction, direction);
  for (int k = 0; k < dimension; ++k)
    if (held[dimension * node + k]) rest -= std::pow(dot(direction, this->direction(node, k)), 2);
  return rest < 1e-12 * dot(direction, direction);
}

PetscInt nodeOf(const mesh::Mesh& mesh, const EquationTerm& term) {
  if (term.rotation) return mesh.ownedNode(mesh.reference(term.group)->rotation);
  const auto& nodes = mesh.nodeGroups.at(term.group);
  return nodes.empty() ? -1 : nodes[0];
}

void lockBolt(const mesh::Mesh& mesh, int section, double opening, Constraints& constraints) {
  const auto& reference = mesh.references[mesh.sections[section].reference];
  const PetscInt node = mesh.ownedNode(reference.displacement);
  if (node < 0) return;
  const PetscInt row = mesh.dimension * node;  // the first of its axes is the normal
  constraints.held[row] = 1, constraints.heldBy[row] = -1;
  constraints.locked[row] = opening;
}

Constraints constraintsOf(const mesh::Mesh& mesh, const Settings& settings) {
  Supports supports(mesh, settings);
  std::string failure;
  for (const auto& [group, clamp] : settings.clamps) supports.add(group, clamp, failure);
  supports.turn(failure);
  failTogether(mesh.comm, failure);
  Constraints constraints = supports.finish();
  constraints.equations = settings.equations;
  guideBolts(mesh, constraints);
  for (std::size_t i = 0; i < settings.bolts.size(); ++i)
    if (settings.bolts[i].shortening)
      lockBolt(mesh, i, -*settings.bolts[i].shortening, constraints);
  constraints.anyTurned = mpi::any(mesh.comm, !constraints.axes.empty());
  if (mesh.dimension == 2)  // a reference node in the plane has one rotation
    for (const auto& reference : mesh.references)
      if (const PetscInt node = mesh.ownedNode(reference.rotation); node >= 0)
        constraints.held[2 * node + 1] = 1;
  constraints.supported = constraints.held;
  for (const auto& [node, axes] : constraints.axes)
    for (int d = 0; d < mesh.dimension; ++d) constraints.supported[mesh.dimension * node + d] = 1;
  return constraints;
}

}  // namespace squeal::constraints
