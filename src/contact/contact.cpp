#include "contact/contact.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact/algebra.hpp"
#include "contact/interfaces.hpp"
#include "contact/kinematics.hpp"
#include "contact/loose.hpp"
#include "contact/nodes.hpp"
#include "contact/sliding.hpp"
#include "elasticity/face.hpp"
#include "elasticity/shape.hpp"
#include "mesh/mesh.hpp"
#include "options/options.hpp"
#include "petsc/arrays.hpp"
#include "petsc/text.hpp"

namespace squeal::contact {
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

void requireFlatObstacles(const mesh::Mesh& mesh, const std::vector<InterfaceOptions>& interfaces,
                          const Contact& contact) {
  std::string failure;
  for (int i = 0; i < std::ssize(interfaces); ++i) {
    if (!interfaces[i].onObstacle()) continue;
    Point sum{};
    double count = 0;
    for (const auto& node : contact.nodes)
      if (node.interface == i) {
        for (std::size_t d = 0; d < 3; ++d) sum[d] += node.normal[d];
        ++count;
      }
    check(MPI_Allreduce(MPI_IN_PLACE, sum.data(), 3, MPI_DOUBLE, MPI_SUM, mesh.comm));
    check(MPI_Allreduce(MPI_IN_PLACE, &count, 1, MPI_DOUBLE, MPI_SUM, mesh.comm));
    for (const auto& node : contact.nodes)
      if (node.interface == i && dot(sum, node.normal) < (1 - 1e-10) * count)
        failure = "option " + padName(interfaces[i].surfaces.name) +
                  ": the face on the rigid obstacle must be flat; its normal turns at " +
                  text(node.position);
  }
  failTogether(mesh.comm, failure);
}

/// Throws Error if a pad moves: w = −V holds for a resting pad on a moving disc.
void requireRestingPads(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                        const std::vector<InterfaceOptions>& interfaces) {
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
      if (std::none_of(interfaces.begin(), interfaces.end(),
                       [&](const auto& i) { return i.surfaces.pad.name == surface; }))
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

Contact build(const mesh::Mesh& mesh, const elasticity::Bodies& bodies) {
  const auto interfaces = readInterfaceOptions(mesh.dimension);
  Contact contact;
  contact.constraints = readConstraints(mesh);
  contact.mesh = &mesh;
  for (const auto& interface : interfaces) contact.interfaces.push_back(interface.surfaces.name);
  contact.periodic = periodicity(mesh);
  requireRestingPads(mesh, bodies, interfaces);
  contact.law = FrictionLaw::read();
  const auto connections = findNodes(bodies, interfaces, contact);
  requireFlatObstacles(mesh, interfaces, contact);
  const OwnedVec held = elasticity::nodalVector(mesh);
  const OwnedMat a = buildKinematics(interfaces, connections, contact, held);
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
  buildSliding(bodies, connections, contact);
  rejectLooseBodies(mesh, contact, bodies.springs);
  return contact;
}

const SlaveSide* Contact::slaveOf(const std::string& surface) const {
  const auto found = std::find_if(slaves.begin(), slaves.end(),
                                  [&](const auto& slave) { return slave.surface == surface; });
  return found == slaves.end() ? nullptr : &*found;
}

Transformation Contact::transformation(const std::vector<unsigned char>& gapFree) const {
  const int dimension = mesh->dimension;
  std::vector<unsigned char> unknown = free;
  const auto gapAt = [&](const ContactNode& node) { return dimension * (node.node + 1) - 1; };
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (!gapFree[i]) unknown[gapAt(nodes[i])] = 0;

  Transformation result;
  result.ownedColumns = std::count(unknown.begin(), unknown.end(), 1);
  PetscInt end = 0;
  check(MPI_Scan(&result.ownedColumns, &end, 1, MPIU_INT, MPI_SUM, mesh->comm));
  check(MPI_Allreduce(&result.ownedColumns, &result.columns, 1, MPIU_INT, MPI_SUM, mesh->comm));
  std::vector<PetscInt> column(unknown.size(), -1);
  PetscInt next = end - result.ownedColumns;
  for (std::size_t i = 0; i < unknown.size(); ++i)
    if (unknown[i]) column[i] = next++;
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
    Point w = scaled(node.slip, speed * node.slipSpeed);
    if (values) {
      Point change{};
      for (int d = 0; d < mesh->dimension; ++d)
        change[d] = -speed * (*values)[mesh->dimension * node.node + d];
      const double along = dot(change, node.normal);
      for (std::size_t d = 0; d < 3; ++d) w[d] += change[d] - along * node.normal[d];
    }
    Slip state;
    state.speed = std::sqrt(dot(w, w));
    if (state.speed <= 1e-9 * speed * node.slipSpeed)
      state.speed = 0;  // the direction would be that of rounding
    if (state.speed > 0) state.direction = scaled(w, 1 / state.speed);
    state.law = law.value(state.speed);
    state.slope = law.slope(state.speed);
    result.push_back(state);
  }
  return result;
}

std::vector<double> Contact::nodalForce(const std::vector<double>& normalForce) const {
  return gapBasis ? applied(*this, MatMultTranspose, gapBasis.inverse, normalForce) : normalForce;
}

std::vector<double> Contact::gapCoefficients(const std::vector<double>& nodal) const {
  return gapBasis ? applied(*this, MatMult, gapBasis.inverse, nodal) : nodal;
}

std::vector<double> Contact::nodalGap(const std::vector<double>& gap) const {
  return gapBasis ? applied(*this, MatMult, gapBasis.matrix, gap) : gap;
}

OwnedMat Contact::slipRows(const Transformation& transformation, const std::vector<Slip>& slip,
                           const std::vector<unsigned char>& slides) const {
  const OwnedMat directions = nodalMatrix(*mesh, 1);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!slides[i] && !gapBasis) continue;
    for (int d = 0; d < mesh->dimension; ++d)
      check(MatSetValue(directions, gapRow(nodes[i]), mesh->dimension * nodes[i].globalNode + d,
                        slip[i].law * slip[i].direction[d], INSERT_VALUES));
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

void requireSlip(const Contact& contact, const std::vector<Slip>& slip,
                 const std::vector<unsigned char>& active) {
  std::string failure;
  for (std::size_t i = 0; i < slip.size(); ++i)
    if (active[i] && slip[i].speed == 0 && failure.empty()) {
      const auto& node = contact.nodes[i];
      failure =
          "option -flutter_friction: friction needs a sliding velocity, but |w| = 0 at the contact "
          "node at " +
          text(node.position) + " of interface '" + contact.interfaces[node.interface] +
          "'; give -motion_<body>_velocity or _speed, or " +
          obstacleVelocityName(contact.interfaces[node.interface]);
    }
  failTogether(contact.mesh->comm, failure);
}

}  // namespace squeal::contact
