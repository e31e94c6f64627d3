// SPDX-License-Identifier: BSD-2-Clause
#include "fuzz/models/outcome.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "base/petsc/arrays.hpp"
#include "base/petsc/check.hpp"

namespace squeal::fuzz {
namespace {

using nlohmann::json;

double length(const mesh::Point& x) { return std::hypot(x[0], x[1], x[2]); }

/// Collective. The largest or the smallest diagonal entry at nodes of cells; reference nodes may
/// have no mass.
double largestDiagonal(const mesh::Mesh& mesh, Mat matrix, bool smallest) {
  const OwnedVec diagonal = elasticity::nodalVector(mesh);
  check(MatGetDiagonal(matrix, diagonal));
  double found = smallest ? INFINITY : 0;
  const ReadArray values(diagonal);
  for (PetscInt node = 0; node < mesh.ownedNodes; ++node)
    for (int d = 0; d < mesh.dimension && !mesh.referenceWith(mesh.firstNode + node); ++d) {
      const double value = values[mesh.dimension * node + d];
      found = smallest ? std::min(found, value) : std::max(found, value);
    }
  return smallest ? mpi::min(mesh.comm, found) : mpi::max(mesh.comm, found);
}

std::vector<FoundPoint> pointsOf(const analysis::Analysis& analysis) {
  std::vector<FoundPoint> points;
  for (const auto& segment : analysis.flutter.segments)
    for (const auto& point : segment.points) {
      FoundPoint found{point.at, point.bandTop, {}};
      if (point.directBandTop > 0) found.top = point.coveredTo;
      for (const auto& e : point.eigenvalues)
        found.eigenvalues.push_back(
            {e.s, e.errorEstimate(), e.backwardError, e.verdict, e.unstable});
      points.push_back(std::move(found));
    }
  return points;
}

std::vector<FoundSteady> steadyOf(const analysis::Analysis& analysis) {
  std::vector<FoundSteady> all;
  for (const auto& solution : analysis.steady.solutions) {
    FoundSteady found{solution.at,
                      solution.converged,
                      solution.openNodes,
                      0,
                      solution.imbalance,
                      solution.nodesOfAnother == 0,
                      {},
                      {}};
    for (const auto& resultant : solution.resultants) {
      found.released += resultant.released;
      found.interfaces.push_back(resultant.interface);
      found.forces.push_back(length(resultant.normalForce));
      found.forces.push_back(length(resultant.frictionForce));
    }
    all.push_back(std::move(found));
  }
  return all;
}

std::string numberText(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

json numbers(std::initializer_list<double> values) {
  json list = json::array();
  for (double value : values) list.push_back(numberText(value));
  return list;
}

double number(const json& value) { return std::strtod(value.get<std::string>().c_str(), nullptr); }

json of(const sweep::Parameters& at) {
  return numbers({at.friction, at.speed, at.pressure, at.damping});
}

sweep::Parameters parameters(const json& list) {
  return {number(list[0]), number(list[1]), number(list[2]), number(list[3])};
}

}  // namespace

Outcome outcomeOf(const analysis::Analysis& analysis) {
  Outcome outcome;
  outcome.failures = analysis.flutter.failures;
  outcome.points = pointsOf(analysis);
  outcome.steady = steadyOf(analysis);
  outcome.stiffest =
      std::sqrt(largestDiagonal(*analysis.model.mesh, analysis.model.bodies.stiffness, false) /
                largestDiagonal(*analysis.model.mesh, analysis.model.bodies.mass, true));
  const auto& interfaces = analysis.model.contact.interfaces;
  for (std::size_t i = 0; i < interfaces.reports.size(); ++i)
    if (interfaces.options[i].isTied()) outcome.lost += interfaces.reports[i].loss.nodes;
  bool gaps = false, any = false;
  for (const auto& segment : analysis.flutter.segments)
    for (const auto& followed : segment.trackedLines) {
      any = true;
      gaps = gaps || !followed.complete();
      for (const auto& critical : followed.criticals) {
        sweep::Parameters at = followed.line;
        at.friction = critical.friction;
        outcome.criticals.push_back({at, critical.errorEstimate, critical.angularFrequency,
                                     critical.slope, static_cast<int>(critical.kind), critical.loss,
                                     critical.converged});
      }
    }
  outcome.followed = any && !gaps;
  return outcome;
}

json toJson(const Outcome& outcome) {
  json points = json::array(), steady = json::array(), criticals = json::array();
  for (const auto& point : outcome.points) {
    json eigenvalues = json::array();
    for (const auto& e : point.eigenvalues)
      eigenvalues.push_back(numbers({e.s.real(), e.s.imag(), e.estimate, e.backwardError,
                                     double(e.verdict), double(e.unstable)}));
    points.push_back({of(point.at), numberText(point.top), eigenvalues});
  }
  for (const auto& one : outcome.steady) {
    json forces = json::array();
    for (double force : one.forces) forces.push_back(numberText(force));
    steady.push_back({of(one.at), one.converged, one.open, one.released, numberText(one.imbalance),
                      one.unique, one.interfaces, forces});
  }
  for (const auto& c : outcome.criticals)
    criticals.push_back({of(c.at), numbers({c.error, c.angularFrequency, c.slope, double(c.kind),
                                            double(c.loss), double(c.converged)})});
  return {{"refusal", outcome.refusal},
          {"stiffest", numberText(outcome.stiffest)},
          {"points", points},
          {"steady", steady},
          {"criticals", criticals},
          {"lost", outcome.lost},
          {"followed", outcome.followed},
          {"failures", outcome.failures}};
}

Outcome fromJson(const json& all) {
  Outcome outcome;
  outcome.refusal = all["refusal"];
  outcome.stiffest = number(all["stiffest"]);
  outcome.lost = all["lost"];
  outcome.followed = all["followed"];
  outcome.failures = all["failures"].get<std::vector<std::string>>();
  for (const auto& point : all["points"]) {
    FoundPoint found{parameters(point[0]), number(point[1]), {}};
    for (const auto& e : point[2])
      found.eigenvalues.push_back({{number(e[0]), number(e[1])},
                                   number(e[2]),
                                   number(e[3]),
                                   pencil::Verdict(int(number(e[4]))),
                                   number(e[5]) > 0});
    outcome.points.push_back(std::move(found));
  }
  for (const auto& one : all["steady"]) {
    FoundSteady found{parameters(one[0]), one[1], one[2], one[3],
                      number(one[4]),     one[5], one[6], {}};
    for (const auto& force : one[7]) found.forces.push_back(number(force));
    outcome.steady.push_back(std::move(found));
  }
  for (const auto& c : all["criticals"])
    outcome.criticals.push_back({parameters(c[0]), number(c[1][0]), number(c[1][1]),
                                 number(c[1][2]), int(number(c[1][3])), number(c[1][4]) > 0,
                                 number(c[1][5]) > 0});
  return outcome;
}

}  // namespace squeal::fuzz
