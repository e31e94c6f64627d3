#pragma once
/// Runs of the coarse disc brake that follow its unstable mode after flutter.
#include <gtest/gtest.h>

#include <string>

#include "support/program.hpp"

namespace squeal::test {

inline const Options coarse = {
    {"options_file", "options/disc_brake_regime.yaml"},
    {"mesh_set",
     "n_pad_theta=8,n_free_theta=12,n_mount=2,n_plate=1,n_inside=1,n_pad_r=4,n_hat=2,n_"
     "h_ring=2"},
    {"modes_count", "60"},
    {"flutter_band", "9000"},  // holds the unstable mode; a wider one costs seconds
    {"flutter_friction", "0.4"},
    {"regime_friction", "0.4"},
    {"report_fields", "off"}};

inline CsvTable regimeOf(const std::string& name, int ranks, const Options& changes) {
  const ProgramRun run = runProgram("regime_" + name, ranks, commandLine(with(coarse, changes)));
  EXPECT_EQ(run.exitCode, 0) << run.error;
  return readCsv(run.folder / "regime.csv");
}

inline double valueOf(const CsvTable& table, const std::string& column) {
  return table.column(column).at(0);
}

}  // namespace squeal::test
