// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// All settings of a run, read once before anything else.
#include <optional>

#include "base/checkpoint/settings.hpp"
#include "base/session/settings.hpp"
#include "eigen/pencil/settings.hpp"
#include "eigen/referee/settings.hpp"
#include "eigen/sweep/settings.hpp"
#include "eigen/sweep_solver/settings.hpp"
#include "problem/eigenlist/settings.hpp"
#include "problem/matrices/settings.hpp"
#include "problem/terms/settings.hpp"
#include "regime/regime/settings.hpp"
#include "run/analysis/model_settings.hpp"
#include "steady/uniqueness/settings.hpp"

namespace squeal::analysis {

/// Settings of the steady states of a sweep.
struct SteadySettings {
  bool full = false;  ///< `-steady_full`: solve in all unknowns
  int path = 1000;    ///< `-steady_path`: the path between two points is followed if at most this
                      ///< number of nodes change; 0: no path
};

/// Settings of a problem given by a mesh.
struct MeshSettings {
  ModelSettings model;
  SteadySettings steady;
  uniqueness::Settings uniqueness;
  terms::Settings terms;
  /// `-flutter_released`: largest number of contact nodes in which active sets that share a basis
  /// may differ; 0 if another setting needs the matrices of each active set.
  int released = 350;
  std::string whySeparate = {};  ///< the setting by which active sets do not share a basis
  bool audit = true;             ///< `-audit`: audit the model before the solution
  int ownModes = 0;  ///< `-report_component_modes`: number of modes of each body by itself
};

/// Settings of the judgement of a list of eigenvalues.
struct RefereeSettings {
  eigenlist::Settings list;
  referee::Settings proof;
};

/// Settings of an analysis.
struct Settings {
  OutputSettings output;
  bool dryRun = false;  ///< `-dry_run`: check the input and solve nothing
  checkpoint::Settings checkpoint;
  /// Includes the frictions of `-regime_friction`. The friction is 0 if all interfaces have fixed
  /// coefficients of their own.
  sweep::Settings sweep;
  pencil::Settings pencil;
  sweep_solver::Settings solver;
  matrices::Settings matrices;
  matrices::ExportSettings matrixExport;
  std::optional<MeshSettings> mesh;  ///< none for matrices from files
  regime::Settings regime;
  /// Set if the run judges the list of `-referee_list`; it then computes nothing else. In this
  /// case, only the settings of the list, the matrices, the sweep and the free modes are read.
  std::optional<RefereeSettings> referee;

  /// Collective. Reads all options of the analysis. Throws Error for an option that is unknown, out
  /// of range or without effect, and for every other mistake that can be detected before a file is
  /// read or written.
  static Settings given();
};

}  // namespace squeal::analysis
