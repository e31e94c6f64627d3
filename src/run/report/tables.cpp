#include "run/report/tables.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/options/options.hpp"
#include "base/options/settings.hpp"
#include "base/session/session.hpp"
#include "base/system/text.hpp"
#include "eigen/modes/modes.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/pencil/settings.hpp"
#include "eigen/sensitivity/settings.hpp"
#include "eigen/sweep/parameters.hpp"
#include "run/analysis/contact_path.hpp"
#include "run/report/branches.hpp"
#include "run/report/names.hpp"
#include "run/report/regimes.hpp"
#include "run/report/report.hpp"
#include "run/report/sensitivities.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::report {
namespace {

std::string eigenvalueTable(const analysis::Analysis& analysis) {
  std::string table = sweep::parameterColumns() +
                      ",mode,growth_rate_1_per_s,angular_frequency_rad_per_s,frequency_hz,damping_"
                      "ratio,backward_error,error_estimate,certified,verdict\n";
  for (const auto& segment : analysis.segments)
    for (const auto& point : segment.points)
      for (std::size_t i = 0; i < point.eigenvalues.size(); ++i) {
        const auto& e = point.eigenvalues[i];
        table += sweep::parameterValues(point.at) + "," + std::to_string(i + 1) +
                 formatted(",%.15e,%.15e,%.15e,%.15e,%.3e,%.3e,%d,%s\n", e.s.real(), e.s.imag(),
                           e.s.imag() / (2 * M_PI), e.dampingRatio(), e.backwardError,
                           e.errorEstimate(), e.certified ? 1 : 0, text(e.verdict));
      }
  return table;
}

/// Returns a table with a row for each point of the sweep. Cells stay empty where there is nothing
/// to say: no steady sliding, no eigenvalue, no estimate.
std::string stabilityMap(const analysis::Analysis& analysis) {
  const auto cell = [](const char* format, double value) {
    char text[32] = "";
    if (std::isfinite(value)) std::snprintf(text, sizeof text, format, value);
    return "," + std::string(text);
  };
  std::string table = sweep::parameterColumns() +
                      ",unstable_modes,largest_growth_rate_1_per_s,frequency_hz,worst_backward_"
                      "error,worst_error_estimate,verdict,undecided_modes\n";
  for (const auto& at : analysis.sweep.points()) {
    const auto* point = analysis.pointAt(at);
    const auto* fastest = point ? point->fastestGrowing() : nullptr;
    table += sweep::parameterValues(at) + cell("%.0f", point ? point->unstableCount() : NAN) +
             cell("%.15e", fastest ? fastest->s.real() : NAN) +
             cell("%.15e", fastest ? fastest->s.imag() / (2 * M_PI) : NAN) +
             cell("%.3e", fastest ? point->worstBackwardError() : NAN) +
             cell("%.3e", fastest ? point->worstErrorEstimate() : NAN) + "," +
             (point ? text(point->verdict()) : "") +
             cell("%.0f", point ? point->count(pencil::Verdict::undecided) : NAN) + "\n";
  }
  return table;
}

std::string modeTable(const modes::Modes& modes) {
  std::string table = "mode,angular_frequency_rad_per_s,frequency_hz,relative_residual\n";
  for (std::size_t i = 0; i < modes.angularFrequency.size(); ++i)
    table += formatted("%zu,%.15e,%.15e,%.3e\n", i + 1, modes.angularFrequency[i],
                       modes.angularFrequency[i] / (2 * M_PI), modes.relativeResidual[i]);
  return table;
}

/// Returns what a contact node does, in a word.
std::string nodeState(const contact::Contact& contact, const steady::Solution& solution,
                      std::size_t i) {
  if (!solution.closed[i]) return "open";
  if (contact.nodes[i].role != contact::Role::sticking)
    return interfaces::text(contact.nodes[i].role);
  if (solution.sticking.holds[i] == steady::Hold::released) return "released";
  if (solution.sticking.holds[i] == steady::Hold::open) return "unheld";
  return steady::exceedsLimit(contact, solution, i) ? "beyond_friction" : "sticking";
}

std::string gathered(MPI_Comm comm, const std::string& text) {
  int rank = 0, size = 1, length = text.size();
  check(MPI_Comm_rank(comm, &rank));
  check(MPI_Comm_size(comm, &size));
  std::vector<int> lengths(size), offsets(lengths.size(), 0);
  check(MPI_Gather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, 0, comm));
  for (std::size_t r = 1; r < lengths.size(); ++r) offsets[r] = offsets[r - 1] + lengths[r - 1];
  std::string all(rank == 0 ? offsets.back() + lengths.back() : 0, ' ');
  check(MPI_Gatherv(text.data(), length, MPI_CHAR, all.data(), lengths.data(), offsets.data(),
                    MPI_CHAR, 0, comm));
  return all;
}

/// Returns the rows of this rank. They hold surface data only, and are gathered on rank 0.
std::string steadyRows(const analysis::Analysis& analysis, const steady::Solution& solution) {
  std::string rows;
  for (std::size_t i = 0; i < solution.contact.size(); ++i) {
    const auto& p = analysis.contact.nodes[i].position;
    const auto& state = solution.contact[i];
    rows += formatted("%.12e,%.12e,%.12e,%.12e,%.12e,%.12e,%.12e,%.12e,%.12e,", p[0], p[1], p[2],
                      state.gap, state.normalForce, state.pressure, state.frictionForce[0],
                      state.frictionForce[1], state.frictionForce[2]) +
            analysis.contact.interfaces[analysis.contact.nodes[i].interface] + "," +
            nodeState(analysis.contact, solution, i) + "\n";
  }
  return rows;
}

/// Collective. Returns the table of the nodes that open and close.
std::string contactPathTable(const analysis::Analysis& analysis) {
  std::string table = "friction,speed,pressure,x_m,y_m,z_m,interface,change\n";
  for (const auto& [order, at, x, interface, opens] : analysis::contactPath(analysis))
    table += formatted("%.12g,%.12g,%.12g,%.12e,%.12e,%.12e,", at.friction, at.speed, at.pressure,
                       x[0], x[1], x[2]) +
             analysis.contact.interfaces[interface] + (opens ? ",opens\n" : ",closes\n");
  return table;
}

/// Returns friction, and the parameters that are not 1 all over the sweep.
std::vector<sweep::Parameter> shownParameters(const analysis::Analysis& analysis) {
  const auto points = analysis.sweep.points();
  std::vector<sweep::Parameter> shown;
  std::copy_if(sweep::allParameters.begin(), sweep::allParameters.end(), std::back_inserter(shown),
               [&](const sweep::Parameter& parameter) {
                 return parameter.value == &sweep::Parameters::friction ||
                        std::any_of(points.begin(), points.end(), [&](const sweep::Parameters& at) {
                          return at.*parameter.value != 1;
                        });
               });
  return shown;
}

/// Returns the head of a line of a sweep.
std::string rowHead(const sweep::Parameters& at, const std::vector<sweep::Parameter>& shown) {
  std::string head = "\n";
  for (const auto& parameter : shown) head += formatted("%8g  ", at.*parameter.value);
  return head;
}

/// Returns what is to be said of eigenvalues whose growth is not certain; empty if there are none.
std::string uncertaintyText(const pencil::ComplexModes& point) {
  const int undecided = point.count(pencil::Verdict::undecided);
  std::string text = point.verdict() == pencil::Verdict::uncertified ? " (uncertified)" : "";
  if (undecided > 0) text += formatted("; %d undecided", undecided);
  return text;
}

/// Returns the text for a point where no mode is unstable.
std::string stableText(const analysis::Analysis& analysis,
                       const sweep_solver::ModalSegment& segment,
                       const pencil::ComplexModes& point) {
  if (point.eigenvalues.empty()) return "no eigenvalue was found: nothing is known of stability";
  if (segment.openNodes > 0 && segment.openNodes == analysis.contact.totalNodes)
    return "none: no contact is closed, nothing slides";
  if (point.verdict() == pencil::Verdict::undecided) return "none" + uncertaintyText(point);
  const int neutral = point.count(pencil::Verdict::neutral);
  return "none: steady sliding is stable" + uncertaintyText(point) +
         (neutral > 0
              ? formatted(", %d of %zu eigenvalues neutral", neutral, point.eigenvalues.size())
              : "");
}

/// Returns one line for one point of a sweep, with the lowest unstable modes.
std::string sweepRow(const analysis::Analysis& analysis, const sweep_solver::ModalSegment& segment,
                     const pencil::ComplexModes& point,
                     const std::vector<sweep::Parameter>& shown) {
  std::string row = rowHead(point.at, shown);
  if (point.unstableCount() == 0) return row + stableText(analysis, segment, point);
  int count = 0;
  for (const auto& e : point.eigenvalues)
    if (e.unstable && ++count <= 6)
      row += formatted("%s%.6g (%.4g)", count > 1 ? ", " : "", e.s.imag() / (2 * M_PI), e.s.real());
  return row + (count > 6 ? formatted(", and %d more in eigenvalues.csv", count - 6) : "") +
         uncertaintyText(point);
}

/// Returns the unstable modes of a single point, a line each; modes are numbered by frequency.
std::string modeRows(const analysis::Analysis& analysis, const sweep_solver::ModalSegment& segment,
                     const pencil::ComplexModes& point) {
  if (point.unstableCount() == 0)
    return formatted("\nfriction %g  ", point.at.friction) + stableText(analysis, segment, point);
  std::string rows;
  for (std::size_t i = 0; i < point.eigenvalues.size(); ++i) {
    const auto& e = point.eigenvalues[i];
    if (e.unstable)
      rows += formatted("\n%4zu  %12.6g %12.5g", i + 1, e.s.imag() / (2 * M_PI), e.s.real());
  }
  const std::string uncertainty = uncertaintyText(point);
  return uncertainty.empty() ? rows : rows + "\n     " + uncertainty;
}

/// Returns a text on the point where strong damping has taken most free modes of the band from the
/// eigenvalues listed; empty if there is none.
std::string strongDampingText(const analysis::Analysis& analysis) {
  const pencil::ComplexModes* most = nullptr;
  for (const auto& segment : analysis.segments)
    for (const auto& point : segment.points)
      if (point.modesWithoutEigenvalue() > (most ? most->modesWithoutEigenvalue() : 0))
        most = &point;
  if (!most) return "";
  return formatted(
      "\n%s: %d of the %d free modes in the band have no eigenvalue there: their damping ratio "
      "exceeds -flutter_band_damping, or "
      "damping has moved them. Modes that such damping changes much may take a larger "
      "-modes_count; -flutter_method direct tells.",
      sweep::parameterText(most->at).c_str(), most->modesWithoutEigenvalue(),
      most->freeModesInBand);
}

/// Returns an -options_file that repeats the run; defaults that were in force stand in comments.
std::string recipe(MPI_Comm comm) {
  int size = 1;
  check(MPI_Comm_size(comm, &size));
  std::string text = formatted(
      "# squeal %s, %d ranks: the options of this run; defaults in comments\n", version(), size);
  const auto given = givenOptions();
  // What belongs to one run alone: a replay writes elsewhere and begins anew.
  const auto ofThisRun = [](const std::string& name) {
    return name == "report_dir" || name == "resume" || name == "progress" || name == "log_json";
  };
  for (const auto& [name, value] : given) {
    if (ofThisRun(name)) continue;
    text += optionLine(name, FileOption::isOne(name)
                                 ? std::filesystem::absolute(value).lexically_normal().string()
                                 : value);
  }
  for (const auto& [name, value] : resolvedOptions())
    if (!given.count(name) && !ofThisRun(name)) text += "# " + optionLine(name, value);
  return text;
}

}  // namespace

void writeTables(const analysis::Analysis& analysis, const std::filesystem::path& folder) {
  const MPI_Comm comm = analysis.comm;
  writeText(comm, folder / "eigenvalues.csv", eigenvalueTable(analysis));
  if (sensitivity::Settings::given().wanted)
    writeText(comm, folder / "sensitivities.csv", sensitivityTable(analysis));
  if (analysis.mesh) writeText(comm, folder / "friction_work.csv", frictionWorkTable(analysis));
  writeText(comm, folder / "stability_map.csv", stabilityMap(analysis));
  if (std::any_of(analysis.segments.begin(), analysis.segments.end(),
                  [](const auto& segment) { return !segment.followed.empty(); })) {
    writeText(comm, folder / "branches.csv", branchTable(analysis));
    writeText(comm, folder / "critical.csv", criticalTable(analysis));
  }
  for (std::size_t s = 0; s < analysis.segments.size(); ++s) {
    if (analysis.segments[s].modes.angularFrequency.empty()) continue;
    // modes.csv: the first active set; each later one has its own file, named by its first point.
    const std::string name =
        s == 0 ? "modes.csv" : "modes_" + pointName(analysis.segments[s].points.at(0).at) + ".csv";
    writeText(comm, folder / name, modeTable(analysis.segments[s].modes));
  }
  writeRegimes(analysis, folder);
  if (analysis.contactEvents > 0)
    writeText(comm, folder / "contact_path.csv", contactPathTable(analysis));
  for (const auto& solution : analysis.steady)
    if (solution.converged)
      writeText(comm, folder / ("steady_" + pointName(solution.at) + ".csv"),
                "x_m,y_m,z_m,gap_m,normal_force_n,pressure_pa,friction_force_x_n,friction_force_y_"
                "n,friction_force_z_n,interface,state\n" +
                    gathered(comm, steadyRows(analysis, solution)));
}

void writeRecipe(const analysis::Analysis& analysis, const std::filesystem::path& folder) {
  writeText(analysis.comm, folder / "options.txt", recipe(analysis.comm));
}

std::string stabilityTable(const analysis::Analysis& analysis) {
  const bool sweep = analysis.sweep.points().size() > 1;
  const auto shown = shownParameters(analysis);
  std::string table = sweep ? "\n" : "\nmode  frequency Hz   growth 1/s";
  if (sweep) {
    for (const auto& parameter : shown) table += formatted("%8s  ", parameter.name);
    table += "unstable modes: frequency Hz (growth 1/s)";
  }
  for (const auto& solution : analysis.steady)
    if (!solution.converged)
      table += rowHead(solution.at, shown) +
               formatted("no steady sliding solution found (%s)", solution.reason.c_str());
  for (const auto& segment : analysis.segments)
    for (const auto& point : segment.points)
      table +=
          sweep ? sweepRow(analysis, segment, point, shown) : modeRows(analysis, segment, point);
  for (const auto& segment : analysis.segments)
    for (const auto& point : segment.points)
      if (point.coveredTo < point.askedTo)
        table +=
            formatted("\n%s: the band is covered up to %.5g Hz only; raise -flutter_direct_limit",
                      sweep::parameterText(point.at).c_str(), point.coveredTo / (2 * M_PI));
  table += strongDampingText(analysis);
  for (const auto& segment : analysis.segments)
    for (const auto& point : segment.points)
      if (point.bandTop > 0 && point.uncertifiedCount() > 0)
        table += formatted(
            "\n%s: %d eigenvalues could not be certified, see eigenvalues.csv; raise -modes_count "
            "or -flutter_rounds",
            sweep::parameterText(point.at).c_str(), point.uncertifiedCount());
  const auto listsAny = [](const sweep_solver::ModalSegment& segment) {
    return std::any_of(segment.points.begin(), segment.points.end(),
                       [](const auto& point) { return !point.eigenvalues.empty(); });
  };
  if (std::any_of(analysis.segments.begin(), analysis.segments.end(), listsAny) &&
      analysis.segments.front().points.front().bandTop > 0) {
    double backward = 0, estimate = 0, top = INFINITY;
    for (const auto& segment : analysis.segments)
      for (const auto& point : segment.points) {
        top = std::min(top, point.bandTop);
        backward = std::max(backward, point.worstBackwardError());
        estimate = std::max(estimate, point.worstErrorEstimate());
      }
    const double asked = pencil::Settings::given().band.top;
    if (top < asked)
      table += formatted(
          "\nThe free modes end below the %.5g Hz of -flutter_band, and so do the eigenvalues: "
          "raise -modes_count.",
          asked / (2 * M_PI));
    table +=
        (std::isfinite(top) ? formatted("\nEigenvalues with |s|/2π up to %.5g Hz", top / (2 * M_PI))
                            : "\nAll eigenvalues") +
        formatted(
            ", of the full-order problem: backward errors up to %.1e, estimated errors |ds|/|s| up "
            "to %.1e.",
            backward, estimate);
  }
  return table + followedText(analysis);
}

}  // namespace squeal::report
