// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Springs, bushings and point masses as sums of squares of linear forms of nodal displacements.
#include <string>
#include <vector>

#include "model/attachments/settings.hpp"
#include "model/mesh/mesh.hpp"
#include "model/mesh/point_node.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::attachments {

using mesh::Point;

/// A term of a linear form: the scalar product of a vector and the components of a node.
struct FormTerm {
  PetscInt node;      ///< global node
  Point direction;    ///< in plane problems, only the first component applies to the rotation of
                      ///< a reference node
  bool isTo = false;  ///< the node is the end `to` of a spring or bushing
};

/// A linear form δ = Σ direction · u of the components of nodes. Its vector of coefficients, also
/// called δ, contributes
///   K = stiffness δδᵀ,   C = damping δδᵀ,   M = mass δδᵀ.
struct Form {
  std::string kind;      ///< "spring", "bushing" or "mass"
  std::string name;      ///< name of the spring or bushing, or group of the mass
  double stiffness = 0;  ///< N/m, or N·m/rad
  double damping = 0;    ///< N·s/m, or N·m·s/rad
  double mass = 0;       ///< kg, or kg·m²
  Point accelerated{};   ///< for a mass: derivative of δ with respect to a translation of all
                         ///< nodes; zero for rotary inertia
  std::vector<FormTerm> terms = {};
};

/// Collective. Returns the springs and bushings. A bushing acts at the midpoint of its two ends or,
/// if one end has no rotation, at that end. Rigid arms join the ends to this point, so that rigid
/// motions cost no energy. Throws Error, naming the option, for a spring whose ends coincide, for a
/// bushing whose ends are the same node, or lie apart without any rotation, for a rotational
/// stiffness at a node without rotation, and for a wrong number of components.
std::vector<Form> linksOf(const mesh::Mesh& mesh, const Settings& settings);

/// Not collective. Returns, in global axes, the symmetric matrix of Jxx, Jyy, Jzz, Jxy, Jxz, Jyz.
/// These six numbers, `j`, refer to the axes given by the rows of `axes`.
mesh::Matrix3 inertiaTensor(const std::vector<double>& j, const mesh::Matrix3& axes);

/// A mass at a node.
struct PointMass {
  std::string group;     ///< the group in the name of the option
  mesh::PointNode node;  ///< without rotation if it is a node of a group
  double mass;           ///< kg
  Point arm;             ///< from the node to the centre of mass, m
  /// About the centre of mass, in global axes, kg·m²; in plane problems only [2][2].
  mesh::Matrix3 inertia;
  bool hasInertia;
  Point centre() const { return mesh::plus(node.position, arm); }
};

/// Collective. Returns the masses, which are the same on all ranks. Throws Error for an inertia or
/// an offset of a group of nodes, and for an inertia with a wrong number of values.
std::vector<PointMass> pointMasses(const mesh::Mesh& mesh, const Settings& settings);

/// Collective. Returns the pointMasses() as forms, which are the same on all ranks. Throws Error in
/// the same cases, and for an inertia that is physically impossible.
std::vector<Form> massesOf(const mesh::Mesh& mesh, const Settings& settings);

/// A force or a moment on an owned node.
struct NodalForce {
  PetscInt node;  ///< global node
  Point value;    ///< N, or N·m; in plane problems a moment is the first component
  bool hydraulic;
};

/// Collective. Returns the forces and moments on nodes of this rank. Throws Error for a moment on a
/// group of nodes.
std::vector<NodalForce> forcesOf(const mesh::Mesh& mesh, const Settings& settings);

}  // namespace squeal::attachments
