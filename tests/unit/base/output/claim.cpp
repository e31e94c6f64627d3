// SPDX-License-Identifier: BSD-2-Clause
// Folders that a run may write to, and its reaction if anything except a regular file has the name
// of one of its own files.
#include "base/output/folder.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <functional>
#include <set>

#include "base/output/file.hpp"
#include "base/system/regular_file.hpp"
#include "support/base/output_folder.hpp"
#include "support/harness/messages.hpp"
#include "support/harness/scratch_folder.hpp"
#include "support/harness/shared_files.hpp"

namespace squeal::output {
namespace {

namespace fs = std::filesystem;
using test::errorOf;
using test::Files;
using test::shared::filesIn;
using test::shared::first;
using test::shared::isThere;
using test::shared::put;

/// A run whose files have these names.
Naming naming() {
  return {.option = "-to", .last = "summary.txt", .mayWrite = [](const fs::path& path) {
            return path == "a.csv" || path == "b.csv" || path == "summary.txt" ||
                   path == Manifest::name;
          }};
}

void run(const fs::path& folder, const Files& results) { test::replace(naming(), folder, results); }

const Files old{{"a.csv", "old"}, {"summary.txt", "old"}};
const Files fresh{{"a.csv", "new"}, {"summary.txt", "new"}};

// --- folders that a run accepts ---

TEST(Folder, TakesOneThatIsNewOrEmptyOrOurs) {
  const std::vector<std::pair<const char*, Files>> takable{
      {"empty", {}},
      {"lock of a killed run", {{Lock::name, ""}, {"notes.csv", "mine"}}},
      {"staging of a killed run", {{".partial/a.csv", "half"}}},
      {"manifest",
       {{Manifest::name, Manifest(std::set<fs::path>{}).text()}, {"notes.csv", "mine"}}},
      {"mark of the naming", {{"sub/mark", ""}, {"notes.csv", "mine"}}}};
  for (const auto& [what, files] : takable) {
    const test::Folder place;
    put(place.path, files);
    Naming marked = naming();
    marked.marks = {"sub/mark"};
    EXPECT_NO_THROW(Folder(PETSC_COMM_WORLD, marked, place.path / "")) << what;
    MPI_Barrier(PETSC_COMM_WORLD);
  }
}

TEST(Folder, RefusesOneWithFilesOfOthers) {
  for (const char* name : {"notes.csv", "sub/notes.csv", "sub/manifest.txt", ".hidden"}) {
    const test::Folder place;
    put(place.path, {{name, "mine"}});
    for (const fs::path& path : {place.path, place.path / "", place.path / "." / ""}) {
      const std::string message = errorOf([&] { run(path, fresh); });
      EXPECT_NE(message.find(place.path.string()), std::string::npos) << message;
      EXPECT_NE(
          message.find(" is not empty and contains no earlier results: a run writes only to a new"),
          std::string::npos)
          << message;
    }
    EXPECT_EQ(filesIn(place.path), (Files{{name, "mine"}}));
    Naming ofCase = naming();
    ofCase.ofCase = true;
    EXPECT_NO_THROW(Folder(PETSC_COMM_WORLD, ofCase, place.path));
    MPI_Barrier(PETSC_COMM_WORLD);
    ofCase.ofCase = false;
    ofCase.opened = {place.path / name};
    if (fs::path(name).has_parent_path()) continue;
    EXPECT_NO_THROW(Folder(PETSC_COMM_WORLD, ofCase, place.path));  // such as -log_json
    MPI_Barrier(PETSC_COMM_WORLD);
  }
}

TEST(Folder, RefusesTheRootAndWhatIsNoFolder) {
  const test::Folder place;
  put(place.path, {{"file", "mine"}});
  if (first()) {
    fs::create_symlink(place.path / "nowhere", place.path / "to_nothing");
    fs::create_symlink(place.path / "file", place.path / "to_file");
    fs::create_directory_symlink("/", place.path / "to_root");
    ASSERT_EQ(mkfifo((place.path / "pipe").c_str(), 0666), 0);
  }
  MPI_Barrier(PETSC_COMM_WORLD);
  Naming ofCase = naming();
  ofCase.ofCase = true;  // which makes no difference here
  for (const auto& [path, rule] : std::vector<std::pair<fs::path, std::string>>{
           {"/", "/ is the root of the file system"},
           {"//", "is the root of the file system"},
           {place.path / "to_root", "to_root is the root of the file system"},
           {place.path / "to_root" / "", "to_root is the root of the file system"},
           {"", "the name of the folder is empty"},
           {place.path / "file", "file is a regular file, not a folder"},
           {place.path / "file/sub", "file is a regular file, not a folder"},
           {place.path / "to_file", "to_file is a link, but not to a folder"},
           {place.path / "pipe", "pipe is a named pipe, not a folder"},
           {place.path / "to_nothing", "nowhere, which does not exist"},
           {place.path / "to_nothing/sub", "nowhere, which does not exist"}}) {
    const std::string message = errorOf([&] { Folder(PETSC_COMM_WORLD, ofCase, path); });
    EXPECT_NE(message.find(rule), std::string::npos) << path << ": " << message;
  }
  MPI_Barrier(PETSC_COMM_WORLD);
  EXPECT_EQ(contentOfRegular(place.path / "file"), "mine");
  Naming inside = naming();
  inside.inside = true;
  if (first()) fs::create_directory_symlink(place.path, place.path / "inner");
  MPI_Barrier(PETSC_COMM_WORLD);
  EXPECT_NE(errorOf([&] {
              Folder(PETSC_COMM_WORLD, inside, place.path / "inner");
            }).find("inner is a link, not a folder"),
            std::string::npos);
}

// --- other things with the name of a file of ours ---

/// Puts anything except a file of ours there, on rank 0. A hard link is one of the foreign
/// file.
void plant(const std::string& kind, const fs::path& path, const fs::path& foreign) {
  if (first()) {
    if (kind == "a link")
      fs::create_symlink(foreign, path);
    else if (kind == "a folder")
      fs::create_directory(path);
    else if (kind == "a named pipe") {
      EXPECT_EQ(mkfifo(path.c_str(), 0666), 0);
    } else
      fs::create_hard_link(foreign, path);
  }
  MPI_Barrier(PETSC_COMM_WORLD);
}

const std::vector<std::string> kinds{"a link", "a folder", "a named pipe", "a second name"};

TEST(Folder, OpensOnlyRegularFiles) {
  for (const auto& kind : kinds)
    for (const std::string name : {Lock::name, Manifest::name, "a.csv"}) {
      if (kind == "a second name") continue;  // the run writes to neither
      const test::Folder place;
      const fs::path folder = place.path / "results", foreign = place.path / "foreign";
      put(place.path, {{"foreign", "mine"}});
      run(folder, old);
      if (first()) fs::remove(folder / name);
      MPI_Barrier(PETSC_COMM_WORLD);
      plant(kind, folder / name, foreign);
      const std::string message = errorOf([&] { run(folder, fresh); });
      if (name == Lock::name)
        EXPECT_NE(message.find((folder / name).string() + " is " + kind + ", not a regular file"),
                  std::string::npos)
            << message;
      else if (name == Manifest::name ||
               kind == "a folder")  // without a manifest nothing belongs to a run
        EXPECT_NE(message.find(" is in the way"), std::string::npos) << kind << ": " << message;
      else  // a listed file belongs to the earlier run, and is removed, even if it is a link
        EXPECT_EQ(message, "") << kind;
      EXPECT_EQ(contentOfRegular(foreign), "mine") << kind << " " << name;
      MPI_Barrier(PETSC_COMM_WORLD);
    }
}

TEST(File, IsWrittenNeitherThroughALinkNorIntoAPipe) {
  for (const auto& kind : kinds) {
    const test::Folder place;
    const fs::path path = place.path / "a.csv", foreign = place.path / "foreign";
    put(place.path, {{"foreign", "mine"}});
    plant(kind, path, foreign);
    if (first()) {
      for (const auto& write : std::vector<std::function<void()>>{[&] { writeFile(path, "new"); },
                                                                  [&] { reserve(path, 10); }}) {
        std::string message;
        try {
          write();
        } catch (const WriteError& error) {
          message = error.what();
        }
        EXPECT_NE(message.find(path.string() + " is " + kind), std::string::npos) << message;
      }
      EXPECT_EQ(contentOfRegular(foreign), "mine") << kind;
    }
    MPI_Barrier(PETSC_COMM_WORLD);
  }
}

TEST(File, OfACommitIsRegular) {
  for (const auto& kind : kinds) {
    if (kind == "a folder" || kind == "a second name")
      continue;  // a file, and a folder, of the run
    const test::Folder place;
    put(place.path, {{"foreign", "mine"}});
    const fs::path folder = place.path / "results";
    const std::string message = errorOf([&] {
      Folder open(PETSC_COMM_WORLD, naming(), folder);
      open.stage();
      put(open.staging(), fresh);
      plant(kind, open.staging() / "b.csv", place.path / "foreign");
      open.commit();
    });
    EXPECT_NE(message.find("b.csv is " + kind + ", not a regular file"), std::string::npos)
        << message;
    EXPECT_FALSE(isThere(folder));
  }
}

}  // namespace
}  // namespace squeal::output
