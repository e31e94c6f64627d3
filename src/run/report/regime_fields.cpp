// SPDX-License-Identifier: BSD-2-Clause
#include "run/report/regime_fields.hpp"

#include <functional>

#include "base/system/text.hpp"
#include "eigen/sweep/parameters.hpp"
#include "run/report/names.hpp"

namespace squeal::report {
namespace {

using fieldfile::Field;
using regime::Run;
using regime::Study;

/// A value of a contact node of this rank.
using Value = std::function<double(std::size_t)>;

/// Collective. Returns a nodal vector with a value at the contact nodes of this rank in component
/// 0, zero elsewhere.
OwnedVec atContactNodes(const analysis::Analysis& analysis, const Value& value) {
  const auto& mesh = *analysis.model.mesh;
  OwnedVec field = elasticity::nodalVector(mesh);
  const auto& nodes = analysis.model.contact.interfaces.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    check(VecSetValue(field, mesh.dimension * (mesh.firstNode + nodes[i].surfaceNode), value(i),
                      INSERT_VALUES));
  check(VecAssemblyBegin(field));
  check(VecAssemblyEnd(field));
  return field;
}

struct MeanField {
  const char* name;
  double regime::NodeMeans::*value;
  bool perArea;
};
constexpr MeanField meanFields[] = {{"open", &regime::NodeMeans::open, false},
                                    {"stick", &regime::NodeMeans::stick, false},
                                    {"slip", &regime::NodeMeans::slip, false},
                                    {"mean_pressure", &regime::NodeMeans::pressure, false},
                                    {"largest_gap", &regime::NodeMeans::largestGap, false},
                                    {"friction_power_per_area", &regime::NodeMeans::power, true}};

/// Collective. Returns one of the means of a run as a nodal vector.
OwnedVec meansOf(const analysis::Analysis& analysis, const Study& study, const Run& run,
                 const MeanField& mean) {
  std::vector<double> own(analysis.model.contact.interfaces.nodes.size());
  for (std::size_t i = 0; i < study.contactNode.size(); ++i)
    if (const PetscInt place = study.contactNode[i]; place >= 0)
      own[place] = run.regime.nodes[i].*mean.value / (mean.perArea ? study.nodes[i].area : 1);
  return atContactNodes(analysis, [&](std::size_t i) { return own[i]; });
}

/// Calls action(study, run, name) for each run; the name contains point and start.
template <class Action>
void forEachRun(const analysis::Analysis& analysis, const Action& action) {
  for (const auto& study : analysis.flutter.regimes)
    for (const auto& run : study.runs)
      action(study, run, "friction_" + pointName(study.at) + "_start_" + run.start);
}

/// Collective. Returns a nodal vector that borrows the entries of a column.
OwnedVec borrowed(const mesh::Mesh& mesh, std::span<const double> column) {
  OwnedVec vector;
  check(VecCreateMPIWithArray(mesh.comm, mesh.dimension, column.size(), PETSC_DETERMINE,
                              column.data(), vector.out()));
  return vector;
}

/// Collective. Writes the latest cycles of a run as a time series.
void animate(const analysis::Analysis& analysis, const Ghosts& ghosts, const Run& run,
             const std::filesystem::path& stem, int pieces) {
  const auto& frames = run.surface.frames;
  std::vector<std::pair<double, std::filesystem::path>> files;
  for (std::size_t k = 0; k < frames.time.size(); ++k) {
    const auto file = stem / formatted("frame_%03zu", k);
    const auto u = borrowed(*analysis.model.mesh, frames.displacement.column(k));
    const auto at = [&](const std::vector<double>& values) {
      return atContactNodes(analysis, [&](std::size_t i) { return values[i]; });
    };
    writeVtk(*analysis.model.mesh, file,
             {ghosts.vector("displacement", u), ghosts.scalar("gap", at(frames.gap[k])),
              ghosts.scalar("contact_pressure", at(frames.pressure[k]))},
             pieces);
    files.emplace_back(frames.time[k], file.string() + ".pvtu");
  }
  if (!files.empty())
    fieldfile::writePvd(analysis.model.mesh->comm, stem.string() + ".pvd", files, folderOption);
}

}  // namespace

void writeRegimeFields(const analysis::Analysis& analysis, const Ghosts& ghosts,
                       const std::filesystem::path& vtk, int pieces) {
  forEachRun(analysis, [&](const Study& study, const Run& run, const std::string& name) {
    if (run.regime.measured()) {
      std::vector<Field> fields;
      for (const auto& mean : meanFields)
        fields.push_back(ghosts.scalar(mean.name, meansOf(analysis, study, run, mean)));
      writeVtk(*analysis.model.mesh, vtk / ("regime_means_" + name), fields, pieces);
    }
    animate(analysis, ghosts, run, vtk / ("regime_" + name), pieces);
  });
}

void writeRegimeFields(const analysis::Analysis& analysis, fieldfile::Hdf5File& file) {
  for (const auto& study : analysis.flutter.regimes) {
    const std::string point = "/regime/friction_" + pointName(study.at);
    bool named = false;  // once per point, which the starts share
    for (const auto& run : study.runs) {
      if (!run.regime.measured()) continue;
      const std::string group = point + "/start_" + run.start;
      for (const auto& mean : meanFields) {
        OwnedVec all = meansOf(analysis, study, run, mean), one;
        check(VecCreateMPI(analysis.comm, analysis.model.mesh->ownedNodes, PETSC_DETERMINE,
                           one.out()));
        check(VecSetBlockSize(all, analysis.model.mesh->dimension));
        check(VecStrideGather(all, 0, one, INSERT_VALUES));
        file.writeNodeVector(group, mean.name, one);
      }
      for (const auto& parameter : sweep::allParameters) {
        file.writeAttribute(group, parameter.name, study.at.*parameter.value);
        if (!named) file.writeAttribute(point, parameter.name, study.at.*parameter.value);
      }
      named = true;
    }
  }
}

}  // namespace squeal::report
