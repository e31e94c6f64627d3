// SPDX-License-Identifier: BSD-2-Clause
#include "fuzz/models/joints.hpp"

#include <cmath>

namespace squeal::fuzz {
namespace {

/// Adds the joints of one model.
class Joints {
 public:
  Joints(const JointFaces& faces, Random& random, Model& model)
      : faces_(faces), random_(random), model_(model), settings_(model.settings) {}

  void add() {
    note("joints");
    addReference("r", faces_.outer, faces_.mayBeRigid && random_.chance(0.5));
    if (random_.chance(0.5))
      settings_.setVector("reference_r_position", faces_.near);
    else
      settings_.set("reference_r_centre_of", faces_.outer);
    addBushing("b", "r", "");
    if (random_.chance(0.5)) addMass();
    if (random_.chance(0.4)) addForce();
    if (faces_.second && random_.chance(0.6)) {
      addReference("t", *faces_.second, false);
      settings_.set("reference_t_centre_of", *faces_.second);
      connect();
    }
  }

 private:
  bool plane() const { return model_.mesh.dimension == 2; }
  void note(const std::string& feature) { model_.note(feature); }

  void addReference(const std::string& name, const std::string& face, bool isRigid) {
    const std::string key = "coupling_" + name;
    settings_.set(key + "_reference", name);
    settings_.set(key + "_nodes", face);
    settings_.set(key + "_kind", isRigid ? "rigid" : "distributed");
    note(isRigid ? "rigid coupling" : "distributed coupling");
  }

  /// Sets stiffness or damping along and about the axes, which may be those of a frame.
  void setSix(const std::string& name, double along, double about, bool inFrame) {
    const auto vary = [&](double size) { return size * random_.uniform(0.3, 1); };
    const Vector first{vary(along), vary(along), plane() ? vary(about) : vary(along)};
    if (plane()) return settings_.setVector(name, first);
    const Vector second{vary(about), vary(about), vary(about)};
    if (inFrame)  // the axes of the frame turn with the model
      settings_.setList(name, {first[0], first[1], first[2], second[0], second[1], second[2]});
    else
      settings_.setPair(name, first, second);
  }

  void addBushing(const std::string& name, const std::string& from, const std::string& to) {
    const std::string key = "bushing_" + name;
    settings_.set(key + "_from", from);
    if (!to.empty()) settings_.set(key + "_to", to);
    const bool inFrame = random_.chance(0.3);
    const double stiffness = random_.logarithmic(1e6, 1e9);
    setSix(key + "_stiffness", stiffness, 1e-4 * stiffness, inFrame);
    if (model_.has("damped") && random_.chance(0.5))
      setSix(key + "_damping", 1e-5 * stiffness, 1e-9 * stiffness, inFrame);
    if (inFrame) {
      settings_.setVector("frame_" + name + "_x", {0.6, plane() ? 0.8 : 0.3, plane() ? 0 : 0.7});
      settings_.setVector("frame_" + name + "_xy", {-0.8, 0.6, 0});
      settings_.set(key + "_frame", name);
      note("frame");
    }
    note("bushing");
  }

  void addMass() {
    const double mass = random_.logarithmic(0.01, 1), square = 1e-4 * mass;
    settings_.set("mass_r_total", mass);
    if (plane())
      settings_.set("mass_r_inertia", square);
    else
      settings_.setPair("mass_r_inertia", {square, 1.2 * square, 1.5 * square}, {});
    note("mass");
  }

  void addForce() {
    const double force = random_.logarithmic(1, 100);
    settings_.setVector("load_r_force",
                        {0.3 * force, plane() ? -force : 0.2 * force, plane() ? 0 : -force});
    if (random_.chance(0.5)) settings_.setVector("load_r_moment", {0, 0, 1e-3 * force});
    if (random_.chance(0.3)) settings_.set("load_r_hydraulic", "off");
    note("force");
  }

  void connect() {
    const double kind = random_.fraction();
    if (kind < 0.4) return addBushing("c", "r", "t");
    if (kind < 0.7) {
      settings_.set("spring_s_from", "r");
      settings_.set("spring_s_to", "t");
      settings_.set("spring_s_stiffness", random_.logarithmic(1e6, 1e9));
      return note("spring between nodes");
    }
    settings_.setEquation(
        "equation_e", random_.chance(0.5) ? "r:x - t:x = 0" : "2*r:x + 0.5*t:y - 0.01*r:rz = 0");
    note("equation");
  }

  const JointFaces& faces_;
  Random& random_;
  Model& model_;
  Settings& settings_;
};

}  // namespace

void addJoints(const JointFaces& faces, Random& random, Model& model) {
  Joints(faces, random, model).add();
}

}  // namespace squeal::fuzz
