// SPDX-License-Identifier: BSD-2-Clause
#include "model/contact/loose.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "algebra/linalg/symmetric.hpp"
#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "model/mesh/mesh.hpp"

namespace squeal::contact {
namespace {

// A small dense problem with six unknowns per connected part of the mesh gives the rigid-body
// modes.

/// Collective. Returns the Gram matrix Σ cᵀc over the rows c of all supports, applied to rigid
/// motions. The null space contains the rigid-body modes.
linalg::DenseMatrix gramOf(const mesh::Mesh& mesh, const Contact& contact,
                           const elasticity::Bodies& bodies, const RigidMotions& motions,
                           const SupportingContact& holding) {
  GramMatrix gram(motions.size());
  forEachSupport(mesh, contact, bodies.springs, holding, [&](const Support& support) {
    motions.addNode(mesh, support.node, support.direction, 1, gram.row);
    for (const auto& [part, share] : support.masterParts)
      motions.add(gram.row, part, support.masterPosition, support.direction, -share);
    for (const auto& master : support.coupled)
      motions.addMaster(master, support.component, gram.row);
    gram.keep();
  });
  addEquations(mesh, contact, bodies, motions, gram);
  mpi::reduce<double>(mesh.comm, {gram.sum.data(), std::size_t(gram.sum.size())}, MPI_SUM);
  return std::move(gram.sum);
}

/// Returns true if an eigenvalue of the Gram matrix belongs to a rigid-body mode.
bool isFree(double eigenvalue, double largest) {
  // A support that extends over a thousandth of the model still restrains a rotation, with 1e-6 of
  // its weight for a translation.
  return eigenvalue <= 1e-12 * std::max(largest, 1.0);
}

/// Returns the bolts whose sections open in column k of the rigid motions g.
std::vector<std::string> openingBolts(const mesh::Mesh& mesh, const linalg::DenseMatrix& g,
                                      const RigidMotions& motions, int k) {
  std::vector<std::string> bolts;
  for (const auto& section : mesh.sections) {
    const int first = mesh.references[section.reference].part * motions.perPart();
    double opening = 0;
    for (int d = 0; d < mesh.dimension; ++d) opening += section.normal[d] * g(first + d, k);
    if (std::abs(opening) > 1e-6) bolts.push_back("'" + section.name + "'");
  }
  return bolts;
}

/// Returns what the bolts of a rigid-body mode do, for messages; empty without bolts.
std::string boltText(const RigidBodyMode& mode) {
  if (mode.bolts.empty()) return "";
  if (mode.bolts.size() == 1)
    return " as the section of bolt " + mode.bolts[0] +
           " opens, so the part of the body on one side of it is loose";
  return " as the sections of bolts " + joined(mode.bolts, " and ") +
         " open, so the parts between or beyond them are loose";
}

}  // namespace

std::vector<unsigned char> looseParts(const mesh::Mesh& mesh, const Contact& contact,
                                      const elasticity::Bodies& bodies,
                                      const SupportingContact& holding) {
  const RigidMotions motions = rigidMotions(mesh);
  linalg::DenseMatrix g = gramOf(mesh, contact, bodies, motions, holding);
  const auto eigenvalues = linalg::symmetricEigen(g);
  std::vector<unsigned char> loose(mesh.parts, 0);
  for (int i = 0; i < motions.size(); ++i)
    for (int k = 0; k < motions.size() && isFree(eigenvalues[k], eigenvalues.back()); ++k)
      if (std::abs(g(i, k)) > 1e-6) loose[i / motions.perPart()] = 1;
  return loose;
}

std::optional<RigidBodyMode> rigidBodyMode(const mesh::Mesh& mesh, const Contact& contact,
                                           const elasticity::Bodies& bodies,
                                           const SupportingContact& holding) {
  const RigidMotions motions = rigidMotions(mesh);
  linalg::DenseMatrix g = gramOf(mesh, contact, bodies, motions, holding);
  const auto eigenvalues = linalg::symmetricEigen(g);
  if (!isFree(eigenvalues.front(), eigenvalues.back())) return std::nullopt;
  std::vector<unsigned char> isOfBolt(mesh.parts, 0), isReference(mesh.parts, 0);
  for (const auto& reference : mesh.references) isReference[reference.part] = 1;
  for (const auto& section : mesh.sections) isOfBolt[mesh.references[section.reference].part] = 1;
  int worst = 0;
  double most = -1;
  for (int part = 0; part < mesh.parts; ++part) {
    if (isOfBolt[part]) continue;  // its section opens because a body is loose
    double weight = 0;
    for (int k = 0; k < motions.perPart(); ++k)
      weight += std::pow(g(part * motions.perPart() + k, 0), 2);
    if (weight > most) most = weight, worst = part;
  }
  static constexpr const char* plane[] = {"translation x", "translation y", "rotation z"};
  static constexpr const char* space[] = {"translation x", "translation y", "translation z",
                                          "rotation x",    "rotation y",    "rotation z"};
  const char* const* names = mesh.dimension == 2 ? plane : space;
  std::string motion;
  double sign = 0;  // the sign of an eigenvector is arbitrary; make the first listed part positive
  for (int k = 0; k < motions.perPart(); ++k)
    if (const double part = g(worst * motions.perPart() + k, 0); std::abs(part) > 1e-6) {
      if (sign == 0) sign = std::copysign(1, part);
      motion += formatted(motion.empty() ? "%s: %.3g" : ", %s: %.3g", names[k], sign * part);
    }
  return RigidBodyMode{mesh.partName[worst], motion, openingBolts(mesh, g, motions, 0),
                       isReference[worst] != 0};
}

void rejectRigidBodyModes(const mesh::Mesh& mesh, const Contact& contact,
                          const elasticity::Bodies& bodies) {
  if (const auto mode = rigidBodyMode(mesh, contact, bodies, {}))
    throw Error("singular problem: body '" + mode->body +
                "' can move rigidly with closed frictionless contact (" + mode->motion + ")" +
                boltText(*mode) + "; support it with -constraint_<group>_clamped, " +
                (mode->isReference ? "-constraint_<name>_clamped_rotation, " : "") +
                "-ground_<group>_stiffness or -bushing_<name>_stiffness");
}

}  // namespace squeal::contact
