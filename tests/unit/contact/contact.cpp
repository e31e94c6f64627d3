// The change of variables that carries contact: kinematics T, friction E, frames, areas and slip
// directions.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "contact/coupled.hpp"
#include "support/case.hpp"
#include "support/model.hpp"

namespace squeal {
namespace {

using mesh::Point;
using test::contains;
using test::errorOf;
using test::Model;

/// Pseudo-random entries in [−1, 1] that do not depend on the number of ranks.
std::vector<double> randomEntries(PetscInt size, unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<double> entries;
  for (PetscInt i = 0; i < size; ++i) entries.push_back(2.0 * generator() / 4294967295.0 - 1);
  return entries;
}

OwnedVec vectorOf(Mat matrix, bool columns, const std::vector<double>& entries) {
  OwnedVec vector;
  if (columns)
    check(MatCreateVecs(matrix, vector.out(), nullptr));
  else
    check(MatCreateVecs(matrix, nullptr, vector.out()));
  PetscInt first = 0, end = 0;
  check(VecGetOwnershipRange(vector, &first, &end));
  for (PetscInt i = first; i < end; ++i) check(VecSetValue(vector, i, entries[i], INSERT_VALUES));
  check(VecAssemblyBegin(vector));
  check(VecAssemblyEnd(vector));
  return vector;
}

std::vector<double> product(Mat matrix, const std::vector<double>& x, bool transposed = false) {
  const OwnedVec in = vectorOf(matrix, !transposed, x);
  OwnedVec out;
  if (transposed) {
    check(MatCreateVecs(matrix, out.out(), nullptr));
    check(MatMultTranspose(matrix, in, out));
  } else {
    check(MatCreateVecs(matrix, nullptr, out.out()));
    check(MatMult(matrix, in, out));
  }
  return test::allEntries(out);
}

/// What the tests need of a contact node, of all ranks alike.
struct Node {
  Point position, normal, slip;
  double slipSpeed, area;
  PetscInt pad, master, gapColumn;  // global
};

std::vector<Node> allNodes(const contact::Contact& contact,
                           const std::vector<PetscInt>& gapColumn) {
  constexpr int width = 14;
  std::vector<double> mine;
  for (std::size_t i = 0; i < contact.nodes.size(); ++i) {
    const auto& node = contact.nodes[i];
    for (const Point& p : {node.position, node.normal, node.slip})
      mine.insert(mine.end(), p.begin(), p.end());
    mine.insert(mine.end(), {node.slipSpeed, node.area, double(node.globalNode),
                             double(node.master), double(gapColumn[i])});
  }
  int size = 1, count = static_cast<int>(mine.size());
  check(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  std::vector<int> counts(static_cast<std::size_t>(size)), offsets(counts.size(), 0);
  check(MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, PETSC_COMM_WORLD));
  for (std::size_t r = 1; r < counts.size(); ++r) offsets[r] = offsets[r - 1] + counts[r - 1];
  std::vector<double> all(static_cast<std::size_t>(offsets.back() + counts.back()));
  check(MPI_Allgatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(), offsets.data(),
                       MPI_DOUBLE, PETSC_COMM_WORLD));
  std::vector<Node> nodes;
  for (std::size_t i = 0; i < all.size(); i += width)
    nodes.push_back({{all[i], all[i + 1], all[i + 2]},
                     {all[i + 3], all[i + 4], all[i + 5]},
                     {all[i + 6], all[i + 7], all[i + 8]},
                     all[i + 9],
                     all[i + 10],
                     static_cast<PetscInt>(all[i + 11]),
                     static_cast<PetscInt>(all[i + 12]),
                     static_cast<PetscInt>(all[i + 13])});
  return nodes;
}

Point at(const std::vector<double>& u, PetscInt node, int dimension) {
  Point p{};
  for (int d = 0; d < dimension; ++d) p[d] = u[dimension * node + d];
  return p;
}

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// E = Nᵀ S, N×n, of L(f) = T + f E.
OwnedMat frictionTest(const contact::Contact& contact,
                      const contact::Transformation& transformation,
                      const std::vector<unsigned char>& slides) {
  const OwnedMat rows = contact.slipRows(transformation, contact.slip(1, nullptr), slides);
  OwnedMat result;
  check(
      MatTransposeMatMult(contact.reaction, rows, MAT_INITIAL_MATRIX, PETSC_DEFAULT, result.out()));
  return result;
}

struct Coupled {
  Model model;
  contact::Transformation transformation;
  OwnedMat friction;
  std::vector<Node> nodes;
  int dimension() const { return model.mesh->dimension; }
  Point jump(const std::vector<double>& u, const Node& node) const {
    return minus(at(u, node.pad, dimension()),
                 node.master >= 0 ? at(u, node.master, dimension()) : Point{});
  }
};

/// All gaps unknown, all nodes sliding, from the options in force.
Coupled coupled() {
  Coupled c{test::buildModel(), {}, {}, {}};
  const std::vector<unsigned char> all(c.model.contact.nodes.size(), 1);
  c.transformation = c.model.contact.transformation(all);
  c.friction = frictionTest(c.model.contact, c.transformation, all);
  c.nodes = allNodes(c.model.contact, c.transformation.gapColumn);
  return c;
}

void requireSlip(const contact::Contact& contact) {
  contact::requireSlip(contact, contact.slip(1, nullptr),
                       std::vector<unsigned char>(contact.nodes.size(), 1));
}

const std::string layers = "-mesh_set nx=6,ny_disc=3,ny_pad=2";
/// Two cylinders, the inner one turning: contact on a circle.
const std::string cylinders = "-mesh_file meshes/cylinders.geo " +
                              test::material("inner", "1", "0.3", "1") +
                              test::material("outer", "1", "0.3", "1") +
                              "-contact_ring_pad outer_face -contact_ring_disc inner_face "
                              "-constraint_sym_x_clamped x -constraint_sym_y_clamped y ";

/// A ball turning in a shell that rests, its surface shared: contact on a sphere, frames in all
/// directions. The poles are nodes.
std::string ballInShell(int order) {
  const auto file = test::writeFile("ball_in_shell.geo", R"(
SetFactory("OpenCASCADE");
DefineConstant[order = {1, Name "order"}];
Sphere(1) = {0, 0, 0, 1};
Sphere(2) = {0, 0, 0, 2};
BooleanFragments{ Volume{2}; Delete; }{ Volume{1}; Delete; }
inner() = Boundary{ Volume{1}; };
outer() = Boundary{ Volume{2}; };
outer() -= {Abs(inner(0))};
Physical Volume("ball") = {1};
Physical Volume("shell") = {2};
Physical Surface("face") = {Abs(inner(0))};
Physical Surface("skin") = {outer()};
MeshSize{ : } = 0.7;
Mesh.ElementOrder = order;
)");
  return "-mesh_file " + file + " -mesh_set order=" + std::to_string(order) +
         test::material("ball", "1", "0.3", "1") + test::material("shell", "1", "0.3", "1") +
         "-motion_ball_speed 3 -contact_ring_pad face -contact_ring_disc face "
         "-constraint_ball_clamped xyz "
         "-constraint_skin_clamped xyz ";
}

void setLayers() { test::setCase("two_layers", layers); }
void setCylinders() {
  test::setOptions(cylinders +
                   "-mesh_set n_inner=2,n_outer=2,n_theta=16,order=2 -motion_inner_speed 2");
}

// n·u_P = n·u_D + g at every pad node, whatever the unknowns are.
void gapIsTheUnknown(const Coupled& c) {
  ASSERT_GT(c.nodes.size(), 0u);
  const auto x = randomEntries(c.transformation.columns, 7), u = product(c.transformation.trial, x);
  for (const auto& node : c.nodes) {
    ASSERT_GE(node.gapColumn, 0);
    EXPECT_NEAR(test::dot(node.normal, c.jump(u, node)), x[node.gapColumn], 1e-14);
  }
  // Every column counts: TᵀT of a change of variables is regular.
  OwnedMat gram;
  check(MatTransposeMatMult(c.transformation.trial, c.transformation.trial, MAT_INITIAL_MATRIX,
                            PETSC_DEFAULT, gram.out()));
  for (double diagonal : [&] {
         OwnedVec d;
         check(MatCreateVecs(gram, d.out(), nullptr));
         check(MatGetDiagonal(gram, d));
         return test::allEntries(d);
       }())
    EXPECT_GT(diagonal, 1 - 1e-12);
}

TEST(Trial, GapIsTheUnknownOnLayers) {
  setLayers();
  const auto c = coupled();
  EXPECT_EQ(c.nodes.size(), 6u);
  // Unknowns: 2 · 6 · 4 disc nodes less 12 held, 2 · 6 · 3 pad nodes less 12 held.
  EXPECT_EQ(c.transformation.columns, 60);
  gapIsTheUnknown(c);
  const auto u = product(c.transformation.trial, randomEntries(c.transformation.columns, 8));
  const auto& mesh = *c.model.mesh;
  for (const auto& image : mesh.images)
    for (int d = 0; d < 2; ++d)
      EXPECT_EQ(u[2 * (mesh.firstNode + image.node) + d], u[2 * image.primary + d]);
  const auto offset = test::allEntries(c.model.contact.offset);
  for (const char* group : {"disc_bottom", "pad_top"})
    for (PetscInt node : mesh.nodeGroups.at(group)) {
      EXPECT_EQ(at(u, mesh.firstNode + node, 2), (Point{}));
      EXPECT_EQ(at(offset, mesh.firstNode + node, 2),
                (Point{0, std::string(group) == "pad_top" ? -0.01 : 0.0, 0}));
    }
}

TEST(Trial, GapIsTheUnknownOnCurvedFaces) {
  setCylinders();
  gapIsTheUnknown(coupled());
  for (const int order : {1, 2}) {
    test::setOptions(ballInShell(order));
    gapIsTheUnknown(coupled());
  }
}

// A rigid plate: the gap is counted from its displaced face.
TEST(Trial, ObstacleMovesTheFace) {
  test::setCase("layer", "-mesh_set nx=6,ny=3 -contact_plate_obstacle_displacement 0.3,-0.02,0");
  const auto c = coupled();
  gapIsTheUnknown(c);
  const auto offset = test::allEntries(c.model.contact.offset);
  for (const auto& node : c.nodes) {
    EXPECT_NEAR(node.normal[1], -1, 1e-14);  // from the plate to the layer
    EXPECT_NEAR(at(offset, node.pad, 2)[1], -0.02, 1e-16);
    EXPECT_NEAR(at(offset, node.pad, 2)[0], 0, 1e-16);
  }
}

// The work of forces R on the pad and −R on the disc at one node in a virtual motion T δx, tested
// with L(f) = T + f E:
//   δx·L(f)ᵀ r = R·[δu] + f R_N τ·[δu],   [δu] = δu_P − δu_D,   R_N = R·n.
// So with Coulomb's R_T = −f R_N τ only the row of the gap is left, and it holds R_N.
void frictionOfTheNormalForce(const Coupled& c) {
  const int dimension = c.dimension();
  const auto dx = randomEntries(c.transformation.columns, 11),
             du = product(c.transformation.trial, dx);
  const auto pattern = randomEntries(static_cast<PetscInt>(6 * c.nodes.size()), 12);
  for (std::size_t k = 0; k < c.nodes.size(); k += 3) {
    const auto& node = c.nodes[k];
    ASSERT_NEAR(test::dot(node.slip, node.slip), 1, 1e-14);
    EXPECT_NEAR(test::dot(node.slip, node.normal), 0, 1e-14);
    for (const double friction : {0.0, 0.3, 1.7}) {
      const double normalForce = pattern[6 * k + 3];
      Point any{pattern[6 * k], pattern[6 * k + 1], dimension == 3 ? pattern[6 * k + 2] : 0},
          coulomb{};
      for (std::size_t d = 0; d < 3; ++d)
        coulomb[d] = normalForce * (node.normal[d] - friction * node.slip[d]);
      for (const bool slides : {false, true}) {
        const Point& force = slides ? coulomb : any;
        std::vector<double> r(static_cast<std::size_t>(dimension * c.model.mesh->totalNodes), 0.0);
        for (int d = 0; d < dimension; ++d) {
          r[dimension * node.pad + d] = force[d];
          if (node.master >= 0) r[dimension * node.master + d] = -force[d];
        }
        auto rows = product(c.transformation.trial, r, true);
        const auto part = product(c.friction, r, true);
        double work = 0;
        for (std::size_t i = 0; i < rows.size(); ++i)
          rows[i] += friction * part[i], work += rows[i] * dx[i];
        const Point jump = c.jump(du, node);
        const double rn = test::dot(force, node.normal);
        EXPECT_NEAR(work, test::dot(force, jump) + friction * rn * test::dot(node.slip, jump),
                    1e-13);
        EXPECT_NEAR(rows[node.gapColumn], rn, 1e-14);
        for (std::size_t i = 0; i < rows.size(); ++i)
          if (slides && static_cast<PetscInt>(i) != node.gapColumn) {
            EXPECT_NEAR(rows[i], 0, 1e-14) << "row " << i;
          }
      }
    }
  }
}

TEST(TestFunctions, FrictionJoinsTheTangentialRows) {
  setLayers();
  frictionOfTheNormalForce(coupled());
  setCylinders();
  frictionOfTheNormalForce(coupled());
  test::setCase("layer", "-mesh_set nx=6,ny=3");
  frictionOfTheNormalForce(coupled());
  test::setOptions(ballInShell(1) + "-motion_ball_axis 1,2,3");  // an axis that meets no node
  frictionOfTheNormalForce(coupled());
}

// Open nodes: E vanishes where nothing slides; closed gaps have no column.
TEST(TestFunctions, OnlySlidingNodesCarryFriction) {
  setLayers();
  const auto c = coupled();
  std::vector<unsigned char> open, closed;
  for (const auto& node : c.model.contact.nodes)
    open.push_back(node.position[0] < 0.75), closed.push_back(!open.back());
  const auto part = c.model.contact.transformation(open);
  EXPECT_EQ(part.columns, 54 + 2);  // nodes at x = 0 and 0.5 keep their gaps
  for (std::size_t i = 0; i < open.size(); ++i) EXPECT_EQ(part.gapColumn[i] >= 0, open[i] == 1);
  const auto friction = test::denseCopy(frictionTest(c.model.contact, part, closed));
  for (const auto& node : c.nodes) {
    double size = 0;
    for (PetscInt j = 0; j < friction.columns; ++j)
      for (PetscInt d = 0; d < 2; ++d)
        size = std::max(size, std::abs(friction(2 * node.pad + d, j)));
    EXPECT_EQ(size, node.position[0] < 0.75 ? 0 : 1);
  }
}

/// Rows of the kinematic matrix A at a pad node: its tangents and normal are the columns of the
/// diagonal block.
void orthonormalFrames(const Coupled& c, double tolerance) {
  const auto& model = c.model;
  const int dimension = c.dimension();
  for (const auto& node : model.contact.nodes) {
    std::vector<PetscInt> places;
    for (int d = 0; d < dimension; ++d) places.push_back(dimension * node.globalNode + d);
    std::vector<double> frame(static_cast<std::size_t>(dimension * dimension));
    check(MatGetValues(model.contact.kinematics, dimension, places.data(), dimension, places.data(),
                       frame.data()));
    for (int a = 0; a < dimension; ++a)
      for (int b = 0; b < dimension; ++b) {
        double sum = 0;
        for (int i = 0; i < dimension; ++i)
          sum += frame[i * dimension + a] * frame[i * dimension + b];
        EXPECT_NEAR(sum, a == b, tolerance);
      }
    for (int i = 0; i < dimension; ++i)
      EXPECT_NEAR(frame[i * dimension + dimension - 1], node.normal[i], 1e-14);
  }
}

// Disc inside, pad outside: n is radial. On straight edges the mean of two neighbours is, by
// symmetry; parabolas meet smoothly to h³.
TEST(Frame, IsOrthonormalAndRadialOnACircle) {
  for (const int order : {1, 2}) {
    test::setOptions(cylinders +
                     "-mesh_set n_inner=2,n_outer=2,n_theta=16,order=" + std::to_string(order));
    const auto c = coupled();
    EXPECT_EQ(c.nodes.size(), order == 1 ? 16u : 32u);
    orthonormalFrames(c, 1e-8);  // where x or y is held it is a tangent exactly, the normal as far
                                 // as gmsh's 10 digits go
    double length = 0;
    for (const auto& node : c.nodes) {
      const double r = std::hypot(node.position[0], node.position[1]);
      EXPECT_NEAR(test::dot(node.normal, node.position) / r, 1, 1e-9);
      length += node.area;
    }
    // Perimeter of the polygon; parabolas over an angle θ = 2π/16 fall short of their arcs by
    // θ⁴/960 = 2.5e-5.
    EXPECT_NEAR(length,
                order == 1 ? 32 * 0.08 * std::sin(M_PI / 16) : (1 - 2.48e-5) * 2 * M_PI * 0.08,
                order == 1 ? 1e-10 : 1e-6);
  }
}

TEST(Frame, IsOrthonormalAndRadialOnASphere) {
  for (const int order : {1, 2}) {
    test::setOptions(ballInShell(order));
    const auto c = coupled();
    ASSERT_GT(c.nodes.size(), 20u);
    orthonormalFrames(c, 1e-14);
    double area = 0, least = 1;
    for (const auto& node : c.nodes) {
      least = std::min(least, test::dot(node.normal, node.position));
      area += node.area;
    }
    test::print("sphere, order %d: %d contact nodes, least n·r %.5f, area / 4 pi %.5f\n", order,
                static_cast<int>(c.nodes.size()), least, area / (4 * M_PI));
    EXPECT_GT(least, order == 1 ? 0.95 : 0.995);  // facets of 35 degrees, uneven around a node
    EXPECT_NEAR(area / (4 * M_PI), 1, order == 1 ? 0.12 : 0.01);
    EXPECT_EQ(c.model.contact.weightsPositive, order == 1);  // tri6 corners weigh nothing
  }
}

// Vω = ω k × r, w = −V: τ against the rotation, |w| = |ω| r, for both senses.
TEST(Slip, FollowsTheRotation) {
  for (const double speed : {2.0, -5.0}) {
    test::setOptions(cylinders +
                     "-mesh_set n_inner=2,n_outer=2,n_theta=16,order=2 -motion_inner_speed " +
                     std::to_string(speed));
    const auto c = coupled();
    for (const auto& node : c.nodes) {
      const double r = std::hypot(node.position[0], node.position[1]), sign = speed > 0 ? -1 : 1;
      EXPECT_NEAR(node.slip[0], sign * -node.position[1] / r, 1e-9);
      EXPECT_NEAR(node.slip[1], sign * node.position[0] / r, 1e-9);
      EXPECT_NEAR(node.slipSpeed, std::abs(speed) * r, 1e-9);
    }
    EXPECT_EQ(errorOf([&] { requireSlip(c.model.contact); }), "");
  }
  setLayers();
  for (const auto& node : coupled().nodes) {  // V along +x
    EXPECT_NEAR(node.slip[0], -1, 1e-14);
    EXPECT_NEAR(node.slipSpeed, 1, 1e-14);
  }
}

TEST(Slip, WithoutDirectionIsAnError) {
  test::setOptions(ballInShell(1));  // the poles are on the axis
  auto model = test::buildModel();
  auto message = errorOf([&] { requireSlip(model.contact); });
  EXPECT_TRUE(contains(message, "|w| = 0") && contains(message, "1) of interface 'ring'"))
      << message;
  for (const std::string velocity : {"0,0,0", "0,1,0"}) {  // at rest; along the normal
    test::setCase("two_layers", layers + " -motion_disc_velocity " + velocity);
    model = test::buildModel();
    message = errorOf([&] { requireSlip(model.contact); });
    EXPECT_TRUE(contains(message, "|w| = 0") && contains(message, "-motion_<body>_velocity") &&
                contains(message, "'interface'"))
        << message;
  }
}

}  // namespace
}  // namespace squeal
