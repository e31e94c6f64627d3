// SPDX-License-Identifier: BSD-2-Clause
#include "fuzz/models/study.hpp"

#include <algorithm>
#include <cmath>

namespace squeal::fuzz {
namespace {

class Study {
 public:
  Study(Random& random, Model& model) : random_(random), model_(model), settings_(model.settings) {}

  void add() {
    for (const auto& box : model_.mesh.boxes) makeMaterial(box.name);
    damp();
    sweep();
    chooseMethod();
  }

 private:
  bool plane() const { return model_.mesh.dimension == 2; }

  void makeMaterial(const std::string& body) {
    const std::string key = "material_" + body;
    settings_.set(key + "_density", random_.uniform(2000, 8000));
    const double young = random_.logarithmic(5e9, 2.1e11);
    if (!plane() && random_.chance(0.1)) {
      settings_.setList(key + "_engineering_constants",
                        {young, 0.8 * young, 0.3 * young, 0.2, 0.25, 0.3, 0.35 * young,
                         0.12 * young, 0.1 * young});
      settings_.setPair(key + "_orientation", {1, 0, 0}, {0, 1, 0});
      return;
    }
    settings_.set(key + "_young", young);
    settings_.set(key + "_poisson", random_.uniform(0, 0.4));
  }

  void damp() {
    if (random_.chance(0.5))
      settings_.set("flutter_friction_damping", "off");
    else
      model_.note("friction damping");
    if (random_.chance(0.45)) {
      model_.note("damped");
      for (const auto& box : model_.mesh.boxes) {
        const std::string key = "material_" + box.name;
        const double kind = random_.fraction();
        if (kind < 0.4)
          settings_.set(key + "_rayleigh_stiffness", random_.logarithmic(1e-9, 3e-7));
        else if (kind < 0.6)
          settings_.set(key + "_rayleigh_mass", random_.logarithmic(10, 3000));
        else if (kind < 0.75) {
          settings_.set(key + "_loss_factor", random_.uniform(0.001, 0.05));
          settings_.set(key + "_loss_frequency", 20000.0);
        }
      }
    }
    if (random_.chance(0.08)) {
      settings_.setList("flutter_modal_damping", {0.001, 0.005, 0.01});
      model_.modalDamping = true;
      model_.note("modal damping");
    }
    if (random_.chance(0.15)) {
      settings_.set("friction_law", "exponential");
      settings_.set("friction_static_ratio", random_.uniform(1, 1.5));
      settings_.set("friction_decay_speed", random_.uniform(0.5, 5));
      model_.note("friction law");
    }
  }

  void sweep() {
    const int count = random_.between(2, 5);
    const double last = random_.uniform(0.2, 0.9);
    double first = random_.chance(0.7) ? 0 : random_.uniform(0.02, 0.15);
    for (int i = 0; i < count; ++i)
      model_.frictions.push_back(std::round(1e4 * (first + (last - first) * i / (count - 1))) /
                                 1e4);
    settings_.setList("flutter_friction", model_.frictions);
    if (random_.chance(0.08)) settings_.setList("flutter_speed", {1, 3}), model_.note("speeds");
    if (random_.chance(0.08))
      settings_.setList("flutter_pressure", {0.5, 2}), model_.note("pressures");
    if (model_.has("damped") && random_.chance(0.2))
      settings_.setList("flutter_damping", {0, 1}), model_.note("dampings");
  }

  void chooseMethod() {
    settings_.set("modes_count",
                  random_.between(4, std::clamp(unknownsOf(model_.mesh) / 3, 6, 40)));
    if (random_.chance(0.25))
      settings_.set("flutter_band", std::round(random_.logarithmic(2e4, 2e5))), model_.note("band");
    if (random_.chance(0.1)) settings_.set("elasticity_prestress", "on"), model_.note("prestress");
    if (random_.chance(0.15)) settings_.set("elasticity_mass", "higher_order");
    if (random_.chance(0.3)) settings_.set("elasticity_incompatible_modes", "none");
    if (plane() && random_.chance(0.3)) settings_.set("elasticity_plane", "stress");
    if (random_.chance(0.3)) settings_.set("flutter_track", "on");
    settings_.set("steady_uniqueness", random_.chance(0.1) ? "on" : "off");
  }

  Random& random_;
  Model& model_;
  Settings& settings_;
};

}  // namespace

int unknownsOf(const BoxMesh& mesh) {
  int count = 0;
  for (const auto& box : mesh.boxes) {
    int nodes = mesh.dimension;
    for (int a = 0; a < mesh.dimension; ++a) nodes *= orderOf(box.shape) * box.cellsAlong(a) + 1;
    count += nodes;
  }
  return count;
}

void addStudy(Random& random, Model& model) { Study(random, model).add(); }

}  // namespace squeal::fuzz
