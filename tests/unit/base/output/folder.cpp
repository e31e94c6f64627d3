// SPDX-License-Identifier: BSD-2-Clause
// A run replaces a folder of results as a whole: its content before and after, and after
// termination at each step between.
#include "base/output/folder.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <set>

#include "support/base/output_folder.hpp"
#include "support/harness/messages.hpp"
#include "support/harness/scratch_folder.hpp"
#include "support/harness/shared_files.hpp"

namespace squeal::output {
namespace {

namespace fs = std::filesystem;
using test::both;
using test::errorOf;
using test::Files;
using test::shared::filesIn;
using test::shared::first;
using test::shared::isThere;
using test::shared::put;

/// A run whose files have these names, and are in these folders.
Naming naming() {
  return {.option = "-to", .last = "summary.txt", .mayWrite = [](const fs::path& path) {
            static const std::set<fs::path> names{"a.csv",     "summary.txt", Manifest::name, "vtk",
                                                  "vtk/x.vtu", "vtk/y",       "vtk/z"};
            return names.contains(path);
          }};
}

void run(const fs::path& folder, const Files& results) { test::replace(naming(), folder, results); }

Files without(Files files, const std::string& name) {
  files.erase(name);
  return files;
}

const Files old{
    {"a.csv", "old"}, {"vtk/x.vtu", "old"}, {"vtk/y/y.vtu", "old"}, {"summary.txt", "old"}};
const Files fresh{
    {"a.csv", "new"}, {"vtk/x.vtu", "new"}, {"vtk/z/z.vtu", "new"}, {"summary.txt", "new"}};
const Files mine{{"notes.csv", "mine"}, {"vtk/mine.vtu", "mine"}, {"own/a.csv", "mine"}};

TEST(Folder, ReplacesWhatAnEarlierRunListsAndNothingElse) {
  const test::Folder place;
  const fs::path folder = place.path / "made" / "for it";
  run(folder, old);
  EXPECT_EQ(without(filesIn(folder), Manifest::name), old);
  put(folder, mine);
  run(folder, fresh);
  EXPECT_EQ(without(filesIn(folder), Manifest::name), both(fresh, mine));
  EXPECT_FALSE(isThere(folder / "vtk" / "y"));  // belonged only to the earlier run, and is empty
  run(folder,
      {{"summary.txt", "third"}});  // vtk/ stays with the user's file, and is listed as ours
  EXPECT_EQ(without(filesIn(folder), Manifest::name), both({{"summary.txt", "third"}}, mine));
  run(folder, fresh);
  EXPECT_EQ(without(filesIn(folder), Manifest::name), both(fresh, mine));
}

TEST(Folder, StaysAsItWasWithoutCommit) {
  const test::Folder place;
  const fs::path folder = place.path / "results";
  {
    Folder open(PETSC_COMM_WORLD, naming(), folder);
    open.stage();
    put(open.staging(), fresh);
  }
  EXPECT_FALSE(isThere(folder));  // it was not there before
  run(folder, old);
  const Files before = filesIn(folder);
  {
    Folder open(PETSC_COMM_WORLD, naming(), folder);
    open.stage();
    put(open.staging(), fresh);
    EXPECT_EQ(filesIn(folder).count(Lock::name), 1U);
  }
  EXPECT_EQ(filesIn(folder), before);
}

TEST(Folder, RefusesWhatIsInTheWay) {
  for (const char* name :
       {"a.csv", "summary.txt", "vtk/x.vtu", "vtk/mine.vtu", "vtk", "manifest.txt"}) {
    const test::Folder place;
    put(place.path, {{name, "mine"}});
    EXPECT_NE(errorOf([&] { run(place.path, fresh); }).find("is in the way"), std::string::npos)
        << name;
    EXPECT_EQ(filesIn(place.path), (Files{{name, "mine"}}));
  }
}

TEST(Folder, RefusesWhatComesIntoTheWayDuringTheRun) {
  const test::Folder place;
  run(place.path, old);
  const Files before = filesIn(place.path);
  EXPECT_NE(errorOf([&] {
              Folder open(PETSC_COMM_WORLD, naming(), place.path);
              open.stage();
              put(open.staging(), both(fresh, {{"b.csv", "new"}}));
              put(place.path, {{"b.csv", "mine"}});
              open.commit();
            }).find("b.csv is in the way"),
            std::string::npos);
  EXPECT_EQ(filesIn(place.path), both(before, {{"b.csv", "mine"}}));
}

void putManifest(const fs::path& folder, const std::set<fs::path>& files) {
  put(folder, {{Manifest::name, Manifest(files).text()}});
}

// A run may be killed between any two steps of a commit: the next run completes it from any state.
TEST(Folder, FinishesACommitThatWasCutShort) {
  std::set<fs::path> oldNames, freshNames;
  for (const auto& [name, text] : old) oldNames.insert(name);
  for (const auto& [name, text] : fresh) freshNames.insert(name);
  struct State {
    const char* what;
    Files there, waiting;
    bool oldManifest, freshManifestWaits;
  };
  const std::vector<State> states{
      {"nothing moved", old, fresh, true, true},
      {"old summary gone", without(old, "summary.txt"), fresh, true, true},
      {"old files gone", {}, fresh, true, true},
      {"old manifest gone", {}, fresh, false, true},
      {"first file moved", {{"a.csv", "new"}}, without(fresh, "a.csv"), false, true},
      {"half of a folder moved",
       {{"a.csv", "new"}, {"vtk/x.vtu", "new"}},
       {{"vtk/z/z.vtu", "new"}, {"summary.txt", "new"}},
       false,
       true},
      {"manifest moved", without(fresh, "summary.txt"), {{"summary.txt", "new"}}, false, false},
      {"all moved", fresh, {}, false, false}};
  for (const auto& state : states) {
    SCOPED_TRACE(state.what);
    const test::Folder place;
    put(place.path, both(mine, state.there));
    if (state.oldManifest) putManifest(place.path, oldNames);
    put(place.path / ".complete", state.waiting);
    if (first()) fs::create_directory(place.path / ".complete");  // where it is empty
    putManifest(state.freshManifestWaits ? place.path / ".complete" : place.path, freshNames);
    { const Folder next(PETSC_COMM_WORLD, naming(), place.path); }
    EXPECT_EQ(without(filesIn(place.path), Manifest::name), both(fresh, mine));
    EXPECT_FALSE(isThere(place.path / ".complete"));
    run(place.path, old);
    EXPECT_EQ(without(filesIn(place.path), Manifest::name), both(old, mine));
  }
}

TEST(Folder, RemovesWhatAKilledRunLeft) {
  const test::Folder place;
  put(place.path / ".partial", fresh);
  put(place.path, {{Lock::name, ""}});
  { const Folder next(PETSC_COMM_WORLD, naming(), place.path); }
  EXPECT_EQ(filesIn(place.path), Files{});
}

TEST(Folder, RemovesNothingBehindALink) {
  const test::Folder place;
  const fs::path folder = place.path / "results", elsewhere = place.path / "elsewhere";
  run(folder, old);
  put(elsewhere, {{"x.vtu", "mine"}});
  if (first()) {
    fs::remove_all(folder / "vtk");
    fs::create_directory_symlink(elsewhere, folder / "vtk");
  }
  MPI_Barrier(PETSC_COMM_WORLD);
  EXPECT_NE(errorOf([&] { run(folder, fresh); }).find("vtk is in the way"), std::string::npos);
  {
    Naming needsNoFields = naming();
    needsNoFields.mayWrite = [](const fs::path& path) {
      return path == "a.csv" || path == "summary.txt";
    };
    Folder open(PETSC_COMM_WORLD, needsNoFields, folder);
    open.stage();
    put(open.staging(), {{"a.csv", "new"}, {"summary.txt", "new"}});
    open.commit();
  }
  EXPECT_EQ(filesIn(folder)["a.csv"], "new");
  EXPECT_EQ(filesIn(elsewhere), (Files{{"x.vtu", "mine"}}));
  EXPECT_TRUE(fs::is_symlink(folder / "vtk"));
}

TEST(Folder, RemovesNothingOutsideThatAManifestNames) {
  for (const char* path : {"../mine.txt", "/etc/hostname", "vtk/../../mine.txt"}) {
    const test::Folder place;
    put(place.path, {{"mine.txt", "mine"}});
    putManifest(place.path / "results", {path});
    EXPECT_NE(
        errorOf([&] { run(place.path / "results", fresh); }).find("not a path in this folder"),
        std::string::npos)
        << path;
    EXPECT_EQ(filesIn(place.path)["mine.txt"], "mine");
  }
}

TEST(Folder, IsForOneRunAtATime) {
  const test::Folder place;
  const int other = open((place.path / Lock::name).c_str(), O_RDWR | O_CREAT,
                         0666);  // as the file of another process would
  MPI_Barrier(PETSC_COMM_WORLD);
  const int taken = first() ? flock(other, LOCK_EX | LOCK_NB) : 0;
  EXPECT_EQ(taken, 0);
  MPI_Barrier(PETSC_COMM_WORLD);
  const std::string message = errorOf([&] { run(place.path, fresh); });
  EXPECT_NE(message.find("another run is writing to " + place.path.string()), std::string::npos)
      << message;
  EXPECT_NE(message.find("option -to"), std::string::npos) << message;
  MPI_Barrier(PETSC_COMM_WORLD);
  close(other);
  MPI_Barrier(PETSC_COMM_WORLD);
  run(place.path, fresh);
  {
    const Folder open(PETSC_COMM_WORLD, naming(), place.path);
    EXPECT_NE(errorOf([&] { run(place.path, old); }).find("another run is writing"),
              std::string::npos);
  }
  EXPECT_EQ(without(filesIn(place.path), Manifest::name), fresh);
}

}  // namespace
}  // namespace squeal::output
