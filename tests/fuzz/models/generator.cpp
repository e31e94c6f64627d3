// SPDX-License-Identifier: BSD-2-Clause
/// What a model is made of: a pad on something that moves, and beside or above it, at random, a
/// back plate, a holder and a second pad.
#include <cmath>

#include "fuzz/models/joints.hpp"
#include "fuzz/models/model.hpp"
#include "fuzz/models/study.hpp"
#include "fuzz/random.hpp"

namespace squeal::fuzz {
namespace {

enum class Disc { obstacle, plate, periodic, ring };

std::vector<double> evenCuts(double low, double high, int cells) {
  std::vector<double> cuts;
  for (int i = 0; i <= cells; ++i) cuts.push_back(low + (high - low) * i / cells);
  return cuts;
}

class Generator {
 public:
  Generator(std::uint64_t seed, std::uint64_t attempt) : random_(attempt * 0x2545f4914f6cdd1d + 1) {
    model_.seed = seed;
  }

  Model model() {
    chooseKind();
    makePad();
    makeDisc();
    if (!ring() && random_.chance(0.35)) makeHolder();
    if (random_.chance(0.6)) makePlate();
    if (disc_ != Disc::obstacle && random_.chance(0.3)) makeSecondPad();
    support();
    press();
    addStudy(random_, model_);
    if (random_.chance(0.35)) makeJoints();
    note(std::to_string(model_.mesh.boxes.size()) + " bodies");
    return model_;
  }

 private:
  bool ring() const { return disc_ == Disc::ring; }
  bool plane() const { return model_.mesh.dimension == 2; }
  int up() const { return model_.mesh.up(); }
  void note(const std::string& feature) { model_.note(feature); }
  std::size_t addBox(const std::string& name, Shape shape,
                     const std::array<std::vector<double>, 3>& cuts) {
    model_.mesh.boxes.push_back({name, cuts, shape, false});
    note(text(shape));
    return model_.mesh.boxes.size() - 1;
  }
  /// Returns the name of the group of a whole side, which is made when it is first asked for.
  std::string side(std::size_t box, int axis, bool high, int firstCell = 0, int lastCell = 1000) {
    std::string name = model_.mesh.boxes[box].name + "_" + "xyz"[axis] + (high ? "1" : "0");
    if (firstCell > 0 || lastCell < 1000) name += "_part";
    for (const auto& one : model_.mesh.sides)
      if (one.name == name) return name;
    model_.mesh.sides.push_back({name, box, axis, high, firstCell, lastCell});
    return name;
  }
  std::string top(std::size_t box) { return side(box, up(), true); }
  std::string bottom(std::size_t box) { return side(box, up(), false); }
  Box& box(std::size_t number) { return model_.mesh.boxes[number]; }

  void chooseKind() {
    model_.mesh.dimension = random_.chance(0.3) ? 2 : 3;
    note(plane() ? "plane" : "solid");
    const double kind = random_.fraction();
    disc_ = kind < 0.25              ? Disc::obstacle
            : kind < 0.65            ? Disc::plate
            : kind < 0.85 || plane() ? Disc::periodic
                                     : Disc::ring;
    note(std::vector<std::string>{"obstacle", "plate", "periodic", "ring"}[int(disc_)]);
    model_.mesh.ring = ring();
    if (!ring() && disc_ != Disc::periodic && random_.chance(0.2))
      model_.mesh.skew = random_.uniform(-0.3, 0.3), note("skew");
    shape_ = random_.oneOf(shapesOf(model_.mesh.dimension));
  }

  /// The shape of one more body.
  Shape nextShape() {
    return random_.chance(0.8) ? shape_ : random_.oneOf(shapesOf(model_.mesh.dimension));
  }
  int cells(Shape shape, int axis) {
    const bool linear = orderOf(shape) == 1;
    if (plane())
      return axis == 0 ? random_.between(linear ? 2 : 1, linear ? 5 : 3)
                       : random_.between(1, linear ? 2 : 1);
    if (axis == 0) return random_.between(linear ? 2 : 1, linear ? 3 : 2);
    return random_.chance(linear ? 0.4 : 0.1) ? 2 : 1;
  }
  std::vector<double> flat() const { return {0}; }

  void makePad() {
    const double height = random_.uniform(0.006, 0.015);
    length_ = ring() ? 0 : random_.uniform(0.02, 0.05);
    std::array<std::vector<double>, 3> cuts{flat(), flat(), flat()};
    if (ring()) {
      around_ = random_.between(6, 8);
      const int sector = random_.between(1, 2);
      cuts[0] = evenCuts(0, 2 * M_PI * sector / around_, sector);
      cuts[1] = {0.05, 0.075};
    } else {
      cuts[0] = evenCuts(0, length_, cells(shape_, 0));
      if (!plane()) cuts[1] = evenCuts(0, random_.uniform(0.01, 0.03), cells(shape_, 1));
    }
    cuts[up()] = evenCuts(0, height, cells(shape_, 2));
    pad_ = addBox("pad", shape_, cuts);
  }

  void makeDisc() {
    if (disc_ == Disc::obstacle) return moveObstacle();
    const Shape shape = nextShape();
    auto cuts = box(pad_).cuts;
    cuts[up()] = evenCuts(-random_.uniform(0.006, 0.015), 0, cells(shape, 2));
    if (ring()) {
      cuts[0] = evenCuts(0, 2 * M_PI, around_);
      if (random_.chance(0.3)) cuts[1] = {0.045, 0.0625, 0.08}, note("apart");
    } else {
      if (random_.chance(0.3)) {
        cuts[0] = evenCuts(0, length_, cells(shape, 0) + random_.between(0, 1));
        note("apart");
      }
      const double step = length_ / 2;
      if (disc_ == Disc::periodic || random_.chance(0.6)) {
        cuts[0].insert(cuts[0].begin(), -step);
        cuts[0].push_back(length_ + step * random_.uniform(0.5, 1));
      }
    }
    body_ = addBox("disc", shape, cuts);
    box(body_).closed = ring();
    auto& settings = model_.settings;
    settings.set("contact_main_pad", bottom(pad_));
    settings.set("contact_main_disc", top(body_));
    if (model_.has("apart") && random_.chance(0.3))
      settings.set("contact_main_slave", random_.oneOf<std::string>({"pad", "disc"}));
    if (disc_ == Disc::periodic)
      settings.set("constraint_" + side(body_, 0, true) + "_image_of", side(body_, 0, false));
    moveDisc();
  }

  Vector alongSurface(double size) {
    if (plane()) return {random_.chance(0.5) ? size : -size, 0, 0};
    const double angle = random_.oneOf<double>({0, M_PI / 2, M_PI, 0.6});
    return {std::round(1e6 * size * std::cos(angle)) * 1e-6,
            std::round(1e6 * size * std::sin(angle)) * 1e-6, 0};
  }

  void moveObstacle() {
    model_.settings.set("contact_main_pad", bottom(pad_));
    model_.settings.setVector("contact_main_obstacle_velocity", alongSurface(1));
  }

  void moveDisc() {
    auto& settings = model_.settings;
    const bool carries = (disc_ == Disc::periodic || ring()) && random_.chance(0.5);
    if (carries) settings.set("motion_convective", "on"), note("convective");
    if (disc_ == Disc::periodic)
      return settings.setVector(
          "motion_disc_velocity",
          {random_.logarithmic(0.5, 50) * (random_.chance(0.5) ? 1 : -1), 0, 0});
    const bool turns = ring() || (!plane() && random_.chance(0.3));
    if (!turns)
      return settings.setVector("motion_disc_velocity", alongSurface(random_.uniform(0.5, 5)));
    note("turning");
    settings.set("motion_disc_speed", random_.logarithmic(5, 500) * (random_.chance(0.5) ? 1 : -1));
    settings.setVector("motion_disc_axis", {0, 0, 1});
    settings.setVector("motion_disc_origin",
                       ring() ? Vector{} : Vector{-random_.uniform(0.03, 0.1), 0.01, 0});
    if (random_.chance(0.5)) settings.set("load_centrifugal", "off");
  }

  /// How a body rests on another one: glued to it, or by the role of an interface.
  /// Returns true if it is held along the surface.
  bool join(const std::string& name, std::size_t first, const std::string& firstSide,
            std::size_t second, const std::string& secondSide, bool matching) {
    auto& settings = model_.settings;
    const double kind = random_.fraction();
    if (kind < 0.55) {
      const Bond form = random_.oneOf<Bond>(
          {Bond::slaveIsSecond, Bond::slaveIsFirst, Bond::tiedRole, Bond::welded});
      note("bond");
      if (matching && !model_.glue) {
        model_.glue = Glue{first, second, firstSide, secondSide, form};
        return true;
      }
      const bool swapped = random_.chance(0.5);
      settings.set("tie_" + name + "_slave", swapped ? firstSide : secondSide);
      settings.set("tie_" + name + "_master", swapped ? secondSide : firstSide);
      note("tie apart");
      return true;
    }
    const std::string key = "contact_" + name;
    settings.set(key + "_pad", secondSide);
    settings.set(key + "_disc", firstSide);
    const bool sticks = random_.chance(0.5);
    settings.set(key + "_role", sticks ? "sticking" : "frictionless");
    note(sticks ? "sticking" : "frictionless");
    if (sticks && random_.chance(0.5)) {
      settings.set(key + "_friction", random_.uniform(0.05, 1));
      if (random_.chance(0.6)) settings.set(key + "_release", "on"), note("release");
    }
    return false;
  }

  void makePlate() {
    const Shape shape = nextShape();
    auto cuts = box(pad_).cuts;
    const double bottomOfPlate = cuts[up()].back();
    cuts[up()] = evenCuts(bottomOfPlate, bottomOfPlate + random_.uniform(0.003, 0.008), 1);
    bool matching = shape == shape_;
    if (!ring() && random_.chance(0.3)) {
      cuts[0] = evenCuts(0, length_, cells(shape, 0) + random_.between(0, 1));
      matching = matching && cuts[0] == box(pad_).cuts[0];
    }
    plate_ = addBox("plate", shape, cuts);
    plateIsHeld_ = join("back", pad_, top(pad_), *plate_, bottom(*plate_), matching);
  }

  void makeHolder() {
    const Shape shape = nextShape();
    auto cuts = box(pad_).cuts;
    cuts[0] = evenCuts(length_, length_ + random_.uniform(0.005, 0.02), 1);
    auto& heights = cuts[up()];
    const bool above = heights.size() > 2 && random_.chance(0.7);
    if (above) heights.erase(heights.begin());
    bool matching = shape == shape_;
    if (random_.chance(0.3)) {
      heights = evenCuts(heights.front(), heights.back(), cells(shape, 2) + 1);
      matching = matching && heights.size() == box(pad_).cuts[up()].size() - above;
    }
    holder_ = addBox("holder", shape, cuts);
    padIsHeld_ =
        join("side", *holder_, side(*holder_, 0, false), pad_, side(pad_, 0, true), matching);
    note("holder");
  }

  void makeSecondPad() {
    const Shape shape = nextShape();
    auto cuts = box(pad_).cuts;
    const double below = box(body_).cuts[up()].front();
    cuts[up()] = evenCuts(below - random_.uniform(0.006, 0.015), below, 1);
    second_ = addBox("second", shape, cuts);
    auto& settings = model_.settings;
    settings.set("contact_other_pad", top(*second_));
    settings.set("contact_other_disc", bottom(body_));
    if (random_.chance(0.5))
      settings.set(random_.chance(0.5) ? "contact_other_friction_factor" : "contact_other_friction",
                   random_.uniform(0, 1));
    note("second pad");
  }

  std::string tangents() const { return plane() ? "x" : "xy"; }
  double stiffness() { return random_.logarithmic(3e6, 1e9); }

  /// Holds a body along the surface, on the side `face`.
  void hold(std::size_t number, const std::string& face) {
    auto& settings = model_.settings;
    if (random_.chance(0.35)) {
      settings.setComponents("constraint_" + face + "_clamped", tangents());
      return note("clamp");
    }
    const std::string group = random_.chance(0.7) ? face : box(number).name;
    Vector springs{};
    for (int a = 0; a < up(); ++a) springs[a] = stiffness();
    if (random_.chance(0.3)) springs[up()] = stiffness(), note("normal spring");
    settings.addVector("ground_" + group + "_stiffness", springs);
    note("spring");
  }

  void supportDisc() {
    auto& settings = model_.settings;
    const bool bottomIsFree = !second_;
    const double kind = random_.fraction();
    if (kind < 0.4 && bottomIsFree) {
      settings.setComponents("constraint_" + bottom(body_) + "_clamped", plane() ? "xy" : "xyz");
      return;
    }
    if (kind < 0.6 && disc_ == Disc::plate) {
      for (bool high : {false, true})
        settings.setComponents("constraint_" + side(body_, 0, high) + "_clamped",
                               plane() ? "xy" : "xyz");
      return note("disc held at its ends");
    }
    Vector springs{};
    for (int a = 0; a <= up(); ++a) springs[a] = 10 * stiffness();
    settings.addVector("ground_" + (bottomIsFree ? bottom(body_) : box(body_).name) + "_stiffness",
                       springs);
    note("disc on springs");
  }

  void support() {
    auto& settings = model_.settings;
    if (disc_ != Disc::obstacle) supportDisc();
    if (holder_)
      settings.setComponents("constraint_" + side(*holder_, 0, true) + "_clamped",
                             plane() ? "xy" : "xyz");
    if (plate_) hold(*plate_, top(*plate_));
    if (!plateIsHeld_ && !padIsHeld_) hold(pad_, plate_ ? side(pad_, 0, false) : top(pad_));
    if (second_) hold(*second_, bottom(*second_));
  }

  void press(std::size_t number, const std::string& name, bool high) {
    auto& settings = model_.settings;
    std::string face = side(number, up(), high);
    const int along = box(number).cellsAlong(0);
    const double kind = random_.fraction();
    if (kind < 0.4 && along > 1) {
      face = side(number, up(), high, 0, 1);
      note("local pressure");
    } else if (kind < 0.5 && high && disc_ == Disc::obstacle) {
      Vector displacement{};
      displacement[up()] = random_.logarithmic(1e-6, 1e-5);
      settings.setVector("contact_main_obstacle_displacement", displacement);
      return note("obstacle pressed"), holdNormally(number);
    } else if (kind < 0.55 && high && disc_ != Disc::obstacle) {
      settings.set("contact_" + name + "_gap", -random_.logarithmic(1e-6, 1e-5));
      return note("interference"), holdNormally(number);
    }
    settings.set("load_" + face + "_pressure", random_.logarithmic(1e5, 1e7));
  }

  void holdNormally(std::size_t number) {
    Vector springs{};
    springs[up()] = stiffness();
    model_.settings.addVector("ground_" + box(number).name + "_stiffness", springs);
  }

  void press() {
    press(plate_.value_or(pad_), "main", true);
    if (second_) press(*second_, "other", false);
    if (random_.chance(0.15) && holder_) {
      model_.settings.set("load_" + side(pad_, 0, false) + "_pressure",
                          random_.logarithmic(1e4, 1e6));
      note("pushed sideways");
    }
  }

  /// The last draws, so that all other features of a model stay the same.
  void makeJoints() {
    const std::size_t number = plate_.value_or(pad_);
    JointFaces faces;
    faces.outer = top(number), faces.mayBeRigid = plate_ || !model_.glue;
    if (second_)
      faces.second = bottom(*second_);
    else if (holder_)
      faces.second = side(*holder_, 0, true);
    else if (!ring() && plate_)
      faces.second = side(pad_, 0, false);
    const double height = box(number).cuts[up()].back() + 0.01;
    faces.near = ring() ? Vector{0.06, 0.01, height} : Vector{0.4 * length_, 0.01, height};
    if (plane()) faces.near = {0.4 * length_, height, 0};
    addJoints(faces, random_, model_);
  }

  Random random_;
  Model model_;
  Disc disc_ = Disc::plate;
  Shape shape_ = Shape::hex8;
  double length_ = 0;
  int around_ = 0;  // cells of the ring
  std::size_t pad_ = 0, body_ = 0;
  std::optional<std::size_t> plate_, holder_, second_;
  bool plateIsHeld_ = false, padIsHeld_ = false;
};

}  // namespace

Model modelOf(std::uint64_t seed) {
  constexpr int mostUnknowns = 160, tries = 1000;
  for (int i = 0;; ++i) {
    Generator generator(seed, seed * tries + i);
    Model model = generator.model();
    if (unknownsOf(model.mesh) <= mostUnknowns || i + 1 == tries) return model;
  }
}

}  // namespace squeal::fuzz
