// SPDX-License-Identifier: BSD-2-Clause
#include "run/report/fields.hpp"

#include <algorithm>
#include <cmath>

#include "base/options/options.hpp"
#include "base/petsc/arrays.hpp"
#include "base/system/text.hpp"
#include "eigen/pencil/complex_modes.hpp"
#include "eigen/sweep/parameters.hpp"
#include "model/mesh/mesh.hpp"
#include "model/mesh/vector.hpp"
#include "run/analysis/contact_path.hpp"
#include "run/fieldfile/hdf5.hpp"
#include "run/fieldfile/vtu.hpp"
#include "run/report/branches.hpp"
#include "run/report/components.hpp"
#include "run/report/names.hpp"
#include "run/report/nodal_fields.hpp"
#include "run/report/regime_fields.hpp"
#include "steady/steady/steady.hpp"

namespace squeal::report {

using fieldfile::Field;
using fieldfile::Hdf5File;

namespace {

/// Collective. Returns a nodal vector with the contact pressure at the pad nodes, Pa, in component
/// 0 and the gap, m, in component 1; both are zero elsewhere.
OwnedVec contactField(const analysis::Analysis& analysis, const steady::Solution& solution) {
  const auto& mesh = *analysis.model.mesh;
  OwnedVec field = elasticity::nodalVector(mesh);
  for (std::size_t i = 0; i < solution.contact.size(); ++i) {
    const auto& node = analysis.model.contact.interfaces.nodes[i];
    const PetscInt row = mesh.dimension * (mesh.firstNode + node.surfaceNode);
    check(VecSetValue(field, row, solution.contact[i].pressure, INSERT_VALUES));
    check(VecSetValue(field, row + 1, solution.contact[i].gap, INSERT_VALUES));
  }
  check(VecAssemblyBegin(field));
  check(VecAssemblyEnd(field));
  return field;
}

/// Collective. Returns a nodal vector with the contribution of friction at the pad nodes to the
/// growth rate of a mode, 1/s, in component 0, and per area, 1/(s·m²), in component 1.
OwnedVec workField(const analysis::Analysis& analysis, const pencil::Shape& shape) {
  const auto& mesh = *analysis.model.mesh;
  OwnedVec field = elasticity::nodalVector(mesh);
  for (std::size_t i = 0; i < shape.frictionWork.size(); ++i) {
    const auto& node = analysis.model.contact.interfaces.nodes[i];
    const PetscInt row = mesh.dimension * (mesh.firstNode + node.surfaceNode);
    check(VecSetValue(field, row, shape.frictionWork[i], INSERT_VALUES));
    check(VecSetValue(field, row + 1, shape.frictionWork[i] / node.area, INSERT_VALUES));
  }
  check(VecAssemblyBegin(field));
  check(VecAssemblyEnd(field));
  return field;
}

struct Animated {
  double growth;
  const pencil::ComplexModes* point;
  const pencil::Shape* shape;
};

std::vector<Animated> fastest(const analysis::Analysis& analysis, int count) {
  std::vector<Animated> all;
  for (const auto& segment : analysis.flutter.segments)
    for (const auto& point : segment.points)
      for (const auto& shape : point.shapes)
        all.push_back({point.eigenvalues[shape.index].s.real(), &point, &shape});
  std::sort(all.begin(), all.end(),
            [](const auto& a, const auto& b) { return a.growth > b.growth; });
  all.resize(std::min<std::size_t>(all.size(), count));
  return all;
}

std::string shapeName(const pencil::ComplexModes& point, const pencil::Shape& shape) {
  return formatted("mode_%03zu_%.0f_Hz", shape.index + 1,
                   point.eigenvalues[shape.index].s.imag() / (2 * M_PI));
}

/// Collective. Writes
///   Re(d e^{iφ})
/// over one period, for playback in ParaView. The growth is omitted, since it would hide the shape.
void animate(const analysis::Analysis& analysis, const Settings& settings, const Ghosts& ghosts,
             const Animated& item, const std::filesystem::path& folder) {
  const int frames = settings.frames;
  const double period = 2 * M_PI / item.point->eigenvalues[item.shape->index].s.imag();
  if (!std::isfinite(period)) return;  // divergence does not oscillate
  const std::string name =
      "squeal_friction_" + pointName(item.point->at) + "_" + shapeName(*item.point, *item.shape);
  std::vector<std::pair<double, std::filesystem::path>> files;
  OwnedVec u;
  check(VecDuplicate(item.shape->real, u.out()));
  for (int frame = 0; frame <= frames; ++frame) {
    const double phase = 2 * M_PI * frame / frames;
    check(VecCopy(item.shape->real, u));
    check(VecScale(u, std::cos(phase)));
    check(VecAXPY(u, -std::sin(phase), item.shape->imaginary));
    const auto stem = folder / name / formatted("frame_%03d", frame);
    writeVtk(*analysis.model.mesh, stem, {ghosts.vector("displacement", u)}, settings.pieces);
    files.emplace_back(period * frame / frames, stem.string() + ".pvtu");
  }
  fieldfile::writePvd(analysis.model.mesh->comm, folder / (name + ".pvd"), files, folderOption);
}

void writeParameters(Hdf5File& file, const std::string& group, const sweep::Parameters& at) {
  for (const auto& parameter : sweep::allParameters)
    file.writeAttribute(group, parameter.name, at.*parameter.value);
}

/// Collective. Writes the tracked branches and the path of the contact, if there are any.
void writePath(const analysis::Analysis& analysis, Hdf5File& file) {
  if (auto rows = branchRows(analysis); !rows.empty())
    file.writeTable(
        "/path", "branches",
        {"active_set", "branch", "friction", "speed", "pressure", "damping", "growth_rate_1_per_s",
         "angular_frequency_rad_per_s", "overlap", "in_band", "swept"},
        rows);
  const auto events = analysis::contactPath(analysis);
  if (events.empty()) return;
  std::vector<std::vector<double>> rows;
  for (const auto& [order, at, x, interface, change] : events)
    rows.push_back({at.friction, at.speed, at.pressure, x[0], x[1], x[2], double(interface),
                    static_cast<double>(change)});
  file.writeTable("/path", "contact",
                  {"friction", "speed", "pressure", "x_m", "y_m", "z_m", "interface", "change"},
                  rows);
  file.writeAttribute("/path/contact", "interfaces",
                      joined(analysis.model.contact.interfaces.names));
}

/// Collective. Writes the axes of materials at the centres of their cells, zero where a material is
/// isotropic, if any is not.
void writeAxes(const mesh::Mesh& mesh, const std::vector<material::Material>& materials,
               const Settings& settings, const std::filesystem::path& stem) {
  const auto isIsotropic = [](const auto& material) { return !material.axes; };
  if (std::ranges::all_of(materials, isIsotropic)) return;
  std::vector<Field> fields{{"axis_1", 3, {}}, {"axis_2", 3, {}}, {"axis_3", 3, {}}};
  for (const auto& block : mesh.cells)
    for (std::size_t e = 0; e < block.tag.size(); ++e) {
      mesh::Point centre{};
      for (const PetscInt node : block.nodesOf(e))
        centre = mesh::plus(centre, mesh.coordinates[node], 1.0 / block.nodesPerCell);
      const auto& axesAt = materials[block.material[e]].axes;
      const auto axes = axesAt ? axesAt(centre) : material::Axes{};
      for (std::size_t k = 0; k < 3; ++k)
        fields[k].values.insert(fields[k].values.end(), axes[k].begin(), axes[k].end());
    }
  fieldfile::writeVtu(mesh, stem, {}, folderOption, settings.pieces, fields);
}

}  // namespace

void writeVtk(const mesh::Mesh& mesh, const std::filesystem::path& stem,
              const std::vector<Field>& fields, int pieces) {
  fieldfile::writeVtu(mesh, stem, fields, folderOption, pieces);
}

void writeFields(const analysis::Analysis& analysis, const Settings& settings,
                 const std::filesystem::path& folder) {
  const auto& mesh = *analysis.model.mesh;
  const auto vtk = folder / "vtk";
  const Ghosts ghosts(mesh);
  writeAxes(mesh, analysis.model.bodies.materials, settings, vtk / "materials");
  std::vector<std::pair<double, std::filesystem::path>> steadyFiles;
  for (const auto& solution : analysis.steady.solutions) {
    if (!solution.converged) continue;
    const auto stem = vtk / ("steady_friction_" + pointName(solution.at));
    writeVtk(mesh, stem,
             {ghosts.vector("displacement", solution.displacement),
              ghosts.scalar("contact_pressure", contactField(analysis, solution))},
             settings.pieces);
    // ParaView's time is the friction or, if several states have the same friction, the index of
    // the file.
    const bool frictionAlone = analysis.sweep.frictions.size() == analysis.steady.solutions.size();
    steadyFiles.emplace_back(frictionAlone ? solution.at.friction : steadyFiles.size(),
                             stem.string() + ".pvtu");
  }
  fieldfile::writePvd(mesh.comm, vtk / "steady.pvd", steadyFiles, folderOption);
  for (const auto& segment : analysis.flutter.segments) {
    std::vector<Field> fields;
    for (std::size_t i = 0; i < segment.shapes.size(); ++i)
      fields.push_back(ghosts.vector(
          formatted("mode_%03zu_%.0f_Hz", i + 1, segment.modes.angularFrequency[i] / (2 * M_PI)),
          segment.shapes[i]));
    if (!fields.empty())
      writeVtk(mesh, vtk / ("modes_from_friction_" + pointName(segment.points.front().at)), fields,
               settings.pieces);
    for (const auto& point : segment.points) {
      std::vector<Field> shapes;
      for (const auto& shape : point.shapes) {
        shapes.push_back(ghosts.vector(shapeName(point, shape) + "_real", shape.real));
        shapes.push_back(ghosts.vector(shapeName(point, shape) + "_imaginary", shape.imaginary));
        shapes.push_back(ghosts.scalar(shapeName(point, shape) + "_friction_work_per_area",
                                       workField(analysis, shape), 1));
      }
      if (!shapes.empty())
        writeVtk(mesh, vtk / ("complex_modes_friction_" + pointName(point.at)), shapes,
                 settings.pieces);
    }
  }
  for (const auto& item : fastest(analysis, settings.animated))
    animate(analysis, settings, ghosts, item, vtk);
  writeRegimeFields(analysis, ghosts, vtk, settings.pieces);
}

/// The shares of the components in some modes, [mode], with their numbers.
struct ShareTable {
  std::vector<int> mode;
  std::vector<const std::vector<pencil::Component>*> components;  // borrowed
};

/// Writes the shares as the dataset `components` of a group: a row for each mode and component. Its
/// attribute `components` names these, "body disc,interface pad".
void writeShares(Hdf5File& file, const std::string& group, const ShareTable& table) {
  std::vector<std::vector<double>> rows;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < table.mode.size(); ++i)
    for (const auto& one : *table.components[i]) {
      const std::string name = one.kind + " " + one.name;
      const auto known = std::ranges::find(names, name);
      const double index = double(known - names.begin());
      if (known == names.end()) names.push_back(name);
      rows.push_back({double(table.mode[i]), index, one.strain, one.kinetic});
      for (const auto& column : growthColumns) rows.back().push_back(one.growth.*column.value);
    }
  if (rows.empty()) return;
  std::vector<std::string> columns{"mode", "component", "strain_share", "kinetic_share"};
  for (const auto& column : growthColumns) columns.push_back(column.name);
  file.writeTable(group, "components", columns, rows);
  file.writeAttribute(group + "/components", "components", joined(names, ","));
}

void writeHdf5(const analysis::Analysis& analysis, const std::filesystem::path& folder) {
  Hdf5File file(analysis.comm, folder / "results.h5", folderOption);
  if (analysis.model.mesh) file.writeMesh(*analysis.model.mesh);
  for (const auto& solution : analysis.steady.solutions) {
    if (!solution.converged) continue;
    const std::string group = "/steady/friction_" + pointName(solution.at);
    file.writeNodeVector(group, "displacement", solution.displacement);
    file.writeNodeVector(group, "contact_pressure_gap", contactField(analysis, solution));
    writeParameters(file, group, solution.at);
  }
  for (std::size_t s = 0; s < analysis.flutter.segments.size(); ++s) {
    const auto& segment = analysis.flutter.segments[s];
    const std::string modesGroup = formatted("/modes/active_set_%zu", s + 1);
    std::vector<std::vector<double>> frequencies;
    for (std::size_t i = 0; i < segment.modes.angularFrequency.size(); ++i)
      frequencies.push_back({segment.modes.angularFrequency[i], segment.modes.relativeResidual[i]});
    file.writeTable(modesGroup, "frequencies", {"angular_frequency_rad_per_s", "relative_residual"},
                    frequencies);
    ShareTable free;
    for (std::size_t i = 0; i < segment.components.size(); ++i)
      free.mode.push_back(i + 1), free.components.push_back(&segment.components[i]);
    writeShares(file, modesGroup, free);
    for (std::size_t i = 0; i < segment.shapes.size(); ++i)
      file.writeNodeVector(modesGroup, formatted("mode_%03zu", i + 1), segment.shapes[i]);
    for (const auto& point : segment.points) {
      const std::string group = "/flutter/friction_" + pointName(point.at);
      std::vector<std::vector<double>> rows;
      for (const auto& e : point.eigenvalues)
        rows.push_back({e.s.real(), e.s.imag(), e.backwardError, e.errorEstimate(),
                        e.certified ? 1.0 : 0.0, double(e.verdict)});
      file.writeTable(group, "eigenvalues",
                      {"growth_rate_1_per_s", "angular_frequency_rad_per_s", "backward_error",
                       "error_estimate", "certified", "verdict"},
                      rows);
      std::vector<std::string> verdicts;
      for (const auto verdict : pencil::allVerdicts) verdicts.push_back(text(verdict));
      file.writeAttribute(group + "/eigenvalues", "verdicts", joined(verdicts, ","));
      writeParameters(file, group, point.at);
      ShareTable stored;
      for (const auto& shape : point.shapes)
        stored.mode.push_back(shape.index + 1), stored.components.push_back(&shape.components);
      writeShares(file, group, stored);
      for (const auto& shape : point.shapes) {
        file.writeNodeVector(group, formatted("mode_%03zu_real", shape.index + 1), shape.real);
        file.writeNodeVector(group, formatted("mode_%03zu_imaginary", shape.index + 1),
                             shape.imaginary);
        if (analysis.model.mesh)
          file.writeNodeVector(group, formatted("mode_%03zu_friction_work", shape.index + 1),
                               workField(analysis, shape));
      }
    }
  }
  writePath(analysis, file);
  writeRegimeFields(analysis, file);
  file.close();
}

}  // namespace squeal::report
