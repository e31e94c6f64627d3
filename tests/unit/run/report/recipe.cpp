// SPDX-License-Identifier: BSD-2-Clause
// The record of the options of a run is an options file that repeats the run.
#include "run/report/recipe.hpp"

#include <gtest/gtest.h>

#include "base/options/options.hpp"
#include "base/options/settings.hpp"
#include "support/harness/messages.hpp"
#include "support/harness/program.hpp"
#include "support/harness/scratch_folder.hpp"
#include "support/model/model.hpp"

namespace squeal::test {
namespace {

using Values = std::map<std::string, std::string>;

/// Collective. Writes the record into a folder and returns its text, on all ranks.
std::string recipe(const Folder& folder) {
  report::writeRecipe(PETSC_COMM_WORLD, folder.path);
  MPI_Barrier(PETSC_COMM_WORLD);
  return contentOf(folder.path / "options.txt");
}

/// Returns the settings of an options file.
Values settingsIn(const fs::path& file) {
  Values values;
  for (const auto& setting : settingsOfCall({"-options_file", file.string()}))
    values[setting.name] = setting.value;
  return values;
}

// The settings that are given come back as they were, quotes and blanks included, except those that
// name this run, its folder and its protocols; files have absolute paths.
TEST(Recipe, RepeatsTheRun) {
  setOptions(
      "-mesh_file meshes/../meshes/layer.geo -flutter_friction '0, 0.2' -quiet -report_dir a "
      "-resume -progress p.txt -log_json l.json -mesh_set \"nx=2\" -material_layer_name \"it's\"");
  const Folder folder;
  const std::string text = recipe(folder);
  EXPECT_EQ(settingsIn(folder.path / "options.txt"),
            (Values{{"mesh_file", (fs::current_path() / "meshes/layer.geo").string()},
                    {"flutter_friction", "0, 0.2"},
                    {"quiet", ""},
                    {"mesh_set", "nx=2"},
                    {"material_layer_name", "it's"}}));
  EXPECT_EQ(text.rfind("# squeal ", 0), 0U);
  EXPECT_TRUE(contains(text, formatted(", %d ranks: the options of this run", sizeOf())));
  MPI_Barrier(PETSC_COMM_WORLD);  // before the folder goes
}

// An option that was read without being given is a comment with its default.
TEST(Recipe, ListsDefaultsAsComments) {
  setOptions("-flutter_speed 2");
  const auto settings = sweep::Settings::given();
  ASSERT_EQ(settings.frictions, std::vector{0.4});
  const Folder folder;
  const std::string text = recipe(folder);
  EXPECT_TRUE(contains(text, "\n# -flutter_friction 0.4\n")) << text;
  EXPECT_TRUE(contains(text, "\n-flutter_speed 2\n")) << text;
  EXPECT_FALSE(contains(text, "# -flutter_speed")) << text;
  EXPECT_FALSE(contains(text, "-report_dir")) << text;
  MPI_Barrier(PETSC_COMM_WORLD);
}

}  // namespace
}  // namespace squeal::test
