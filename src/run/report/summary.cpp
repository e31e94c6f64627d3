// SPDX-License-Identifier: BSD-2-Clause
#include "run/report/summary.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/options/options.hpp"
#include "base/session/session.hpp"
#include "base/session/stages.hpp"
#include "base/system/mpi.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/settings.hpp"
#include "eigen/sweep/parameters.hpp"
#include "run/analysis/contact_path.hpp"
#include "run/analysis/inventory.hpp"
#include "run/report/judgement.hpp"
#include "run/report/proofs.hpp"
#include "run/report/report.hpp"
#include "run/report/table_shapes.hpp"
#include "run/report/verdict.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::report {
namespace {

using Json = nlohmann::ordered_json;

Json point3(const mesh::Point& p) { return Json::array({p[0], p[1], p[2]}); }

Json parametersEntry(const sweep::Parameters& at) {
  Json entry;
  for (const auto& parameter : sweep::allParameters) entry[parameter.name] = at.*parameter.value;
  return entry;
}

Json steadyEntry(const steady::Solution& solution) {
  Json entry;
  entry["snes_reason"] = solution.reason;
  entry["converged"] = solution.converged;
  entry["iterations"] = solution.iterations;
  if (solution.existsTo) entry["exists_up_to"] = parametersEntry(*solution.existsTo);
  if (!solution.converged) return entry;  // the point where SNES stopped has no meaning
  entry["open_nodes"] = solution.openNodes;
  entry["smallest_pressure_pa"] = solution.smallestPressure;
  entry["relative_residual"] = solution.residual;
  entry["relative_imbalance"] = solution.imbalance;
  if (solution.nodesOfAnother > 0) entry["nodes_of_another_solution"] = solution.nodesOfAnother;
  for (const auto& resultant : solution.resultants)
    entry["interfaces"][resultant.interface] = {
        {"normal_force_n", point3(resultant.normalForce)},
        {"friction_force_n", point3(resultant.frictionForce)},
        {"moment_nm", point3(resultant.moment)},
        {"moment_defect_nm", resultant.momentDefect}};
  for (const auto& resultant : solution.resultants) {
    auto& found = entry["interfaces"][resultant.interface];
    if (resultant.leastFriction > 0) {
      found["least_sufficient_friction"] = resultant.leastFriction;
      found["least_sufficient_friction_at_m"] = point3(resultant.worst);
    }
    if (resultant.unheld > 0) found["nodes_unheld"] = resultant.unheld;
    if (!resultant.stickingLimit) continue;
    found["friction"] = *resultant.stickingLimit;
    found["nodes_beyond_friction"] = resultant.overLimit;
    if (resultant.pulled > 0) found["nodes_stuck_under_tension"] = resultant.pulled;
    found["nodes_released"] = resultant.released;
  }
  if (solution.revisions > 0) entry["revisions_of_sticking"] = solution.revisions;
  return entry;
}

/// Returns the reports on the interfaces of a mesh, by name.
Json interfaceEntries(const contact::Contact& contact) {
  Json entries;
  for (std::size_t i = 0; i < contact.interfaces.options.size(); ++i) {
    const auto& report = contact.interfaces.reports[i];
    Json entry = {{"role", interfaces::text(contact.interfaces.options[i].role)},
                  {"nodes", report.nodes},
                  {"slave", contact.interfaces.slaves[i].surface},
                  {"slave_is", contact.interfaces.slaves[i].sign > 0 ? "pad" : "disc"},
                  {"coupling", contact.interfaces.options[i].onObstacle() ? "rigid obstacle"
                               : report.matching                          ? "node on node"
                                                                          : "mortar"}};
    const auto& options = contact.interfaces.options[i];
    if (options.layerStiffness > 0) entry["stiffness_n_per_m3"] = options.layerStiffness;
    if (options.layerTangentialStiffness > 0)
      entry["tangential_stiffness_n_per_m3"] = options.layerTangentialStiffness;
    if (!options.separates) entry["separation"] = "off";
    if (!report.matching) {
      entry["why_not_node_on_node"] = report.whyNot;
      entry["slave_faces"] = report.slave.faces, entry["master_faces"] = report.master.faces;
      entry["slave_area_m2"] = report.slave.area, entry["covered_area_m2"] = report.coveredArea;
      entry["master_area_near_m2"] = report.master.nearArea;
      entry["largest_gap_m"] = report.largestGap;
      entry["nodes_without_condition"] = report.dropped;
    }
    if (contact.interfaces.options[i].isTied()) {
      entry["slave_area_m2"] = report.slave.area, entry["tied_area_m2"] = report.coveredArea;
      entry["tied_nodes"] = report.nodes, entry["untied_nodes"] = report.untied;
      entry["adjusted"] = contact.interfaces.options[i].adjust;
      entry["largest_adjustment_m"] = report.largestAdjustment;
    }
    entries[contact.interfaces.options[i].label()] = entry;
  }
  return entries;
}

/// Returns the number, or null for NaN and infinity, which JSON does not support.
Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json uniquenessEntry(double speed, const uniqueness::Uniqueness& found) {
  Json entry = {{"speed", speed},
                {"positive_definite_up_to_friction",
                 std::isinf(found.lostAt) ? Json("any") : finite(found.lostAt)}};
  for (const auto& judgement : found.judgements)
    entry["frictions"].push_back({{"friction", judgement.friction},
                                  {"steady_state", judgement.verdict},
                                  {"reason", judgement.reason},
                                  {"smallest_eigenvalue_m_per_n", finite(judgement.smallest)}});
  return entry;
}

Json unstableModes(const pencil::ComplexModes& point) {
  Json list = Json::array();
  for (std::size_t i = 0; i < point.eigenvalues.size(); ++i) {
    const auto& e = point.eigenvalues[i];
    if (e.unstable)
      list.push_back({{"mode", i + 1},
                      {"frequency_hz", e.s.imag() / (2 * M_PI)},
                      {"growth_rate_1_per_s", e.s.real()},
                      {"backward_error", e.backwardError},
                      {"error_estimate", finite(e.errorEstimate())},
                      {"certified", e.certified},
                      {"verdict", text(e.verdict)}});
  }
  return list;
}

Json trackedLineEntry(const stability::TrackedLine& tracked) {
  Json entry = {{"speed", tracked.line.speed},       {"pressure", tracked.line.pressure},
                {"damping", tracked.line.damping},   {"branches", tracked.branches.count},
                {"complete", tracked.complete()},    {"sturm_count_exact", tracked.countExact},
                {"whole_space", tracked.wholeSpace}, {"entered", tracked.branches.entered},
                {"left", tracked.branches.left},     {"statement", tracked.statement()}};
  entry["uncertain"] = Json::array();
  for (const auto& gap : tracked.branches.gaps)
    entry["uncertain"].push_back({{"from_friction", gap.from},
                                  {"to_friction", gap.to},
                                  {"what", gap.reason},
                                  {"identity_only", gap.identityOnly}});
  entry["active_sets"] = tracked.activeSet;  // along the path; 0: not that of a point
  entry["critical_frictions"] = Json::array();
  for (const auto& critical : tracked.criticals) {
    if (critical.converged)
      entry["critical_frictions"].push_back(critical.friction);
    else
      entry["critical_frictions_between"].push_back(
          {critical.friction - critical.errorEstimate, critical.friction + critical.errorEstimate});
  }
  return entry;
}

Json regimeEntry(const regime::Study& study, const regime::Run& run) {
  const regime::Regime& regime = run.regime;
  // A march without measurements has no figures.
  const auto measured = [&](double value) { return regime.measured() ? finite(value) : Json(); };
  Json entry = parametersEntry(study.at);
  entry["start"] = run.start;
  entry["class"] = text(regime.kind);
  entry["failure"] = run.failure.empty() ? Json() : Json(run.failure);
  entry["settled"] = regime.settled;
  entry["carrier_hz"] = regime.carrier > 0 ? measured(regime.carrier) : Json();
  entry["flutter_frequency_hz"] = run.s.imag() / (2 * M_PI);
  entry["modulation_hz"] = regime.modulation > 0 ? measured(regime.modulation) : Json();
  entry["growth_rate_1_per_s"] = measured(regime.growth);
  entry["certified_growth_rate_1_per_s"] = run.s.real();
  entry["friction_coefficient"] = measured(regime.means.frictionCoefficient);
  entry["friction_power_w"] = measured(regime.means.frictionPower);
  entry["steady_friction_power_w"] = finite(study.steadyPower);
  entry["open_nodes"] = measured(regime.means.open);
  entry["sticking_nodes"] = measured(regime.means.sticking);
  entry["largest_kinetic_energy_j"] = measured(regime.largestKinetic);
  entry["sound_power_estimate_w"] = finite(run.surface.sound.power);
  entry["sound_power_level_db"] = finite(run.surface.sound.level);
  entry["largest_defect"] = measured(regime.largestDefect);
  entry["model_error"] = finite(study.modelError);
  entry["modes"] = study.modes > 0 ? Json(study.modes) : Json();
  entry["gaps_and_slips"] = study.rows > 0 ? Json(study.rows) : Json();
  entry["step_s"] = finite(run.step);
  return entry;
}

Json meshEntry(const mesh::Mesh& mesh, const contact::Contact& contact) {
  Json entry = {{"nodes", mesh.cellNodes()}, {"cells", mesh.totalCells}};
  if (const auto& done = mesh.straightened; done.nodes > 0)
    entry["straightened"] = {{"folded_cells", done.folded},
                             {"cells", done.cells},
                             {"nodes", done.nodes},
                             {"rounds", done.rounds},
                             {"largest_move_m", done.largestMove}};
  entry["contact_nodes"] = contact.interfaces.totalNodes;
  entry["interfaces"] = interfaceEntries(contact);
  return entry;
}

void addComplexModes(Json& entry, const pencil::ComplexModes& point) {
  entry["eigenvalues"] = point.eigenvalues.size();
  entry["worst_backward_error"] = point.worstBackwardError();
  if (point.coveredTo > 0 && std::isfinite(point.coveredTo))
    entry["covered_to_hz"] = point.coveredTo / (2 * M_PI);
  if (point.bandTop > 0) {
    entry["band_top_hz"] = finite(point.bandTop / (2 * M_PI));  // null: all eigenvalues
    entry["free_modes_without_eigenvalue"] = point.modesWithoutEigenvalue();
    entry["accuracy_asked"] = point.accuracy;
    entry["tolerance_asked"] = point.tolerance;
    entry["worst_error_estimate"] = finite(point.worstErrorEstimate());
    entry["uncertified"] = point.uncertifiedCount();
  }
  if (point.completeness) entry["proof"] = proofEntry(point);
  entry["unstable_modes"] = unstableModes(point);
  entry["verdict"] = text(point.verdict());
  for (const auto verdict : pencil::allVerdicts)
    entry["verdicts"][text(verdict)] = point.count(verdict);
}

Json pointEntries(const analysis::Analysis& analysis) {
  Json entries = Json::array();
  const auto points = analysis.sweep.points();
  const std::size_t steadyPoints = analysis.sweep.steadyPoints().size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    Json entry = parametersEntry(points[i]);
    if (i % steadyPoints < analysis.steady.solutions.size())
      entry["steady"] = steadyEntry(analysis.steady.solutions[i % steadyPoints]);
    if (const auto* point = analysis.pointAt(points[i])) addComplexModes(entry, *point);
    entries.push_back(std::move(entry));
  }
  return entries;
}

Json activeSetEntry(const sweep_solver::ModalSegment& segment) {
  Json entry;
  for (const auto& [word, point] :
       {std::pair{"first_", &segment.points.front()}, {"last_", &segment.points.back()}})
    for (const auto& parameter : sweep::allParameters)
      entry[std::string(word) + parameter.name] = point->at.*parameter.value;
  entry["open_nodes"] = segment.openNodes;
  entry["dofs"] = segment.unknowns;
  entry["modes"] = segment.modes.angularFrequency.size();
  if (segment.modes.rounding > 0) entry["modes_rounding_error"] = segment.modes.rounding;
  entry["solves"] = segment.solves;
  if (segment.modes.inertiaShift > 0)
    entry["sturm_count"] = {{"shift_rad2_per_s2", segment.modes.inertiaShift},
                            {"eigenvalues_below", segment.modes.inertiaCount},
                            {"confirmed", segment.modes.countConfirmed}};
  for (const auto& tracked : segment.trackedLines)
    entry["followed"].push_back(trackedLineEntry(tracked));
  return entry;
}

Json contactEventEntry(const contact::Contact& contact, const analysis::PathEvent& event) {
  return {{"friction", event.at.friction},
          {"speed", event.at.speed},
          {"pressure", event.at.pressure},
          {"position_m", event.position},
          {"interface", contact.interfaces.names[event.interface]},
          {"change", condensed::text(event.change)}};
}

Json sparseWorkEntry(const SparseWork& work) {
  return {{"factorisations", work.factorisations},
          {"right_hand_sides", work.rightHandSides},
          {"projections", work.projections}};
}

/// Adds the cost of each stage, the sparse work of all, and the total time.
void addStages(Json& summary) {
  double total = 0;
  for (const auto& record : stageRecords()) {
    summary["stages"][record.name] = {{"wall_s", record.seconds},
                                      {"peak_memory_bytes", record.peakMemoryBytes},
                                      {"messages", record.traffic.messages},
                                      {"message_bytes", record.traffic.bytes},
                                      {"reductions", record.traffic.reductions}};
    summary["stages"][record.name].update(sparseWorkEntry(record.work));
    total += record.seconds;
  }
  summary["wall_s"] = total;
  summary["sparse_work"] = sparseWorkEntry(sparseWork());
}

Json verdictEntry(const RunVerdict& verdict) {
  return {
      {"sentence", verdict.sentence},
      {"points", verdict.points},
      {"points_solved", verdict.pointsSolved},
      {"points_unstable", verdict.pointsUnstable},
      {"points_unknown", verdict.pointsUnknown},
      {"most_unstable_modes", verdict.mostUnstable},
      {"undecided_eigenvalues", verdict.undecided},
      {"uncertified_eigenvalues", verdict.uncertified},
      {"critical_friction", verdict.criticalFriction ? Json(*verdict.criticalFriction) : Json()}};
}

/// Adds the supports, loads and joints.
void addInventory(const analysis::Analysis& analysis, Json& entry) {
  for (const auto& [kind, items] :
       analysis::inventory(*analysis.model.mesh, analysis.settings.mesh->model))
    for (const auto& item : items) {
      Json& found = entry[kind][item.name] = Json::object();
      for (const auto& [name, fact] : item.facts)
        found[name] = std::visit([](const auto& value) { return Json(value); }, fact);
    }
}

/// Returns the beginning of the summary: the run and its problem.
Json runEntry(const analysis::Analysis& analysis) {
  const auto& options = resolvedOptions();
  Json entry;
  entry["version"] = version();
  entry["case"] = analysis.model.mesh
                      ? std::filesystem::path(options.at("mesh_file")).stem().string()
                      : "matrices";
  entry["ranks"] = mpi::size(analysis.comm);
  entry["complete"] = !analysis.interrupted();
  entry["resumed"] = analysis.checkpoint.resumed();
  entry["verdict"] = verdictEntry(runVerdict(analysis));
  if (analysis.model.mesh) {
    entry.update(meshEntry(*analysis.model.mesh, analysis.model.contact));
    addInventory(analysis, entry);
  }
  entry["method"] =
      analysis.settings.pencil.method == pencil::Method::direct ? "direct" : "reduced";
  entry["dofs"] =
      analysis.flutter.segments.empty() ? 0 : analysis.flutter.segments.front().unknowns;
  return entry;
}

}  // namespace

void writeSummary(const analysis::Analysis& analysis, const std::filesystem::path& folder) {
  Json summary = runEntry(analysis);
  if (analysis.judged) summary["referee"] = refereeEntry(*analysis.judged);
  summary["frictions"] = pointEntries(analysis);
  for (const auto& [speed, found] : analysis.uniqueness.speeds)
    summary["steady_uniqueness"].push_back(uniquenessEntry(speed, found));
  summary["active_sets"] = Json::array();
  for (const auto& segment : analysis.flutter.segments)
    summary["active_sets"].push_back(activeSetEntry(segment));
  for (const auto& event : analysis::contactPath(analysis))
    summary["contact_path"].push_back(contactEventEntry(analysis.model.contact, event));
  for (const auto& study : analysis.flutter.regimes)
    for (const auto& run : study.runs) summary["regimes"].push_back(regimeEntry(study, run));
  if (!analysis.flutter.failures.empty()) summary["failures"] = analysis.flutter.failures;
  addStages(summary);
  summary["options"] = resolvedOptions();
  summary["tables"] = tableShapes(analysis.comm, folder);
  writeText(analysis.comm, folder / "summary.json", summary.dump(2) + "\n");
}

}  // namespace squeal::report
