// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Runs of the coarse disc brake that follow its unstable mode after flutter.
#include <gtest/gtest.h>

#include <string>

#include "support/harness/program.hpp"

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

/// A pad of lining and plate on a block, with three unstable modes below 20 kHz at friction 0.5
/// whose shapes are kept, 12.0, 18.4 and 18.8 kHz; above friction 2.36 modes diverge.
inline const Options blockBrake = {{"mesh_file", "tests/support/regime/block_brake.msh"},
                                   {"material_disc_young", "120e9"},
                                   {"material_disc_poisson", "0.25"},
                                   {"material_disc_density", "7200"},
                                   {"material_disc_rayleigh_stiffness", "2e-8"},
                                   {"material_lining_young", "2e9"},
                                   {"material_lining_poisson", "0.25"},
                                   {"material_lining_density", "2500"},
                                   {"material_lining_rayleigh_stiffness", "2e-8"},
                                   {"material_plate_young", "210e9"},
                                   {"material_plate_poisson", "0.3"},
                                   {"material_plate_density", "7850"},
                                   {"material_plate_rayleigh_stiffness", "2e-8"},
                                   {"motion_disc_velocity", "2,0,0"},
                                   {"constraint_bottom_clamped", "xyz"},
                                   {"load_pressed_pressure", "1e6"},
                                   {"contact_c_pad", "pad_face"},
                                   {"contact_c_disc", "disc_face"},
                                   {"tie_t_slave", "lin_back"},
                                   {"tie_t_master", "plate_front"},
                                   {"ground_lead_stiffness", "1e8,1e8,1e8"},
                                   {"ground_trail_stiffness", "1e8,1e8,1e8"},
                                   {"modes_count", "40"},
                                   {"flutter_friction", "0.5"},
                                   {"regime_friction", "0.5"},
                                   {"regime_time", "0.002"},
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
