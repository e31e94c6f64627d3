// SPDX-License-Identifier: BSD-2-Clause
// The visible surface in prescribed motions.
#include "regime/sound/visible_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/petsc/arrays.hpp"
#include "regime/regime/regime.hpp"
#include "support/model/model.hpp"

namespace squeal {
namespace {

using mesh::Point;
using test::nodalField;

const std::string box =
    "-mesh_file meshes/beam.geo -mesh_set Lx=2,Ly=0.3,Lz=0.5,nx=4,ny=2,nz=2,order=2" +
    test::material("beam", "1", "0.3", "1") + "-constraint_clamped_clamped xyz ";

/// A box whose modes are the uniform motion along x, and the motion x along y; its response is the
/// uniform motion along z.
struct Box {
  test::Model model;
  linalg::Block modes, responses;
  std::vector<PetscInt> contactNode;
  explicit Box(const std::string& options = {}) {
    test::setOptions(box + options);
    model = test::buildModel();
    append(modes, [](const Point&) { return Point{1, 0, 0}; });
    append(modes, [](const Point& x) { return Point{0, x[0], 0}; });
    append(responses, [](const Point&) { return Point{0, 0, 1}; });
  }
  sound::Observer observer() const {
    return {model.contact, {modes, responses, contactNode}, sound::Settings::given()};
  }
  template <class Field>
  void append(linalg::Block& block, const Field& field) {
    const OwnedVec u = nodalField(*model.mesh, field);
    const ReadArray values(u);
    block.append(linalg::DenseView(values.data(), values.size(), 1));
  }
};

constexpr int samples = 640, cycles = 20;  // whole cycles: amplitudes are exact in a line
constexpr double atFirst = 0.3, atSecond = 0.2;

/// Velocities a cos ωt of the first and b sin ωt of the second mode, only on the last rank.
sound::Trace traceOf(int& root) {
  int rank = 0, size = 1;
  check(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  check(MPI_Comm_size(PETSC_COMM_WORLD, &size));
  root = size - 1;
  sound::Trace trace;
  if (rank != root) return trace;
  trace.velocities = linalg::DenseMatrix(samples, 2);
  for (int i = 0; i < samples; ++i) {
    const double phase = 2 * M_PI * cycles * i / samples;
    trace.velocities(i, 0) = atFirst * std::cos(phase);
    trace.velocities(i, 1) = atSecond * std::sin(phase);
  }
  for (const double time : {1.0, 2.0}) trace.samples.push_back({time, {time, 3}, {5}, {}, {}});
  return trace;
}

// ∫ ⟨v_n²⟩ dA = a²/2 · Ly Lz of the tip + b²/2 · 2 Lz L³/3 of the sides.
TEST(Sound, OfTwoModes) {
  const Box made("-regime_air_impedance 400");
  int root = 0;
  const auto trace = traceOf(root);
  const auto sound = made.observer().of(root, trace).sound;
  const double integral =
                   atFirst * atFirst / 2 * 0.3 * 0.5 + atSecond * atSecond / 2 * 2 * 0.5 * 8 / 3.0,
               area = 0.3 * 0.5 + 2 * 2 * (0.3 + 0.5);
  EXPECT_NEAR(sound.area, area, 1e-12);
  EXPECT_NEAR(sound.meanSquareVelocity, integral / area, 1e-12);
  EXPECT_NEAR(sound.power, 400 * integral, 1e-10);
  EXPECT_NEAR(sound.level, 120 + 10 * std::log10(400 * integral), 1e-9);
}

TEST(Sound, OfNoSamplesIsUnknown) {
  const Box made;
  const auto seen = made.observer().of(0, sound::Trace());
  EXPECT_TRUE(std::isnan(seen.sound.power) && std::isnan(seen.sound.level));
  EXPECT_EQ(seen.points.at(0).amplitude.size(), 0u);
  EXPECT_EQ(seen.frames.time.size(), 0u);
}

// A body that is clamped all round is silent, and has no spectrum at a point.
TEST(Sound, OfNothingVisible) {
  const Box made(
      "-constraint_tip_clamped xyz -constraint_right_clamped xyz -constraint_left_clamped xyz "
      "-constraint_top_clamped xyz -constraint_bottom_clamped xyz");
  int root = 0;
  const auto trace = traceOf(root);
  const auto seen = made.observer().of(root, trace);
  EXPECT_EQ(seen.sound.area, 0);
  EXPECT_TRUE(std::isnan(seen.sound.power));
  EXPECT_EQ(seen.points.size(), 0u);
}

// The tip moves most, by a²/2 + (b L)²/2; of its nodes, alike, the first by its coordinates counts.
TEST(Spectrum, AtTheNodeThatMovesMost) {
  const Box made;
  int root = 0;
  const auto trace = traceOf(root);
  const auto seen = made.observer().of(root, trace);
  ASSERT_EQ(seen.points.size(), 1u);
  const auto& point = seen.points[0];
  EXPECT_EQ(point.name, "largest");
  const Point corner{2, -0.15, -0.25};
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(point.position[d], corner[d], 1e-12);
  EXPECT_NEAR(point.meanSquareVelocity, atFirst * atFirst / 2 + 4 * atSecond * atSecond / 2, 1e-12);
  ASSERT_EQ(point.amplitude.size(), std::size_t(samples / 2 + 1));
  EXPECT_NEAR(point.amplitude[cycles][0], atFirst, 1e-12);
  EXPECT_NEAR(point.amplitude[cycles][1], 2 * atSecond, 1e-12);
  EXPECT_NEAR(point.amplitude[cycles][2], 0, 1e-12);
  // Hann's window has half of it in the lines beside, none farther.
  EXPECT_NEAR(point.amplitude[cycles + 1][0], atFirst / 2, 1e-12);
  EXPECT_NEAR(point.amplitude[cycles + 2][0], 0, 1e-12);
}

// The middle of the tip has the normal x; in the middle of a side at x = 1 the normal is −y.
TEST(Spectrum, AtPointsAskedFor) {
  const Box made("-regime_spectrum_points '2.1,0.01,0; 1.02, -0.4, 0'");
  int root = 0;
  const auto trace = traceOf(root);
  const auto points = made.observer().of(root, trace).points;
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[1].name, "2");
  EXPECT_NEAR(points[0].position[0], 2, 1e-12);
  EXPECT_NEAR(points[0].normal[0], 1, 1e-12);
  EXPECT_NEAR(points[0].amplitude[cycles][3], atFirst, 1e-12);
  EXPECT_NEAR(points[1].position[0], 1, 1e-9);
  EXPECT_NEAR(points[1].normal[1], -1, 1e-12);
  EXPECT_NEAR(points[1].amplitude[cycles][3], atSecond, 1e-9);
}

std::string refusal(const std::string& options) {
  test::setOptions(options);
  return test::errorOf([] {
    const auto terms = terms::Settings::given();
    regime::checkOptions(regime::Settings::given(), pencil::Settings::given(), &terms);
  });
}

TEST(Options, PointsThatAreNone) {
  for (const std::string points : {"1", "1,2,x", "1,2,3,4", "1,2,3;", "1,,3", "1,inf,2"})
    EXPECT_TRUE(test::contains(
        refusal("-regime_friction 0.4 -regime_spectrum_points '" + points + "'"), "is not a point"))
        << points;
  EXPECT_EQ(refusal("-regime_friction 0.4 -regime_spectrum_points '1,2,3; 4,-5e-1'"), "");
}

TEST(Options, IdleOnesAreRefusedByName) {
  for (const std::string option :
       {"-regime_cycles_kept 3", "-regime_frames 8", "-regime_air_impedance 400",
        "-regime_spectrum_points 0,0,0", "-regime_time 1"})
    EXPECT_TRUE(test::contains(refusal(option), "option " + option.substr(0, option.find(' ')) +
                                                    ": no motion after flutter"))
        << option;
  EXPECT_TRUE(test::contains(refusal("-regime_friction 0.4 -regime_frames 8 -regime_cycles_kept 0"),
                             "option -regime_frames: no period is stored"));
}

// u = V q + Ψ z: q = (t, 3) and z = 5 give (t, 3 x, 5).
TEST(Frames, AreDisplacements) {
  const Box made;
  int root = 0;
  const auto trace = traceOf(root);
  const auto frames = made.observer().of(root, trace).frames;
  ASSERT_EQ(frames.time, (std::vector<double>{1, 2}));
  for (int k = 0; k < 2; ++k) {
    const OwnedVec exact = nodalField(*made.model.mesh, [&](const Point& x) {
      return Point{k + 1.0, 3 * x[0], 5};
    });
    const ReadArray values(exact);
    for (PetscInt i = 0; i < values.size(); ++i)
      EXPECT_NEAR(frames.displacement(i, k), values[i], 1e-12);
  }
}

/// A motion with q = t and the jump 2 + 3 t of a node that is open.
class ByHand : public march::Scheme {
 public:
  explicit ByHand(const march::ReducedModel& model, double step) : Scheme(model), step_(step) {
    set();
  }
  void step() override {
    state_.time += step_;
    set();
  }
  double energy() const override { return 0; }

 private:
  void set() {
    state_.q = {state_.time}, state_.jump = {2 + 3 * state_.time, 0}, state_.force = {7, 0};
  }
  double step_;
};

// Periods of 1, 16 frames each, two periods at most: 33 samples, of which the last is the latest.
TEST(RecentHistory, KeepsTheLatestPeriods) {
  test::setOptions("");
  march::ReducedModel model;
  model.dimension = 2;
  model.nodes.resize(1);
  model.nodes[0].gap = 0.5;
  model.stiffness = {1};
  model.jump = linalg::DenseMatrix(2, 1);
  model.jump(0, 0) = 3;
  model.moves = {1, 0};
  for (const auto& [periods, expected] : {std::pair{10, 33}, {1, 1}, {0, 0}}) {
    ByHand motion(model, 1.0 / 128);
    sound::RecentHistory history(model, sound::Settings::given(), 1, 1.0 / 128);
    for (int i = 0; i < 128 * periods; ++i) motion.step(), history.inspect(motion);
    const auto samples = history.samples();
    ASSERT_EQ(samples.size(), std::size_t(expected));
    for (std::size_t i = 0; i < samples.size(); ++i) {
      EXPECT_NEAR(samples[i].time, periods - (samples.size() - 1.0 - i) / 16, 1e-12);
      EXPECT_NEAR(samples[i].z[0], 2, 1e-12);  // y − j q
      EXPECT_EQ(samples[i].z[1], 0);
      EXPECT_NEAR(samples[i].gap[0], 2.5 + 3 * samples[i].time, 1e-12);
      EXPECT_EQ(samples[i].force[0], 7);
    }
  }
}

}  // namespace
}  // namespace squeal
