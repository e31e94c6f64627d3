#include "model/contact/contact.hpp"

#include <algorithm>
#include <optional>

#include "base/petsc/arrays.hpp"
#include "model/contact/kinematics.hpp"
#include "model/contact/loose.hpp"
#include "model/contact/sliding.hpp"
#include "model/interfaces/algebra.hpp"
#include "model/interfaces/interfaces.hpp"
#include "model/mesh/mesh.hpp"
#include "model/mesh/vector.hpp"

namespace squeal::contact {

using interfaces::assembled;
using interfaces::nodalMatrix;
using interfaces::text;
using mesh::plus;
using mesh::scaled;

namespace {

/// Returns P, which copies u of primaries to their images.
OwnedMat periodicity(const mesh::Mesh& mesh) {
  OwnedMat matrix = nodalMatrix(mesh, 1);
  std::vector<PetscInt> source;
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node) source.push_back(mesh.firstNode + node);
  for (const auto& image : mesh.images) source[image.node] = image.primary;
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    for (int d = 0; d < mesh.dimension; ++d)
      check(MatSetValue(matrix, mesh.dimension * (mesh.firstNode + node) + d,
                        mesh.dimension * source[node] + d, 1, INSERT_VALUES));
  assembled(matrix);
  return matrix;
}

/// Returns the product of a matrix of the gap basis, or of its transpose by MatMultTranspose, with
/// values, [contact node].
std::vector<double> applied(const Contact& contact, PetscErrorCode (*multiply)(Mat, Vec, Vec),
                            Mat matrix, const std::vector<double>& values) {
  const auto& mesh = *contact.mesh;
  const auto gapAt = [&](const ContactNode& node) { return mesh.dimension * (node.node + 1) - 1; };
  const OwnedVec given = elasticity::nodalVector(mesh), result = elasticity::nodalVector(mesh);
  {
    const WriteArray entries(given);
    for (std::size_t i = 0; i < values.size(); ++i) entries[gapAt(contact.nodes[i])] = values[i];
  }
  check(multiply(matrix, given, result));
  const ReadArray entries(result);
  std::vector<double> found;
  for (const auto& node : contact.nodes) found.push_back(entries[gapAt(node)]);
  return found;
}

/// Returns u_g = −A g0 of the gaps g0 without load, which the unknown gaps count.
OwnedVec gapOffset(const Contact& contact) {
  const auto& mesh = *contact.mesh;
  const OwnedVec gaps = elasticity::nodalVector(mesh);
  {
    const WriteArray values(gaps);
    for (const auto& node : contact.nodes) values[mesh.dimension * (node.node + 1) - 1] = -node.gap;
  }
  OwnedVec offset = elasticity::nodalVector(mesh);
  check(MatMult(contact.kinematics, gaps, offset));
  return offset;
}

void requireFlatObstacles(const mesh::Mesh& mesh, const Contact& contact) {
  const auto& interfaces = contact.options;
  std::string failure;
  for (int i = 0; i < std::ssize(interfaces); ++i) {
    if (!interfaces[i].onObstacle()) continue;
    Point sum{};
    double count = 0;
    for (const auto& node : contact.nodes)
      if (node.interface == i) {
        sum = plus(sum, node.normal);
        ++count;
      }
    check(MPI_Allreduce(MPI_IN_PLACE, sum.data(), 3, MPI_DOUBLE, MPI_SUM, mesh.comm));
    check(MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_DOUBLE, MPI_SUM, mesh.comm));
    for (const auto& node : contact.nodes)
      if (node.interface == i && mesh::dot(sum, node.normal) < (1 - 1e-10) * count)
        failure = "option " + interfaces[i].surfaces.pad.option +
                  ": the face on the rigid obstacle must be flat; its normal turns at " +
                  text(node.position);
  }
  failTogether(mesh.comm, failure);
}

/// Throws Error if a pad moves: w = −V holds for a resting pad on a moving disc.
void requireRestingPads(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                        const Contact& contact) {
  std::vector<int> moving(mesh.localNodes(),
                          -1);  // [local node] a moving body that it belongs to
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.body.size(); ++e)
      if (const int body = block.body[e]; bodies.motions[body].moves())
        for (PetscInt node : block.nodesOf(e)) moving[node] = body;
  std::string failure;
  for (const auto& block : mesh.faces)
    for (std::size_t e = 0; e < block.surface.size(); ++e) {
      const auto& surface = mesh.surfaces[block.surface[e]];
      if (std::none_of(contact.options.begin(), contact.options.end(), [&](const auto& i) {
            return i.role == Role::sliding && i.surfaces.pad.name == surface;
          }))
        continue;
      for (PetscInt node : block.nodesOf(e))
        if (const int body = moving[node]; body >= 0)
          failure = "body '" + mesh.bodies[body] + "' has a -motion_" + mesh.bodies[body] +
                    "_* but bears the pad surface '" + surface +
                    "'; the side that moves is the disc, -contact_<interface>_disc";
    }
  failTogether(mesh.comm, failure);
}

}  // namespace

Contact build(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
              interfaces::Interfaces ties) {
  Contact contact;
  contact.mesh = &mesh;
  contact.periodic = periodicity(mesh);
  contact.law = FrictionLaw::read();
  static_cast<interfaces::Interfaces&>(contact) =
      interfaces::findNodes(mesh, bodies, contact.periodic, std::move(ties));
  for (const auto& options : contact.options) contact.interfaces.push_back(options.surfaces.name);
  requireRestingPads(mesh, bodies, contact);
  requireFlatObstacles(mesh, contact);
  const OwnedVec held = elasticity::nodalVector(mesh);
  const OwnedMat a = buildKinematics(contact, held);
  check(
      MatMatMult(contact.periodic, a, MAT_INITIAL_MATRIX, PETSC_DEFAULT, contact.kinematics.out()));
  if (contact.gapBasis) {
    OwnedMat combined;
    check(MatMatMult(contact.kinematics, contact.gapBasis.matrix, MAT_INITIAL_MATRIX, PETSC_DEFAULT,
                     combined.out()));
    contact.kinematics = std::move(combined);
  }
  contact.offset = elasticity::nodalVector(mesh);
  check(MatMult(contact.kinematics, held, contact.offset));
  contact.gapOffset = gapOffset(contact);
  buildSliding(bodies, contact);
  rejectLooseBodies(mesh, contact, bodies.springs);
  return contact;
}

Transformation Contact::transformation(const std::vector<unsigned char>& gapFree,
                                       const std::vector<unsigned char>& released) const {
  const int dimension = mesh->dimension;
  std::vector<unsigned char> unknown = free;
  const auto gapAt = [&](const ContactNode& node) { return dimension * (node.node + 1) - 1; };
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (!gapFree[i]) unknown[gapAt(nodes[i])] = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].role == Role::sticking)
      for (PetscInt t = 1; t < dimension; ++t)
        unknown[gapAt(nodes[i]) - t] = !released.empty() && released[i];

  Transformation result;
  result.ownedColumns = std::count(unknown.begin(), unknown.end(), 1);
  PetscInt end = 0;
  check(MPI_Scan(&result.ownedColumns, &end, 1, MPIU_INT, MPI_SUM, mesh->comm));
  check(MPI_Allreduce(&result.ownedColumns, &result.columns, 1, MPIU_INT, MPI_SUM, mesh->comm));
  std::vector<PetscInt> column(unknown.size(), -1);
  PetscInt next = end - result.ownedColumns;
  for (std::size_t i = 0; i < unknown.size(); ++i)
    if (unknown[i]) {
      column[i] = next++;
      result.rows.push_back(i);
    }
  for (const auto& node : nodes) result.gapColumn.push_back(column[gapAt(node)]);

  const PetscInt owned = dimension * mesh->ownedNodes, first = dimension * mesh->firstNode;
  check(MatCreateAIJ(mesh->comm, owned, result.ownedColumns, PETSC_DETERMINE, PETSC_DETERMINE, 1,
                     nullptr, 0, nullptr, result.selection.out()));
  for (PetscInt i = 0; i < owned; ++i)
    if (column[i] >= 0)
      check(MatSetValue(result.selection, first + i, column[i], 1, INSERT_VALUES));
  assembled(result.selection);
  check(MatMatMult(kinematics, result.selection, MAT_INITIAL_MATRIX, PETSC_DEFAULT,
                   result.trial.out()));
  check(MatSetBlockSizes(result.trial, dimension,
                         1));  // so that T x is a nodal vector that knows its components

  return result;
}

PetscInt Contact::gapRow(const ContactNode& node) const {
  return mesh->dimension * (node.globalNode + 1) - 1;
}

std::vector<Slip> Contact::slip(double speed, Vec displacement) const {
  std::vector<Slip> result;
  OwnedVec carried;
  std::optional<ReadArray> values;
  if (convected && displacement) {
    carried = elasticity::nodalVector(*mesh);
    check(MatMult(convected, displacement, carried));
    values.emplace(carried);
  }
  for (const auto& node : nodes) {
    if (node.role != Role::sliding) {
      result.push_back({{}, 0, 0, 0, {}});
      continue;
    }
    Point w = scaled(node.slip, speed * node.slipSpeed);
    if (values) {
      Point change{};
      for (int d = 0; d < mesh->dimension; ++d)
        change[d] = -speed * (*values)[mesh->dimension * node.node + d];
      w = plus(w, mesh::tangential(change, node.normal));
    }
    Slip state;
    state.speed = mesh::length(w);
    if (state.speed <= 1e-9 * speed * node.slipSpeed)
      state.speed = 0;  // the direction would be that of rounding
    if (state.speed > 0) state.direction = scaled(w, 1 / state.speed);
    state.law = law.value(state.speed);
    state.slope = law.slope(state.speed);
    state.coefficient = options[node.interface].friction;
    result.push_back(state);
  }
  return result;
}

std::vector<double> Contact::nodalForce(const std::vector<double>& normalForce) const {
  return gapBasis ? applied(*this, MatMultTranspose, gapBasis.inverse, normalForce) : normalForce;
}

std::vector<double> Contact::nodalForce(std::vector<double> normalForce,
                                        const std::vector<unsigned char>& closed) const {
  for (std::size_t i = 0; i < normalForce.size(); ++i)
    if (!closed[i]) normalForce[i] = 0;
  return nodalForce(normalForce);
}

std::vector<double> Contact::gapCoefficients(const std::vector<double>& nodal) const {
  return gapBasis ? applied(*this, MatMult, gapBasis.inverse, nodal) : nodal;
}

std::vector<double> Contact::gapForce(const std::vector<double>& nodal) const {
  return gapBasis ? applied(*this, MatMultTranspose, gapBasis.matrix, nodal) : nodal;
}

std::vector<double> Contact::nodalGap(const std::vector<double>& gap) const {
  return gapBasis ? applied(*this, MatMult, gapBasis.matrix, gap) : gap;
}

std::vector<int> Contact::frictionExponents() const {
  std::vector<int> exponents;
  for (const int exponent : {0, 1})
    if (std::any_of(options.begin(), options.end(),
                    [&](const auto& one) { return one.friction.part(exponent) > 0; }))
      exponents.push_back(exponent);
  return exponents;
}

bool Contact::hasSticking() const {
  return std::any_of(options.begin(), options.end(),
                     [](const auto& one) { return one.role == Role::sticking; });
}

bool Contact::hasFriction(double swept) const {
  return std::any_of(options.begin(), options.end(),
                     [&](const auto& one) { return one.friction.at(swept) > 0; });
}

OwnedMat Contact::slipRows(const Transformation& transformation, const std::vector<Slip>& slip,
                           const std::vector<unsigned char>& slides, int exponent) const {
  std::vector<double> friction;
  for (const auto& state : slip) friction.push_back(state.coefficient.part(exponent) * state.law);
  return slipRows(transformation, slip, slides, friction);
}

OwnedMat Contact::slipRowsAt(const Transformation& transformation, const std::vector<Slip>& slip,
                             const std::vector<unsigned char>& slides, double swept) const {
  std::vector<double> friction;
  for (const auto& state : slip) friction.push_back(state.friction(swept));
  return slipRows(transformation, slip, slides, friction);
}

/// Returns the rows E⁻¹ a τ·[u] for factors a, [contact node].
OwnedMat Contact::slipRows(const Transformation& transformation, const std::vector<Slip>& slip,
                           const std::vector<unsigned char>& slides,
                           const std::vector<double>& factors) const {
  const OwnedMat directions = nodalMatrix(*mesh, 1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!slides[i] && !gapBasis) continue;
    for (int d = 0; d < mesh->dimension; ++d)
      check(MatSetValue(directions, gapRow(nodes[i]), mesh->dimension * nodes[i].globalNode + d,
                        factors[i] * slip[i].direction[d], INSERT_VALUES));
  }
  assembled(directions);
  OwnedMat rows;
  check(MatMatMult(directions, jump, MAT_INITIAL_MATRIX, PETSC_DEFAULT, rows.out()));
  if (gapBasis) {
    OwnedMat combined;
    check(MatMatMult(gapBasis.inverse, rows, MAT_INITIAL_MATRIX, PETSC_DEFAULT, combined.out()));
    const OwnedVec sliding = elasticity::nodalVector(*mesh);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      check(VecSetValue(sliding, gapRow(nodes[i]), slides[i], INSERT_VALUES));
    check(VecAssemblyBegin(sliding));
    check(VecAssemblyEnd(sliding));
    check(MatDiagonalScale(combined, sliding, nullptr));
    rows = std::move(combined);
  }
  OwnedMat result;
  check(MatMatMult(rows, transformation.trial, MAT_INITIAL_MATRIX, PETSC_DEFAULT, result.out()));
  return result;
}

ReleasedUnknowns compared(const Transformation& open, const Transformation& closed) {
  ReleasedUnknowns found;
  for (std::size_t k = 0; k < open.rows.size(); ++k) {
    const bool isShared = std::ranges::binary_search(closed.rows, open.rows[k]);
    (isShared ? found.shared : found.released).push_back(k);
  }
  return found;
}

void requireMotion(const Contact& contact) {
  std::vector<double> fastest(contact.options.size(), 0.0);  // [interface]
  for (const auto& node : contact.nodes)
    fastest[node.interface] = std::max(fastest[node.interface], node.slipSpeed);
  check(MPI_Allreduce(MPI_IN_PLACE, fastest.data(), fastest.size(), MPI_DOUBLE, MPI_MAX,
                      contact.mesh->comm));
  for (std::size_t i = 0; i < fastest.size(); ++i) {
    const auto& interface = contact.options[i];
    if (interface.role != Role::sliding || contact.reports[i].nodes == 0 || fastest[i] > 0)
      continue;
    const std::string& name = interface.surfaces.name;
    throw Error(interface.label() +
                " slides, but nothing moves along it, |w| = 0 at all its nodes; give " +
                (interface.onObstacle() ? interfaces::obstacleVelocityName(name)
                                        : "-motion_<body>_velocity or _speed of its disc") +
                ", or " + interfaces::roleName(name) +
                (interface.onObstacle() ? " frictionless" : " sticking or frictionless"));
  }
}

void requireSlip(const Contact& contact, const std::vector<Slip>& slip,
                 const std::vector<unsigned char>& active, double swept) {
  std::string failure;
  for (std::size_t i = 0; i < slip.size(); ++i)
    if (active[i] && slip[i].speed == 0 && slip[i].coefficient.at(swept) > 0 && failure.empty()) {
      const auto& node = contact.nodes[i];
      failure =
          "option -flutter_friction: friction needs a sliding velocity, but |w| = 0 at the contact "
          "node at " +
          text(node.position) + " of interface '" + contact.interfaces[node.interface] +
          "'; give -motion_<body>_velocity or _speed, or " +
          interfaces::obstacleVelocityName(contact.interfaces[node.interface]) + ", or " +
          interfaces::roleName(contact.interfaces[node.interface]) + " sticking or frictionless";
    }
  failTogether(contact.mesh->comm, failure);
}

}  // namespace squeal::contact
