// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Tables of the composition of the modes: the shares of the components of the model, and those of
/// the free modes.
#include <array>
#include <string>

#include "eigen/pencil/complex_modes.hpp"
#include "run/analysis/analysis.hpp"

namespace squeal::report {

/// A column of componentTable(): a cause of growth.
struct GrowthColumn {
  const char* name;
  double pencil::GrowthParts::*value;  ///< 1/s
};
inline constexpr std::array growthColumns{
    GrowthColumn{"damping_1_per_s", &pencil::GrowthParts::damping},
    GrowthColumn{"follower_1_per_s", &pencil::GrowthParts::follower},
    GrowthColumn{"friction_damping_1_per_s", &pencil::GrowthParts::turning},
    GrowthColumn{"law_slope_1_per_s", &pencil::GrowthParts::slope},
    GrowthColumn{"convective_1_per_s", &pencil::GrowthParts::convective},
    GrowthColumn{"gyroscopic_1_per_s", &pencil::GrowthParts::gyroscopic}};

/// Returns components.csv: the shares of each component in the stored complex modes.
std::string componentTable(const analysis::Analysis& analysis);
/// Returns mode_components.csv: the shares of each component in the free modes of the band.
std::string modeComponentTable(const analysis::Analysis& analysis);
/// Returns participation_bodies.csv. For each stored complex mode, it lists the MAC with the free
/// modes that have the largest shares of its energy, body by body.
std::string bodyMacTable(const analysis::Analysis& analysis);
/// Returns component_modes.csv: the elastic modes of each body by itself.
std::string ownModeTable(const analysis::Analysis& analysis);
/// Returns participation.csv. For each stored complex mode, it lists the free modes that have at
/// least 1e-4 of its energy or of its mass norm, the largest share of the energy first, and a row
/// `0` for the rest.
std::string participationTable(const analysis::Analysis& analysis);

/// Returns a table cell with the name of a mode in quotes, since it may contain commas; an empty
/// cell for an empty name.
std::string nameCell(const std::string& name);

}  // namespace squeal::report
