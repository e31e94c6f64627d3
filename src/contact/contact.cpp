#include "contact/contact.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "contact/algebra.hpp"
#include "contact/kinematics.hpp"
#include "contact/loose.hpp"
#include "contact/sliding.hpp"
#include "elasticity/face.hpp"
#include "elasticity/shape.hpp"
#include "mesh/mesh.hpp"
#include "options/options.hpp"
#include "petsc/arrays.hpp"
#include "petsc/text.hpp"

namespace squeal::contact {
namespace {

const TextOption padOption("contact", "contact_<interface>_pad", "",
                           "surface group of the pad side (slave) of an interface");
const TextOption discOption("contact", "contact_<interface>_disc", "",
                            "surface group of the disc side (master), meshed alike");
const RealListOption obstacleVelocityOption("contact", "contact_<interface>_obstacle_velocity",
                                            "0,0,0", "m/s", anyReal,
                                            "instead of a disc: a rigid flat obstacle in the plane "
                                            "of the pad face, sliding at this velocity");
const RealListOption obstacleDisplacementOption(
    "contact", "contact_<interface>_obstacle_displacement", "0,0,0", "m", anyReal,
    "displacement of the rigid obstacle, which presses the pad");

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

/// A FaceSums holds the sums over the pad faces at each node: area-weighted normals (towards the
/// pad) and ∫ φ̃ dA. The sums of images are added to those of their primaries.
struct FaceSums {
  OwnedVec normal, area;  // nodal vectors; the area stands in the component of the gap
};

FaceSums sumFaces(const mesh::Mesh& mesh, const Contact& contact) {
  FaceSums local{elasticity::nodalVector(mesh), elasticity::nodalVector(mesh)},
      sums{elasticity::nodalVector(mesh), elasticity::nodalVector(mesh)};
  for (const auto& block : mesh.faces) {
    const auto& table = elasticity::shapeTable(block.type);
    for (std::size_t e = 0; e < block.surface.size(); ++e) {
      if (!contact.isPadSurface(mesh.surfaces[block.surface[e]])) continue;
      std::vector<Point> points;
      const auto nodes = block.nodesOf(e);
      for (PetscInt node : nodes) points.push_back(mesh.coordinates[node]);
      const auto faceMass = elasticity::faceMass(table, points);
      const auto normals = elasticity::nodeNormals(table, points, -block.sign[e]);
      double faceArea = 0;
      for (double entry : faceMass) faceArea += entry;
      for (int i = 0; i < block.nodesPerFace; ++i) {
        const PetscInt row = mesh.dimension * mesh.globalNode[nodes[i]];
        double weight = 0;
        for (int j = 0; j < block.nodesPerFace; ++j) weight += faceMass[i * block.nodesPerFace + j];
        check(VecSetValue(local.area, row + mesh.dimension - 1, weight, ADD_VALUES));
        for (int d = 0; d < mesh.dimension; ++d)
          check(VecSetValue(local.normal, row + d, faceArea * normals[i][d], ADD_VALUES));
      }
    }
  }
  for (Vec vector : {local.normal.get(), local.area.get()})
    check(VecAssemblyBegin(vector)), check(VecAssemblyEnd(vector));
  check(MatMultTranspose(contact.periodic, local.normal, sums.normal));
  check(MatMultTranspose(contact.periodic, local.area, sums.area));
  if (contact.gapBasis) {
    //   ∫ φ̃ dA = Eᵀ ∫ φ dA
    check(MatMultTranspose(contact.gapBasis.matrix, sums.area, local.area));
    check(VecCopy(local.area, sums.area));
  }
  return sums;
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

std::vector<ContactNode> contactNodes(const mesh::Mesh& mesh, const elasticity::Bodies& bodies,
                                      const std::vector<mesh::InterfaceRequest>& requests,
                                      const FaceSums& sums) {
  std::vector<ContactNode> nodes;
  std::vector<Point> obstacleVelocity;
  for (const auto& request : requests)
    obstacleVelocity.push_back(obstacleVelocityOption.components(request.name, mesh.dimension));
  const auto discVelocity = [&](const mesh::ContactPair& pair) {
    return pair.masterBody >= 0
               ? bodies.motions[pair.masterBody].velocity(mesh.coordinates[pair.node])
               : obstacleVelocity[pair.interface];
  };
  double fastest = 0;
  for (const auto& pair : mesh.pairs)
    fastest = std::max(fastest, std::sqrt(dot(discVelocity(pair), discVelocity(pair))));
  check(MPI_Allreduce(MPI_IN_PLACE, &fastest, 1, MPI_DOUBLE, MPI_MAX, mesh.comm));
  const ReadArray normal(sums.normal), area(sums.area);
  for (const auto& pair : mesh.pairs) {
    ContactNode node{};
    node.position = mesh.coordinates[pair.node];
    node.node = pair.node, node.globalNode = mesh.firstNode + pair.node, node.master = pair.master,
    node.interface = pair.interface;
    node.area = area[mesh.dimension * (pair.node + 1) - 1];
    for (int d = 0; d < mesh.dimension; ++d)
      node.normal[d] = normal[mesh.dimension * pair.node + d];
    node.normal = scaled(node.normal, 1 / std::sqrt(dot(node.normal, node.normal)));
    const Point velocity = discVelocity(pair);
    //   w = −V in the tangent plane   [2.15]
    const double along = dot(velocity, node.normal);
    Point w{};
    for (std::size_t d = 0; d < 3; ++d) w[d] = -(velocity[d] - along * node.normal[d]);
    node.slipSpeed = std::sqrt(dot(w, w));
    // On the axis of a rotation, and where the velocity is normal to the contact, w is only
    // rounding; gmsh places nodes to 1e-11.
    if (node.slipSpeed > 1e-9 * fastest)
      node.slip = scaled(w, 1 / node.slipSpeed);
    else
      node.slipSpeed = 0;
    nodes.push_back(node);
  }
  return nodes;
}

void requireFlatObstacles(const mesh::Mesh& mesh, const Contact& contact) {
  std::string failure;
  for (int i = 0; i < std::ssize(contact.interfaces); ++i) {
    double sums[4] = {0, 0, 0, 0};
    for (const auto& node : contact.nodes)
      if (node.interface == i && node.master < 0) {
        for (std::size_t d = 0; d < 3; ++d) sums[d] += node.normal[d];
        sums[3] += 1;
      }
    check(MPI_Allreduce(MPI_IN_PLACE, sums, 4, MPI_DOUBLE, MPI_SUM, mesh.comm));
    for (const auto& node : contact.nodes)
      if (node.interface == i && node.master < 0 &&
          sums[0] * node.normal[0] + sums[1] * node.normal[1] + sums[2] * node.normal[2] <
              (1 - 1e-10) * sums[3])
        failure = "option -" + padOption.fullName(contact.interfaces[i]) +
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
      if (!contact.isPadSurface(surface)) continue;
      for (PetscInt node : block.nodesOf(e))
        if (const int body = moving[node]; body >= 0)
          failure = "body '" + mesh.bodies[body] + "' has a -motion_" + mesh.bodies[body] +
                    "_* but bears the pad surface '" + surface +
                    "'; the side that moves is the disc, -contact_<interface>_disc";
    }
  failTogether(mesh.comm, failure);
}

/// Throws Error for an interface whose sides are not meshed alike.
void requireMatching(const mesh::Mesh& mesh, const std::vector<mesh::InterfaceRequest>& requests) {
  for (std::size_t i = 0; i < requests.size(); ++i)
    if (!mesh.matching[i])
      throw Error("options " + requests[i].pad.option + ", " + requests[i].disc.option + ": " +
                  mesh.mismatch[i] + " (contact needs matching meshes)");
}

}  // namespace

std::vector<mesh::InterfaceRequest> readInterfaces() {
  std::vector<mesh::InterfaceRequest> requests;
  for (const Option* option : std::vector<const Option*>{&discOption, &obstacleVelocityOption,
                                                         &obstacleDisplacementOption})
    for (const auto& name : option->subjects())
      if (!padOption.given(name))
        throw Error("option -" + option->fullName(name) + " needs -" + padOption.fullName(name));
  for (const auto& name : padOption.subjects()) {
    const bool disc = discOption.given(name), obstacle = obstacleVelocityOption.given(name) ||
                                                         obstacleDisplacementOption.given(name);
    if (disc == obstacle)
      throw Error("option -" + padOption.fullName(name) + ": give either -" +
                  discOption.fullName(name) + " or -" + obstacleVelocityOption.fullName(name));
    const auto groupOf = [&](const TextOption& option) {
      const std::string group = option.get(name);
      return mesh::GroupRequest{group, "-" + option.fullName(name) + " " + group};
    };
    requests.push_back(
        {name, groupOf(padOption), disc ? groupOf(discOption) : mesh::GroupRequest{}});
  }
  return requests;
}

Contact build(const mesh::Mesh& mesh, const elasticity::Bodies& bodies) {
  const auto requests = readInterfaces();
  requireMatching(mesh, requests);
  Contact contact;
  contact.constraints = readConstraints(mesh);
  contact.mesh = &mesh;
  for (const auto& request : requests)
    contact.interfaces.push_back(request.name), contact.padSurfaces.push_back(request.pad.name);
  contact.periodic = periodicity(mesh);
  requireRestingPads(mesh, bodies, contact);
  contact.law = FrictionLaw::read();
  contact.gapBasis = gapBasis(mesh, contact.padSurfaces, contact.periodic);
  contact.nodes = contactNodes(mesh, bodies, requests, sumFaces(mesh, contact));
  contact.totalNodes = contact.nodes.size();
  check(MPI_Allreduce(MPI_IN_PLACE, &contact.totalNodes, 1, MPIU_INT, MPI_SUM, mesh.comm));

  OwnedMat a = nodalMatrix(mesh, 2);
  const OwnedVec held = elasticity::nodalVector(mesh);
  std::vector<Point> obstacleDisplacement;
  for (const auto& request : requests)
    obstacleDisplacement.push_back(
        obstacleDisplacementOption.components(request.name, mesh.dimension));
  buildKinematics(obstacleDisplacement, contact, a, held);
  requireFlatObstacles(mesh, contact);
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
  buildSliding(bodies, contact);
  rejectLooseBodies(mesh, contact, bodies.springs);
  return contact;
}

bool Contact::isPadSurface(const std::string& surface) const {
  return std::find(padSurfaces.begin(), padSurfaces.end(), surface) != padSurfaces.end();
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
  OwnedMat rows = nodalMatrix(*mesh, 2);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!slides[i] && !gapBasis) continue;
    for (int d = 0; d < mesh->dimension; ++d) {
      const double entry = slip[i].law * slip[i].direction[d];
      check(MatSetValue(rows, gapRow(nodes[i]), mesh->dimension * nodes[i].globalNode + d, entry,
                        INSERT_VALUES));
      if (nodes[i].master >= 0)
        check(MatSetValue(rows, gapRow(nodes[i]), mesh->dimension * nodes[i].master + d, -entry,
                          INSERT_VALUES));
    }
  }
  assembled(rows);
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
          "'; give -motion_<body>_velocity or _speed, or -" +
          obstacleVelocityOption.fullName(contact.interfaces[node.interface]);
    }
  failTogether(contact.mesh->comm, failure);
}

}  // namespace squeal::contact
