// SPDX-License-Identifier: BSD-2-Clause
// Files that exist and cannot be read: the error gives the reason, and does not report an error of
// the file system as a mistake in the file.
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <functional>

#include "base/options/options.hpp"
#include "problem/matrices/read.hpp"
#include "support/harness/messages.hpp"
#include "support/model/mesh_text.hpp"
#include "support/model/model.hpp"
#include "support/problem/matrix_files.hpp"

namespace squeal::test {
namespace {

namespace fs = std::filesystem;

/// The tests may run as root, whom permissions do not bind: during its lifetime this object lowers
/// the rights to those of another user.
class Unprivileged {
 public:
  Unprivileged() {
    if (geteuid() == 0 && seteuid(65534) != 0) std::abort();
  }
  ~Unprivileged() {
    if (getuid() == 0 && seteuid(0) != 0) std::abort();
    prctl(PR_SET_DUMPABLE,
          1);  // MPI's ranks read each other's memory, which a change of user forbids
  }
  Unprivileged(const Unprivileged&) = delete;
};

std::string errorOfUnprivileged(const std::function<void()>& action) {
  const Unprivileged here;
  return errorOf(action);
}

/// Collective. Makes a file or folder without any permissions.
std::string withoutRights(const std::string& name) {
  return written(name, [](const auto& path) { chmod(path.c_str(), 0); });
}

bool permissionsBind(const std::string& path) {
  const Unprivileged here;
  return !std::ifstream(path);
}

std::string errorOfOptions(const std::string& options) {
  setOptions(options);
  return errorOfUnprivileged([] { rejectUnknownOptions(); });
}

TEST(Unreadable, FilesWithoutPermissionSaySo) {
  const std::string layer = material("layer", "1", "0.3", "1"), denied = "Permission denied";
  const std::string market = "%%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 1\n";
  for (const auto& [name, text] : {std::pair{"denied.yaml", std::string("quiet: on\n")},
                                   {"denied.msh", quadranglesMsh2()},
                                   {"denied.unv", quadranglesUnv()},
                                   {"denied.geo", std::string("Point(1) = {0, 0, 0};\n")},
                                   {"denied.mtx", market},
                                   {"denied.mat", market},
                                   {"denied.petsc", market},
                                   {"denied.h5", market}}) {
    if (rankHere() == 0) fs::remove(SQUEAL_OUTPUT_DIR "/" + std::string(name));
    writeFile(name, text);
    const std::string file = withoutRights(name), ending = fs::path(file).extension();
    if (!permissionsBind(file)) GTEST_SKIP() << "the permissions of files do not bind here";
    const std::string why = std::string(name) + ": cannot be read: " + denied;
    if (ending == ".yaml") {
      expectMessage(errorOfUnprivileged([&] { settingsOfFile(file); }), {"-options_file", why});
    } else if (ending == ".msh" || ending == ".unv" || ending == ".geo") {
      expectMessage(errorOfOptions("-mesh_file " + file), {"option -mesh_file", why});
      expectMessage(errorOfUnprivileged([&] {
                      const std::string message = messageOfMesh(file, layer);
                      if (!message.empty()) throw Error(message);
                    }),
                    {"option -mesh_file", why});
    } else {
      expectMessage(errorOfOptions("-matrices_m_role mass -matrices_m_file " + file),
                    {"option -matrices_m_file", why});
      expectMessage(errorOfUnprivileged([&] { matrices::read(PETSC_COMM_WORLD, file); }), {why});
    }
  }
}

// A file in a folder that cannot be entered may exist; the message must not deny it.
TEST(Unreadable, FoldersThatCannotBeEntered) {
  const std::string shut = SQUEAL_OUTPUT_DIR "/shut";
  if (rankHere() == 0) {
    fs::create_directories(shut);
    fs::permissions(shut, fs::perms::owner_all);
    std::ofstream(shut + "/inside.yaml") << "quiet: on\n";
    std::ofstream(shut + "/inside.msh") << quadranglesMsh2();
  }
  withoutRights("shut");
  if (!permissionsBind(shut + "/inside.msh"))
    GTEST_SKIP() << "the permissions of folders do not bind here";
  const std::string why = ": cannot be read: Permission denied";
  expectMessage(errorOfUnprivileged([&] { settingsOfFile(shut + "/inside.yaml"); }),
                {"option -options_file", "inside.yaml" + why});
  expectMessage(errorOfOptions("-mesh_file " + shut + "/inside.msh"),
                {"option -mesh_file", "inside.msh" + why});
  expectMessage(errorOfUnprivileged([&] { matrices::read(PETSC_COMM_WORLD, shut + "/x.mtx"); }),
                {"x.mtx" + why});
  // The home folder of another user contains no options for this user.
  const std::string home = std::getenv("HOME") ? std::getenv("HOME") : "";
  setenv("HOME", shut.c_str(), 1);
  EXPECT_EQ(errorOfUnprivileged([] { settingsOfCall({"-quiet"}); }), "");
  setenv("HOME", home.c_str(), 1);
  check(MPI_Barrier(PETSC_COMM_WORLD));
  if (rankHere() == 0) fs::permissions(shut, fs::perms::owner_all);  // so that it can be removed
}

// PETSc itself ignores such a file, and runs without its options.
TEST(Unreadable, OptionsOfTheHomeFolderAreNotPassedOver) {
  if (rankHere() == 0) {
    fs::create_directories(SQUEAL_OUTPUT_DIR "/of_a_user");
    fs::remove(SQUEAL_OUTPUT_DIR "/of_a_user/.petscrc");
  }
  writeFile("of_a_user/.petscrc", "-modes_count 7\n");
  const std::string file = withoutRights("of_a_user/.petscrc");
  if (!permissionsBind(file)) GTEST_SKIP() << "the permissions of files do not bind here";
  const std::string home = std::getenv("HOME") ? std::getenv("HOME") : "";
  setenv("HOME", SQUEAL_OUTPUT_DIR "/of_a_user", 1);
  expectMessage(errorOfUnprivileged([] { settingsOfCall({"-quiet"}); }),
                {"of_a_user/.petscrc: cannot be read: Permission denied"});
  EXPECT_EQ(errorOfUnprivileged([] { settingsOfCall({"-skip_petscrc", "-quiet"}); }), "");
  setenv("HOME", home.c_str(), 1);
}

TEST(Unreadable, LinksToNothingNameTheirTarget) {
  const auto link = [](const std::string& name) {
    return written(name, [](const auto& path) {
      fs::remove(path);
      fs::create_symlink("moved_away", path);
    });
  };
  const std::string why = ": it is a link to 'moved_away': No such file or directory";
  for (const std::string ending : {".msh", ".unv", ".geo"}) {
    const std::string name = "dangling" + ending, file = link(name);
    expectMessage(messageOfMesh(file, material("layer", "1", "0.3", "1")), {name + why});
    expectMessage(errorOfOptions("-mesh_file " + file), {name + why});
  }
  const std::string options = link("dangling.yaml"), matrix = link("dangling.mtx");
  expectMessage(errorOf([&] { settingsOfFile(options); }), {"dangling.yaml" + why});
  expectMessage(errorReading(matrix), {"dangling.mtx" + why});
  // The link next to the options file is used, although it is broken.
  const auto beside = writeFile("beside_link.yaml", "mesh_file: dangling.msh\n");
  clearOptions();
  insertFile(PETSC_COMM_WORLD, beside);
  expectMessage(errorOf([] { rejectUnknownOptions(); }), {"beside_link.yaml, line 1", why});
}

TEST(Unreadable, PipesAndSocketsAreNoMeshes) {
  for (const std::string name : {"pipe.msh", "pipe.geo"}) {
    const auto file = written(name, [](const auto& path) {
      fs::remove(path);
      mkfifo(path.c_str(), 0666);
    });
    expectMessage(messageOfMesh(file, material("layer", "1", "0.3", "1")),
                  {name + ": not a regular file"});
  }
}

TEST(Unreadable, FilesBelowFiles) {
  const std::string below = writeFile("a_file", "") + "/x";
  expectMessage(errorOfOptions("-mesh_file " + below + ".msh"),
                {"cannot be read: Not a directory"});
  expectMessage(errorOf([&] { settingsOfFile(below + ".yaml"); }),
                {"cannot be read: Not a directory"});
}

}  // namespace
}  // namespace squeal::test
