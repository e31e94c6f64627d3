// SPDX-License-Identifier: BSD-2-Clause
#include "run/report/sensitivities.hpp"

#include <cmath>

#include "base/system/mpi.hpp"
#include "base/system/text.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/sweep/parameters.hpp"

namespace squeal::report {
namespace {

/// Collective. Returns the sums over the nodes of each interface, [interface].
std::vector<double> byInterface(const analysis::Analysis& analysis,
                                const std::vector<double>& nodes) {
  std::vector<double> sums(analysis.model.contact.interfaces.names.size(), 0.0);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    sums[analysis.model.contact.interfaces.nodes[k].interface] += nodes[k];
  mpi::reduce<double>(analysis.comm, sums, MPI_SUM);
  return sums;
}

}  // namespace

std::string modeHead(const pencil::ComplexModes& point, const pencil::Shape& shape) {
  const auto s = point.eigenvalues[shape.index].s;
  return sweep::parameterValues(point.at) +
         formatted(",%zu,%.15e,%.15e,", shape.index + 1, s.real(), s.imag() / (2 * M_PI));
}

std::string sensitivityTable(const analysis::Analysis& analysis) {
  std::string table =
      sweep::parameterColumns() +
      ",mode,growth_rate_1_per_s,frequency_hz,condition,separation,left_backward_error,parameter,"
      "growth_rate_derivative_1_per_s,frequency_derivative_hz,growth_holds_to\n";
  for (const auto& segment : analysis.flutter.segments)
    for (const auto& point : segment.points)
      for (std::size_t i = 0; i < point.sensitivities.size(); ++i) {
        const auto& sensitivity = point.sensitivities[i];
        const std::string head = modeHead(point, point.shapes[i]) +
                                 formatted("%.3e,%.3e,%.3e,", sensitivity.condition,
                                           sensitivity.separation, sensitivity.leftBackwardError);
        if (sensitivity.derivatives.empty()) table += head + "none,,,\n";
        for (const auto& derivative : sensitivity.derivatives) {
          const auto& value = derivative.value;
          const double range = derivative.growthHoldsTo();
          table += head + derivative.parameter +
                   formatted(",%.9e,%.9e,", value.real(), value.imag() / (2 * M_PI)) +
                   (std::isfinite(range) ? formatted("%.2e", range) : "") + "\n";
        }
      }
  return table;
}

std::string frictionWorkTable(const analysis::Analysis& analysis) {
  std::string table = sweep::parameterColumns() +
                      ",mode,growth_rate_1_per_s,frequency_hz,interface,friction_work_1_per_s\n";
  for (const auto& segment : analysis.flutter.segments)
    for (const auto& point : segment.points)
      for (const auto& shape : point.shapes) {
        const auto sums = byInterface(analysis, shape.frictionWork);
        for (std::size_t i = 0; i < sums.size(); ++i)
          table += modeHead(point, shape) + analysis.model.contact.interfaces.names[i] +
                   formatted(",%.9e\n", sums[i]);
      }
  return table;
}

}  // namespace squeal::report
