// SPDX-License-Identifier: BSD-2-Clause
#include "regime/regime/reduced_model.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "algebra/linalg/lu.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/system/mpi.hpp"
#include "base/system/termination.hpp"
#include "regime/regime/columns.hpp"
#include "regime/regime/contact_nodes.hpp"
#include "regime/regime/static_responses.hpp"

namespace squeal::regime {
namespace {

using linalg::Block;
using linalg::DenseMatrix;
using linalg::DenseView;

/// Makes the columns of V M-orthonormal and returns VᵀKV, diagonal.
std::vector<double> orthonormalise(const FullModel& full, MPI_Comm comm, Block& v,
                                   const Block& further) {
  const Mat mass = full.bodies.mass, stiffness = full.bodies.stiffness;
  const auto project = [&](Block& x) {
    DenseMatrix along = linalg::transposedProduct(comm, v, productOf(mass, x));
    linalg::multiplyAdd(v, along, x, -1);
  };
  for (PetscInt j = 0; j < further.columns(); ++j) {
    stopIfRequested(comm);
    Block column{DenseView(further.columnRange(j, j + 1))};
    const auto length = [&] {
      return std::sqrt(linalg::transposedProduct(comm, column, productOf(mass, column))(0, 0));
    };
    const double before = length();
    project(column), project(column);
    const double after = length();
    if (!(after > 1e-9 * before)) continue;  // the free modes contain it
    for (double& entry : column.entries()) entry /= after;
    v.append(column);
  }
  DenseMatrix k = linalg::transposedProduct(comm, v, productOf(stiffness, v)),
              m = linalg::transposedProduct(comm, v, productOf(mass, v));
  auto lambda = linalg::symmetricEigen(k, m);
  v = linalg::product(v, k);
  return lambda;
}

/// Collective. Returns the largest magnitude in each column of all ranks' rows.
std::vector<double> largestOfColumns(MPI_Comm comm, const DenseMatrix& own) {
  std::vector<double> largest(own.columns());
  for (PetscInt j = 0; j < own.columns(); ++j)
    for (const double x : own.column(j)) largest[j] = std::max(largest[j], std::abs(x));
  mpi::reduce<double>(comm, largest, MPI_MAX);
  return largest;
}

/// The static responses Ψ̃ to all gaps and slips, without their modal part.
struct ContactResponses {
  Block columns;             // nodal displacements, kind by kind
  DenseMatrix jumps;         // J Ψ̃ of all nodes, node by node
  std::vector<double> unit;  // [column] 1 over the largest jump with the part of the modes
  int dimension;
  /// Returns the column of a row of the jump.
  PetscInt columnOf(PetscInt row) const {
    return row % dimension * (jumps.rows() / dimension) + row / dimension;
  }
};

/// Collective. Returns the static responses Ψ̃ = (1 − V Vᵀ M) Ψ₀.
ContactResponses contactResponses(const FullModel& full, const std::vector<Node>& own,
                                  const Order& order, const Block& v) {
  const MPI_Comm comm = full.contact.mesh->comm;
  const int dimension = full.contact.mesh->dimension;
  ContactResponses result{StaticResponses(full, own).all(order.own()), {}, {}, dimension};
  Block& psi = result.columns;
  for (const double size : largestOfColumns(comm, ownJumps(full.contact, own, psi)))
    result.unit.push_back(size > 0 ? 1 / size : 1);
  const Block massModes = productOf(full.bodies.mass, v);
  linalg::multiplyAdd(v, linalg::transposedProduct(comm, massModes, psi), psi, -1);
  result.jumps = order.gathered(ownJumps(full.contact, own, psi), dimension);
  return result;
}

/// Returns false for slips that supports hold or without friction, [row].
std::vector<unsigned char> movingRows(const std::vector<Node>& nodes,
                                      const ContactResponses& responses) {
  const DenseMatrix& jumps = responses.jumps;
  const int dimension = responses.dimension;
  std::vector<double> largest(dimension, 0), size(jumps.rows(), 0);
  for (PetscInt i = 0; i < jumps.rows(); ++i) {
    for (PetscInt j = 0; j < jumps.columns(); ++j)
      size[i] = std::max(size[i], std::abs(jumps(i, j)));
    largest[i % dimension] = std::max(largest[i % dimension], size[i]);
  }
  std::vector<unsigned char> moves(jumps.rows(), 1);
  for (PetscInt i = 0; i < jumps.rows(); ++i)
    if (i % dimension > 0 &&
        (!nodes[i / dimension].hasFriction() || size[i] <= 1e-10 * largest[i % dimension]))
      moves[i] = 0;
  return moves;
}

/// Returns (J Ψ̃)⁻¹ in the rows that move. Throws Error if it is singular.
DenseMatrix inverseJumps(const ContactResponses& responses, const std::vector<PetscInt>& rows) {
  const PetscInt n = std::ssize(rows);
  // Each column is scaled by its response including the modal part, so the round-off of a column
  // with only a modal part stays small.
  DenseMatrix scaled(n, n), inverse = linalg::identity(n);
  for (PetscInt j = 0; j < n; ++j) {
    const PetscInt column = responses.columnOf(rows[j]);
    for (PetscInt i = 0; i < n; ++i)
      scaled(i, j) = responses.jumps(rows[i], column) * responses.unit[column];
  }
  const linalg::Lu<double> lu(std::move(scaled));
  if (!(lu.pivotRatio() > 1e-12))
    throw Error(
        "stage regime: the free modes contain the whole motion of the contact, which leaves no "
        "flexibility for the contact forces; reduce -modes_count");
  lu.solve(inverse);
  for (PetscInt j = 0; j < n; ++j)
    for (PetscInt i = 0; i < n; ++i) inverse(i, j) *= responses.unit[responses.columnOf(rows[i])];
  return inverse;
}

/// Returns the constraint modes Ψ = Ψ̃ (J Ψ̃)⁻¹ with J Ψ = 1 in the rows that move, and zeros in the
/// other columns.
Block constraintModes(const ContactResponses& responses, const std::vector<unsigned char>& moves) {
  std::vector<PetscInt> rows;
  for (std::size_t i = 0; i < moves.size(); ++i)
    if (moves[i]) rows.push_back(i);
  const DenseMatrix inverse = inverseJumps(responses, rows);
  DenseMatrix coefficients(moves.size(), moves.size());
  for (std::size_t j = 0; j < rows.size(); ++j)
    for (std::size_t i = 0; i < rows.size(); ++i)
      coefficients(responses.columnOf(rows[i]), rows[j]) = inverse(i, j);
  return linalg::product(responses.columns, coefficients);
}

/// Collective. Returns factor · Xᵀ A Z.
DenseMatrix form(MPI_Comm comm, const Block& x, Mat a, const Block& z, double factor = 1) {
  DenseMatrix result(x.columns());
  for (PetscInt begin = 0; begin < z.columns(); begin += blockColumns) {
    stopIfRequested(comm);
    const PetscInt end = std::min(z.columns(), begin + blockColumns);
    result.append(linalg::transposedProduct(comm, x, productOf(a, z.columnRange(begin, end))));
  }
  for (double& entry : result.entries()) entry *= factor;
  return result;
}

DenseMatrix transposed(const DenseMatrix& a) {
  DenseMatrix result(a.columns(), a.rows());
  for (PetscInt j = 0; j < a.columns(); ++j)
    for (PetscInt i = 0; i < a.rows(); ++i) result(j, i) = a(i, j);
  return result;
}

/// Collective. Sets the matrices of the model [M.70]:
///   C = Vᵀ C V,   X_z = Ψᵀ X Ψ and X_zq = Ψᵀ X V for X = M, C, K, where M_zq = 0.
void assemble(const FullModel& full, const Block& v, const Block& z, ReducedModel& model) {
  const MPI_Comm comm = full.contact.mesh->comm;
  const Mat damping = full.bodies.damping.get();
  model.damping = linalg::transposedProduct(comm, v, productOf(damping, v));
  for (double& entry : model.damping.entries()) entry *= full.damping;
  model.boundaryStiffness = linalg::symmetricPart(form(comm, z, full.bodies.stiffness, z));
  model.couplingStiffness = transposed(form(comm, v, full.bodies.stiffness, z));
  model.boundaryMass = linalg::symmetricPart(form(comm, z, full.bodies.mass, z));
  model.boundaryDamping = DenseMatrix(z.columns(), z.columns());
  model.couplingDamping = DenseMatrix(z.columns(), v.columns());
  if (damping) {
    model.boundaryDamping = linalg::symmetricPart(form(comm, z, damping, z, full.damping));
    model.couplingDamping = transposed(form(comm, v, damping, z, full.damping));
  }
  // A row without z is not coupled.
  for (PetscInt i = 0; i < model.rows(); ++i)
    if (!model.moves[i]) model.boundaryStiffness(i, i) = 1;
}

}  // namespace

Reduction reduce(const FullModel& full, Block free, const Block& unstable) {
  const auto& contact = full.contact;
  const MPI_Comm comm = contact.mesh->comm;
  const auto own = ownNodes(contact, full.solution);
  const Order order(comm, own);
  Reduction result;
  ReducedModel& model = result.model;
  model.dimension = contact.mesh->dimension;
  model.nodes = order.nodes();
  if (!contact.law.constant()) model.law = [law = contact.law](double w) { return law.value(w); };
  result.contactNode = order.own();
  result.modes = std::move(free);
  const Block& v = result.modes;
  model.stiffness = orthonormalise(full, comm, result.modes, unstable);
  {
    const ContactResponses responses = contactResponses(full, own, order, v);
    model.moves = movingRows(model.nodes, responses);
    result.responses = constraintModes(responses, model.moves);
  }
  model.jump = order.gathered(ownJumps(contact, own, v), model.dimension);
  for (PetscInt i = 0; i < model.rows(); ++i)
    if (!model.moves[i])
      for (PetscInt j = 0; j < model.modes(); ++j) model.jump(i, j) = 0;
  assemble(full, v, result.responses, model);
  return result;
}

}  // namespace squeal::regime
