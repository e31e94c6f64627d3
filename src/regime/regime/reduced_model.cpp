#include "regime/regime/reduced_model.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <span>
#include <tuple>

#include "algebra/linalg/lu.hpp"
#include "algebra/linalg/symmetric.hpp"
#include "base/petsc/arrays.hpp"
#include "base/system/concatenation.hpp"
#include "base/system/termination.hpp"
#include "model/elasticity/elasticity.hpp"
#include "model/mesh/vector.hpp"
#include "steady/impedance/impedance.hpp"

namespace squeal::regime {
namespace {

using linalg::Block;
using linalg::DenseMatrix;
using linalg::DenseView;
using mesh::Point;

/// The number of columns whose products are held at once.
constexpr PetscInt blockColumns = 64;

/// Collective. Returns a vector that borrows the entries of one column.
OwnedVec borrowedVector(MPI_Comm comm, std::span<const double> column) {
  OwnedVec vector;
  check(
      VecCreateMPIWithArray(comm, 1, column.size(), PETSC_DETERMINE, column.data(), vector.out()));
  return vector;
}

/// Returns two unit vectors that span the tangent plane, the first along the slip if there is one.
std::array<Point, 2> tangentsOf(const Point& normal, const Point& slip, int dimension) {
  std::array<Point, 2> tangents{};
  Point first = slip;
  if (mesh::dot(first, first) == 0) {
    if (dimension == 2) {
      first = {normal[1], -normal[0], 0};
    } else {
      const int axis = std::ranges::min_element(normal, {}, [](double x) { return std::abs(x); }) -
                       normal.begin();
      first[axis] = 1;
      const double along = normal[axis];
      for (int d = 0; d < 3; ++d) first[d] -= along * normal[d];
    }
  }
  const double length = std::sqrt(mesh::dot(first, first));
  for (double& x : first) x /= length;
  tangents[0] = first;
  if (dimension == 3)
    tangents[1] = {normal[1] * first[2] - normal[2] * first[1],
                   normal[2] * first[0] - normal[0] * first[2],
                   normal[0] * first[1] - normal[1] * first[0]};
  return tangents;
}

/// The contact nodes of all ranks in an order that does not depend on the ranks: by interface, then
/// by position.
class Order {
 public:
  Order(MPI_Comm comm, const std::vector<Node>& own) : comm_(comm), ranks_(comm, own.size()) {
    const auto all = ranks_.gathered(own);
    std::vector<PetscInt> sorted(all.size());
    std::iota(sorted.begin(), sorted.end(), 0);
    std::ranges::sort(sorted, {},
                      [&](PetscInt i) { return std::tuple(all[i].interface, all[i].position); });
    place_.resize(all.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      place_[sorted[i]] = i;
      nodes_.push_back(all[sorted[i]]);
      const PetscInt local = sorted[i] - ranks_.ownBegin();
      own_.push_back(local >= 0 && local < std::ssize(own) ? local : -1);
    }
  }
  const std::vector<Node>& nodes() const { return nodes_; }
  /// [node] its place on this rank, or −1.
  const std::vector<PetscInt>& own() const { return own_; }
  /// Collective. Returns the rows of all nodes from `perNode` rows for each node of this rank.
  DenseMatrix gathered(const DenseView& own, PetscInt perNode) const {
    // Node by node, so that the part of a rank is in one piece.
    const PetscInt columns = own.columns(), entries = perNode * columns;
    std::vector<double> packed(own.size());
    for (PetscInt j = 0; j < columns; ++j)
      for (PetscInt i = 0; i < own.rows(); ++i)
        packed[i / perNode * entries + i % perNode * columns + j] = own(i, j);
    const auto all = Concatenation(comm_, packed.size()).gathered(packed);
    DenseMatrix result(std::ssize(nodes_) * perNode, columns);
    for (std::size_t node = 0; node < place_.size(); ++node)
      for (PetscInt c = 0; c < perNode; ++c)
        for (PetscInt j = 0; j < columns; ++j)
          result(place_[node] * perNode + c, j) = all[node * entries + c * columns + j];
    return result;
  }

 private:
  MPI_Comm comm_;
  Concatenation ranks_;
  std::vector<Node> nodes_;
  std::vector<PetscInt> place_, own_;
};

/// Collective. Returns the jumps of nodal displacements, the rows of this rank's nodes.
DenseMatrix ownJumps(const contact::Contact& contact, const std::vector<Node>& nodes,
                     const DenseView& u) {
  const int dimension = contact.mesh->dimension;
  DenseMatrix rows(std::ssize(nodes) * dimension);
  OwnedVec jump = elasticity::nodalVector(*contact.mesh);
  for (PetscInt j = 0; j < u.columns(); ++j) {
    if (j % blockColumns == 0) stopIfAsked(contact.mesh->comm);
    check(MatMult(contact.jump, borrowedVector(contact.mesh->comm, u.column(j)), jump));
    std::vector<double> column(nodes.size() * dimension);
    const ReadArray values(jump);
    for (int c = 0; c < dimension; ++c) {
      std::vector<double> component;
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const Point& direction = c == 0 ? nodes[i].normal : nodes[i].tangents[c - 1];
        double sum = 0;
        for (int d = 0; d < dimension; ++d)
          sum += direction[d] * values[dimension * contact.nodes[i].node + d];
        component.push_back(sum);
      }
      component = contact.gapCoefficients(component);
      for (std::size_t i = 0; i < nodes.size(); ++i) column[i * dimension + c] = component[i];
    }
    rows.append(std::span<const double>(column));
  }
  return rows;
}

/// The static responses of the contact.
class StaticResponses {
 public:
  StaticResponses(const FullModel& full, const std::vector<Node>& own)
      : full_(full),
        open_(full.contact.transformation(std::vector<unsigned char>(own.size(), 1),
                                          std::vector<unsigned char>(own.size(), 1))) {
    const std::vector<unsigned char> all(own.size(), 1);
    for (int a = 0; a + 1 < full.contact.mesh->dimension; ++a) {
      std::vector<contact::Slip> along(own.size());
      for (std::size_t i = 0; i < own.size(); ++i)
        along[i].direction = own[i].tangents[a], along[i].coefficient.fixed = 1;
      const OwnedMat rows = full.contact.slipRows(open_, along, all, 0);
      impedances_.push_back(std::make_unique<impedance::Impedance>(
          full.contact, open_, full.bodies.stiffness, rows, full.closed));
    }
  }

  /// Collective. Returns the responses of the nodes in the given order, nodal displacements: to a
  /// unit gap, and along each tangent to a unit force or, where the node is held, a unit slip.
  Block all(const std::vector<PetscInt>& order) const {
    const MPI_Comm comm = impedances_[0]->comm();
    const int dimension = full_.contact.mesh->dimension;
    PetscInt nodal = 0, unknowns = 0;
    check(MatGetLocalSize(open_.trial, &nodal, &unknowns));
    Block result(nodal);
    result.reserve(std::ssize(order) * dimension);
    // Responses of one kind go together, since they share an operator.
    for (int c = 0; c < dimension; ++c) {
      const auto& impedance = *impedances_[std::max(0, c - 1)];
      for (std::size_t begin = 0; begin < order.size(); begin += blockColumns) {
        stopIfAsked(comm);
        const std::size_t end = std::min<std::size_t>(order.size(), begin + blockColumns);
        DenseMatrix causes(impedance.length(), end - begin);
        for (std::size_t i = begin; i < end; ++i)
          if (order[i] >= 0) causes(causeOf(impedance, order[i], c), i - begin) = 1;
        Block x(unknowns, end - begin);
        std::vector<OwnedVec> vectors;
        std::vector<Vec> borrowed;
        for (PetscInt j = 0; j < x.columns(); ++j) {
          vectors.push_back(borrowedVector(comm, x.column(j)));
          borrowed.push_back(vectors.back());
        }
        impedance.addUnknowns(causes, borrowed);
        linalg::appendProduct(open_.trial, x, result);
      }
    }
    return result;
  }

 private:
  /// Returns the row of the cause: a released unknown, or the friction of a node.
  PetscInt causeOf(const impedance::Impedance& impedance, PetscInt node, int c) const {
    const PetscInt nodes = impedance.nodes();
    if (c == 0) return nodes + node;
    const auto& nodeOf = impedance.nodeOf();
    int found = 0;
    for (std::size_t k = nodes; k < nodeOf.size(); ++k)
      if (nodeOf[k] == node && ++found == c) return nodes + k;
    return node;
  }

  const FullModel& full_;
  contact::Transformation open_;
  std::vector<std::unique_ptr<impedance::Impedance>> impedances_;  // [tangent]
};

/// Collective. Returns A X; zeros for a null A.
Block productOf(Mat a, const DenseView& x) {
  Block result(x.rows());
  if (!a) return Block(x.rows(), x.columns());
  linalg::appendProduct(a, x, result);
  return result;
}

/// Makes the columns of V M-orthonormal and returns VᵀKV, diagonal.
std::vector<double> orthonormalise(const FullModel& full, MPI_Comm comm, Block& v,
                                   const Block& further) {
  const Mat mass = full.bodies.mass, stiffness = full.bodies.stiffness;
  const auto project = [&](Block& x) {
    DenseMatrix along = linalg::transposedProduct(comm, v, productOf(mass, x));
    linalg::multiplyAdd(v, along, x, -1);
  };
  for (PetscInt j = 0; j < further.columns(); ++j) {
    stopIfAsked(comm);
    Block column{DenseView(further.columnRange(j, j + 1))};
    const auto length = [&] {
      return std::sqrt(linalg::transposedProduct(comm, column, productOf(mass, column))(0, 0));
    };
    const double before = length();
    project(column), project(column);
    const double after = length();
    if (!(after > 1e-9 * before)) continue;  // the free modes hold it
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
  check(MPI_Allreduce(MPI_IN_PLACE, largest.data(), largest.size(), MPI_DOUBLE, MPI_MAX, comm));
  return largest;
}

}  // namespace

std::vector<Node> ownNodes(const contact::Contact& contact, const steady::Solution& solution) {
  const auto slip = steady::withReleased(contact, solution.slip, solution.sticking);
  std::array<std::vector<double>, 3> shear;
  for (int d = 0; d < 3; ++d) {
    for (const auto& state : solution.contact) shear[d].push_back(state.frictionForce[d]);
    shear[d] = contact.gapForce(shear[d]);
  }
  std::vector<Node> nodes;
  for (std::size_t i = 0; i < contact.nodes.size(); ++i) {
    const auto& from = contact.nodes[i];
    const auto& state = solution.contact[i];
    Node node;
    node.interface = from.interface;
    node.position = from.position;
    node.normal = from.normal;
    node.tangents = tangentsOf(from.normal, slip[i].direction, contact.mesh->dimension);
    node.area = from.area;
    node.gap = solution.closed[i] ? 0 : state.coefficient;
    node.normalForce = solution.closed[i] ? state.normalForce : 0;
    if (from.role == contact::Role::sliding) {
      node.friction = slip[i].friction(solution.at.friction);
      node.lawCoefficient = slip[i].coefficient.at(solution.at.friction);
      node.frictionSlope = slip[i].frictionSlope(solution.at.friction);
      node.sweptFriction = slip[i].friction(solution.at.friction + 1) - node.friction;
      node.velocity = {slip[i].speed, 0};
      node.shear = {-node.friction * node.normalForce, 0};
    } else if (from.role == contact::Role::sticking) {
      node.friction = contact.options[from.interface].stickingLimit.value_or(INFINITY);
      for (int a = 0; a < 2; ++a)
        for (int d = 0; d < 3; ++d) node.shear[a] += node.tangents[a][d] * shear[d][i];
    }
    nodes.push_back(node);
  }
  return nodes;
}

Reduction reduce(const FullModel& full, Block free, const Block& unstable) {
  const auto& contact = full.contact;
  const MPI_Comm comm = contact.mesh->comm;
  const int dimension = contact.mesh->dimension;
  const auto own = ownNodes(contact, full.solution);
  const Order order(comm, own);
  Reduction result;
  ReducedModel& model = result.model;
  model.dimension = dimension;
  model.nodes = order.nodes();
  if (!contact.law.constant()) model.law = [law = contact.law](double w) { return law.value(w); };
  result.contactNode = order.own();
  result.modes = std::move(free);
  Block& v = result.modes;
  model.stiffness = orthonormalise(full, comm, v, unstable);
  const PetscInt k = v.columns();

  Block psi = StaticResponses(full, own).all(order.own());
  const PetscInt count = std::ssize(model.nodes), rows = count * dimension;
  const auto before = largestOfColumns(comm, ownJumps(contact, own, psi));
  const Block massModes = productOf(full.bodies.mass, v);
  linalg::multiplyAdd(v, linalg::transposedProduct(comm, massModes, psi), psi, -1);

  // The columns of Ψ go kind by kind, the rows of the jump node by node.
  const DenseMatrix jumps = order.gathered(ownJumps(contact, own, psi), dimension);
  model.jump = order.gathered(ownJumps(contact, own, v), dimension);
  std::vector<double> largest(dimension, 0);
  std::vector<double> size(rows, 0);
  for (PetscInt i = 0; i < rows; ++i) {
    for (PetscInt j = 0; j < rows; ++j) size[i] = std::max(size[i], std::abs(jumps(i, j)));
    largest[i % dimension] = std::max(largest[i % dimension], size[i]);
  }
  model.moves.assign(rows, 1);
  std::vector<PetscInt> kept;
  for (PetscInt i = 0; i < rows; ++i) {
    const bool isSlip = i % dimension > 0;
    if (isSlip && (!model.nodes[i / dimension].rubs() || size[i] <= 1e-10 * largest[i % dimension]))
      model.moves[i] = 0;
    else
      kept.push_back(i);
  }
  for (PetscInt i = 0; i < rows; ++i)
    if (!model.moves[i])
      for (PetscInt j = 0; j < k; ++j) model.jump(i, j) = 0;
  const auto columnOf = [&](PetscInt row) { return row % dimension * count + row / dimension; };
  DenseMatrix scale(kept.size(), kept.size());  // J Ψ of what moves
  for (std::size_t j = 0; j < kept.size(); ++j)
    for (std::size_t i = 0; i < kept.size(); ++i) scale(i, j) = jumps(kept[i], columnOf(kept[j]));
  // Columns in the units that they had with the part that the modes carry: where nothing but that
  // part was there, the rounding that is left stays small.
  std::vector<double> unit(kept.size());
  for (std::size_t j = 0; j < kept.size(); ++j) {
    const double size = before[columnOf(kept[j])];
    unit[j] = size > 0 ? 1 / size : 1;
    for (double& x : scale.column(j)) x *= unit[j];
  }
  const linalg::Lu<double> lu(std::move(scale));
  if (!(lu.pivotRatio() > 1e-12))
    throw Error(
        "stage regime: the free modes carry all of the motion of the contact, and no flexibility "
        "is left for the contact forces; give fewer -modes_count");
  DenseMatrix inverse(kept.size(), kept.size());
  for (std::size_t i = 0; i < kept.size(); ++i) inverse(i, i) = 1;
  lu.solve(inverse);
  for (std::size_t j = 0; j < kept.size(); ++j)
    for (std::size_t i = 0; i < kept.size(); ++i) inverse(i, j) *= unit[i];
  DenseMatrix coefficients(rows, rows);
  for (std::size_t j = 0; j < kept.size(); ++j)
    for (std::size_t i = 0; i < kept.size(); ++i)
      coefficients(columnOf(kept[i]), kept[j]) = inverse(i, j);
  result.responses = linalg::product(psi, coefficients);
  psi = Block();

  const Mat damping = full.bodies.damping.get();
  const auto scaled = [&](DenseMatrix matrix) {
    for (double& entry : matrix.entries()) entry *= full.damping;
    return matrix;
  };
  model.damping = scaled(linalg::transposedProduct(comm, v, productOf(damping, v)));
  const Block& z = result.responses;
  model.boundaryMass = model.boundaryDamping = model.boundaryStiffness = DenseMatrix(rows);
  DenseMatrix dampedModes(k), stiffModes(k);
  for (PetscInt begin = 0; begin < rows; begin += blockColumns) {
    stopIfAsked(comm);
    const DenseView some = z.columnRange(begin, std::min(rows, begin + blockColumns));
    const Block stiff = productOf(full.bodies.stiffness, some);
    model.boundaryStiffness.append(linalg::transposedProduct(comm, z, stiff));
    stiffModes.append(linalg::transposedProduct(comm, v, stiff));
    model.boundaryMass.append(
        linalg::transposedProduct(comm, z, productOf(full.bodies.mass, some)));
    if (!damping) continue;
    const Block damped = productOf(damping, some);
    model.boundaryDamping.append(scaled(linalg::transposedProduct(comm, z, damped)));
    dampedModes.append(scaled(linalg::transposedProduct(comm, v, damped)));
  }
  if (!damping) model.boundaryDamping = DenseMatrix(rows, rows), dampedModes = DenseMatrix(k, rows);
  const auto transposed = [](const DenseMatrix& a) {
    DenseMatrix result(a.columns(), a.rows());
    for (PetscInt j = 0; j < a.columns(); ++j)
      for (PetscInt i = 0; i < a.rows(); ++i) result(j, i) = a(i, j);
    return result;
  };
  model.couplingStiffness = transposed(stiffModes);
  model.couplingDamping = transposed(dampedModes);
  model.boundaryStiffness = linalg::symmetricPart(model.boundaryStiffness);
  model.boundaryDamping = linalg::symmetricPart(model.boundaryDamping);
  model.boundaryMass = linalg::symmetricPart(model.boundaryMass);
  // A row without z stands alone.
  for (PetscInt i = 0; i < rows; ++i)
    if (!model.moves[i]) model.boundaryStiffness(i, i) = 1;
  return result;
}

}  // namespace squeal::regime
