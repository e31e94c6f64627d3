// SPDX-License-Identifier: BSD-2-Clause
// Eigenvalue tables and friction work in results.h5 and in the files for ParaView, read back as
// numbers.
#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/system/text.hpp"
#include "run/report/fields.hpp"
#include "run/report/names.hpp"
#include "run/report/sensitivities.hpp"
#include "support/harness/hdf5_reader.hpp"
#include "support/harness/scratch_folder.hpp"
#include "support/harness/vtu_reader.hpp"
#include "support/run/bar_mesh.hpp"
#include "support/run/case.hpp"

namespace squeal::report {
namespace {

using namespace test;

/// The pad on springs between the disc below and a plate that slides the other way above: two
/// interfaces.
const std::string layers =
    "-mesh_file meshes/two_layers.geo -mesh_set nx=8,ny_disc=3,ny_pad=2 -material_disc_young 1 "
    "-material_disc_poisson 0.3 "
    "-material_disc_density 1 -material_pad_young 0.4 -material_pad_poisson 0.25 "
    "-material_pad_density 0.6 "
    "-motion_disc_velocity 1,0,0 -ground_pad_stiffness 3,0 -constraint_disc_bottom_clamped xy "
    "-constraint_disc_right_image_of disc_left -constraint_pad_right_image_of pad_left "
    "-contact_below_pad pad_face "
    "-contact_below_disc disc_face -contact_above_pad pad_top -contact_above_obstacle_velocity "
    "0.5,0,0 "
    "-contact_above_obstacle_displacement 0,-0.01,0 -modes_count 30 -flutter_friction 0.2,0.5 ";

// Rows of all eigenvalues: as many as in memory, and the same to the bit.
TEST(Fields, EigenvaluesWithErrorsAndCertification) {
  const std::vector<std::pair<std::string, double>> runs{
      {"", 1},
      {"-flutter_accuracy 1e-30 -flutter_rounds 1", 0},
      {"-flutter_method direct -flutter_direct_count 10", 1}};
  for (const auto& [change, certified] : runs) {
    const analysis::Analysis analysis = test::runOptions(layers + change);
    const Folder folder;
    writeHdf5(analysis, folder.path);
    Reader reader(folder.path / "results.h5");
    for (const auto& point : analysis.flutter.segments.at(0).points) {
      const std::string group = "/flutter/friction_" + pointName(point.at);
      EXPECT_EQ(reader.text(group + "/eigenvalues", "columns"),
                "growth_rate_1_per_s,angular_frequency_rad_per_s,backward_error,error_estimate,"
                "certified,verdict");
      EXPECT_EQ(reader.text(group + "/eigenvalues", "verdicts"),
                "unstable,stable,undecided,neutral,uncertified");
      const auto [values, columns] = reader.reals(group, "eigenvalues");
      EXPECT_EQ(columns, 6);
      EXPECT_GE(point.eigenvalues.size(), 10U);
      EXPECT_EQ(values.size(), 6 * point.eigenvalues.size());
      if (rankOf(PETSC_COMM_WORLD) > 0 || values.size() != 6 * point.eigenvalues.size())
        continue;  // rank 0 gave the rows
      for (std::size_t i = 0; i < point.eigenvalues.size(); ++i) {
        const auto& e = point.eigenvalues[i];
        const double* row = &values[6 * i];
        EXPECT_EQ(row[0], e.s.real());
        EXPECT_EQ(row[1], e.s.imag());
        EXPECT_EQ(row[2], e.backwardError);
        if (std::isnan(e.errorEstimate()))
          EXPECT_TRUE(std::isnan(row[3]) && change.find("direct") != std::string::npos);
        else
          EXPECT_EQ(row[3], e.errorEstimate());
        EXPECT_EQ(row[4], certified);
        EXPECT_EQ(pencil::allVerdicts.at(std::size_t(row[5])), e.verdict);
      }
    }
  }
}

/// What is known of the nodes of the mesh, the same on all ranks: [global node].
struct ContactNodes {
  std::vector<double> interface;  ///< index from 1; 0: no contact node
  std::vector<double> area;       ///< m
};

/// Collective.
ContactNodes contactNodes(const analysis::Analysis& analysis) {
  const auto total = static_cast<std::size_t>(analysis.model.mesh->totalNodes);
  ContactNodes nodes{std::vector<double>(total, 0.0), std::vector<double>(total, 0.0)};
  for (const auto& node : analysis.model.contact.interfaces.nodes) {
    nodes.interface[node.globalNode] = node.interface + 1;
    nodes.area[node.globalNode] = node.area;
  }
  for (auto* list : {&nodes.interface, &nodes.area})
    check(MPI_Allreduce(MPI_IN_PLACE, list->data(), static_cast<int>(total), MPI_DOUBLE, MPI_SUM,
                        PETSC_COMM_WORLD));
  return nodes;
}

/// Friction work by friction and mode, and for each interface: the rows of friction_work.csv.
std::map<std::pair<double, int>, std::map<std::string, double>> tabled(
    const analysis::Analysis& analysis) {
  std::map<std::pair<double, int>, std::map<std::string, double>> rows;
  for (const auto& line : split(frictionWorkTable(analysis), '\n')) {
    const auto cells = split(line, ',');
    if (cells.size() == 9 && cells[0] != "friction")
      rows[{std::stod(cells[0]), std::stoi(cells[4])}][cells[7]] = std::stod(cells[8]);
  }
  return rows;
}

/// The friction work per area of a mode at each global node, from the files for ParaView.
std::vector<double> workPerArea(const std::filesystem::path& file, const std::string& mode,
                                const std::vector<PetscInt>& tags) {
  const auto grid = readVtu(file);
  auto* points = grid->GetPointData();
  vtkDataArray* field = nullptr;
  for (int i = 0; i < points->GetNumberOfArrays(); ++i) {
    const std::string name = points->GetArrayName(i);
    if (name.starts_with(mode) && name.ends_with("_friction_work_per_area"))
      field = points->GetArray(i);
  }
  std::vector<double> values(tags.size(), NAN);
  std::map<PetscInt, double> byTag;
  for (vtkIdType i = 0; field && i < grid->GetNumberOfPoints(); ++i) {
    const auto tag = static_cast<PetscInt>(points->GetArray("node_tag")->GetTuple1(i));
    const auto [entry, isNew] = byTag.emplace(tag, field->GetTuple1(i));
    EXPECT_TRUE(isNew || entry->second == field->GetTuple1(i)) << "node " << tag << " of two ranks";
  }
  for (std::size_t node = 0; node < tags.size(); ++node)
    if (const auto entry = byTag.find(tags[node]); entry != byTag.end())
      values[node] = entry->second;
  return values;
}

// The fields, summed over the contact nodes of an interface, are the rows of friction_work.csv, and
// zero elsewhere; undamped bodies take nothing, so that all interfaces together make the growth
// rate.
TEST(Fields, FrictionWorkIsThatOfTheTable) {
  const analysis::Analysis analysis = test::runOptions(layers);
  const auto nodes = contactNodes(analysis);
  const auto table = tabled(analysis);
  const Folder folder;
  writeHdf5(analysis, folder.path);
  writeFields(analysis, {}, folder.path);
  Reader reader(folder.path / "results.h5");
  const auto tags = reader.integers("/mesh", "node_tag").first;
  EXPECT_EQ(tags.size(), nodes.interface.size());
  std::size_t modes = 0;
  for (const auto& point : analysis.flutter.segments.at(0).points)
    for (const auto& shape : point.shapes) {
      const int mode = static_cast<int>(shape.index) + 1;
      const auto [work, columns] = reader.reals("/flutter/friction_" + pointName(point.at),
                                                formatted("mode_%03d_friction_work", mode));
      const auto perArea = workPerArea(
          folder.path / "vtk" / ("complex_modes_friction_" + pointName(point.at) + ".pvtu"),
          formatted("mode_%03d_", mode), tags);
      EXPECT_EQ(columns, 2);
      EXPECT_EQ(work.size(), 2 * tags.size());
      if (work.size() != 2 * tags.size()) continue;
      std::vector<double> sums(3, 0.0), fromAreas(3, 0.0);  // [0]: no contact node
      double magnitudes = 0, growth = 0;
      for (std::size_t node = 0; node < tags.size(); ++node) {
        const auto place = static_cast<std::size_t>(nodes.interface[node]);
        sums[place] += place == 0 ? std::abs(work[2 * node]) : work[2 * node];
        fromAreas[place] += place == 0 ? std::abs(perArea[node]) : perArea[node] * nodes.area[node];
        magnitudes += std::abs(work[2 * node]);
      }
      EXPECT_EQ(sums[0], 0);
      EXPECT_EQ(fromAreas[0], 0);
      for (std::size_t i = 0; i < 2; ++i) {
        const double wanted =
            table.at({point.at.friction, mode}).at(analysis.model.contact.interfaces.names.at(i));
        growth += wanted;
        EXPECT_NEAR(sums[i + 1], wanted,
                    1e-9 * std::abs(wanted) + 1e-14 * magnitudes);  // ten digits in the table
        EXPECT_NEAR(fromAreas[i + 1], wanted, 1e-7 * magnitudes);   // single precision in VTK
        EXPECT_GT(std::abs(wanted), 1e-4 * magnitudes);
      }
      test::print("friction %g, mode %d: %s %.6g, %s %.6g, growth rate %.6g\n", point.at.friction,
                  mode, analysis.model.contact.interfaces.names[0].c_str(), sums[1],
                  analysis.model.contact.interfaces.names[1].c_str(), sums[2],
                  point.eigenvalues[shape.index].s.real());
      const auto s = point.eigenvalues[shape.index].s;
      EXPECT_NEAR(growth, s.real(), 1e-8 * std::abs(s));
      ++modes;
    }
  EXPECT_GE(modes, 4U);
  EXPECT_EQ(table.size(), modes);
}

}  // namespace
}  // namespace squeal::report
