// Matrices from files: every format gives the same matrix on every number of ranks, and what cannot be a problem of vibration is said.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <matio.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <tuple>

#include "matrices/formats.hpp"
#include "matrices/matrices.hpp"
#include "petsc/text.hpp"
#include "support/case.hpp"
#include "support/model.hpp"
#include "support/spectrum.hpp"

namespace squeal::test {
namespace {

// Unsymmetric, with an empty row, a full one, and a number that needs all its digits.
const std::array<std::array<double, 4>, 4> sample{{{1. / 3, 0, -2, 0}, {0, 0, 0, 0}, {5, 1e-300, 7, 8}, {0, 0, 0, -1e10 / 3}}};

matrices::Entries sampleEntries() {
  matrices::Entries entries{4, 4, {}, {}, {}};
  for (long long i = 0; i < 4; ++i)
    for (long long j = 0; j < 4; ++j) entries.add(i, j, sample[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]);
  return entries;
}

/// By rows, or by columns.
struct Lists {
  std::vector<double> data;
  std::vector<unsigned> indices, begin{0};
  explicit Lists(bool byColumns) {
    for (unsigned k = 0; k < 4; ++k) {
      for (unsigned l = 0; l < 4; ++l)
        if (const double x = byColumns ? sample[l][k] : sample[k][l]; x != 0) data.push_back(x), indices.push_back(l);
      begin.push_back(static_cast<unsigned>(data.size()));
    }
  }
};

bool firstRank() {
  int rank = 0;
  check(MPI_Comm_rank(PETSC_COMM_WORLD, &rank));
  return rank == 0;
}

/// Collective. `write(path)` on one rank before any reads.
template <class Write>
std::string written(const std::string& name, const Write& write) {
  const std::string path = SQUEAL_OUTPUT_DIR "/" + name;
  if (firstRank()) write(path);
  check(MPI_Barrier(PETSC_COMM_WORLD));
  return path;
}

void expectSample(const std::string& path, const std::string& dataset = {}) {
  const OwnedMat matrix = matrices::read(PETSC_COMM_WORLD, path, dataset);
  const auto all = denseCopy(matrix);
  ASSERT_EQ(all.rows, 4) << path;
  ASSERT_EQ(all.columns, 4) << path;
  for (PetscInt i = 0; i < 4; ++i)
    for (PetscInt j = 0; j < 4; ++j)
      EXPECT_EQ(all(i, j), sample[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]) << path << " " << i << " " << j;
}

std::string errorReading(const std::string& path, const std::string& dataset = {}) {
  return errorOf([&] { matrices::read(PETSC_COMM_WORLD, path, dataset); });
}

TEST(Matrices, MatrixMarket) {
  expectSample(written("sample.mtx", [](const auto& path) { matrices::writeMatrixMarket(path, sampleEntries()); }));
  expectSample(writeFile(
      "array.mtx",
      "%%MatrixMarket matrix array real general\n4 4\n.33333333333333331\n0\n5\n0\n0\n0\n1e-300\n0\n-2\n0\n7\n0\n0\n0\n8\n"
      "-3333333333.3333335\n"));
}

TEST(Matrices, MatrixMarketSymmetries) {
  const auto symmetric = denseCopy(matrices::read(
      PETSC_COMM_WORLD,
      writeFile("symmetric.mtx", "%%MatrixMarket matrix coordinate real symmetric\n% comment\n2 2 2\n1 1 3\n2 1 4\n")));
  EXPECT_EQ(symmetric.values, (std::vector<double>{3, 4, 4, 0}));
  const auto skew = denseCopy(matrices::read(
      PETSC_COMM_WORLD, writeFile("skew.mtx", "%%MatrixMarket matrix coordinate real skew-symmetric\n2 2 1\n2 1 4\n")));
  EXPECT_EQ(skew.values, (std::vector<double>{0, 4, -4, 0}));
  const auto ones = denseCopy(matrices::read(
      PETSC_COMM_WORLD, writeFile("ones.mtx", "%%MatrixMarket matrix coordinate pattern symmetric\n2 2 3\n1 1\n2 1\n2 2\n")));
  EXPECT_EQ(ones.values, (std::vector<double>{1, 1, 1, 1}));
}

TEST(Matrices, PetscBinary) {
  const OwnedMat matrix = matrices::read(
      PETSC_COMM_WORLD, written("from.mtx", [](const auto& path) { matrices::writeMatrixMarket(path, sampleEntries()); }));
  const std::string path = SQUEAL_OUTPUT_DIR "/sample.petsc";
  OwnedViewer viewer;
  check(PetscViewerBinaryOpen(PETSC_COMM_WORLD, path.c_str(), FILE_MODE_WRITE, viewer.out()));
  check(MatView(matrix, viewer));
  viewer = {};
  check(MPI_Barrier(PETSC_COMM_WORLD));
  expectSample(path);
  const std::string cut = written("cut.petsc", [&](const auto& to) {
    std::filesystem::copy_file(path, to, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(to, 60);
  });
  EXPECT_TRUE(contains(errorReading(cut), "cut.petsc: 60 bytes where")) << errorReading(cut);
}

/// A sparse and a full matrix, the full one by columns.
void writeMatlab(const std::string& path, mat_ft version) {
  mat_t* file = Mat_CreateVer(path.c_str(), "test", version);
  Lists lists(true);
  const auto count = static_cast<mat_uint32_t>(lists.data.size());
  mat_sparse_t sparse{count, lists.indices.data(), count, lists.begin.data(), 5, count, lists.data.data()};
  std::vector<double> full;
  for (std::size_t j = 0; j < 4; ++j)
    for (const auto& row : sample) full.push_back(row[j]);
  std::size_t dims[2] = {4, 4};
  matvar_t* variables[] = {Mat_VarCreate("sparse", MAT_C_SPARSE, MAT_T_DOUBLE, 2, dims, &sparse, 0),
                           Mat_VarCreate("full", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims, full.data(), 0)};
  for (matvar_t* variable : variables) {
    Mat_VarWrite(file, variable, MAT_COMPRESSION_NONE);
    Mat_VarFree(variable);
  }
  Mat_Close(file);
}

TEST(Matrices, Matlab) {
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    const auto path = written(version == MAT_FT_MAT5 ? "v5.mat" : "v73.mat", [&](const auto& to) { writeMatlab(to, version); });
    expectSample(path, "sparse");
    expectSample(path, "full");
    EXPECT_TRUE(contains(errorReading(path), "several matrices, "));
    EXPECT_TRUE(contains(errorReading(path, "other"), "'other'"));
  }
}

void writeDataset(hid_t place, const char* name, hid_t type, const void* values, std::vector<hsize_t> shape) {
  const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
  const hid_t set = H5Dcreate2(place, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
  H5Dclose(set);
  H5Sclose(space);
}

void writeGroup(hid_t file, const char* name, bool byColumns) {
  const Lists lists(byColumns);
  const hid_t group = H5Gcreate2(file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  writeDataset(group, "data", H5T_NATIVE_DOUBLE, lists.data.data(), {lists.data.size()});
  writeDataset(group, "indices", H5T_NATIVE_UINT, lists.indices.data(), {lists.indices.size()});
  writeDataset(group, "indptr", H5T_NATIVE_UINT, lists.begin.data(), {lists.begin.size()});
  const hid_t scalar = H5Screate(H5S_SCALAR), text = H5Tcopy(H5T_C_S1);
  H5Tset_size(text, 10);
  const hid_t attribute = H5Acreate2(group, "encoding-type", text, scalar, H5P_DEFAULT, H5P_DEFAULT);  // as anndata does
  H5Awrite(attribute, text, byColumns ? "csc_matrix" : "csr_matrix");
  H5Aclose(attribute);
  H5Tclose(text);
  H5Sclose(scalar);
  H5Gclose(group);
}

TEST(Matrices, Hdf5) {
  const auto path = written("sample.h5", [](const auto& to) {
    const hid_t file = H5Fcreate(to.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    writeGroup(file, "rows", false);
    writeGroup(file, "columns", true);
    writeDataset(file, "full", H5T_NATIVE_DOUBLE, sample.data(), {4, 4});
    H5Fclose(file);
  });
  expectSample(path, "rows");
  expectSample(path, "columns");
  expectSample(path, "/full");
  EXPECT_TRUE(contains(errorReading(path), "several matrices, columns, full, rows"));
  EXPECT_TRUE(contains(errorReading(path, "other"), "no object 'other'"));
  EXPECT_TRUE(contains(errorReading(path, "rows/data"), "neither"));
  const auto one = written("one.h5", [](const auto& to) {
    const hid_t file = H5Fcreate(to.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    writeGroup(file, "it", true);
    H5Fclose(file);
  });
  expectSample(one);
}

TEST(Matrices, DamagedAndForeignFiles) {
  const std::string head = "%%MatrixMarket matrix coordinate ";
  const std::vector<std::array<std::string, 3>> cases{
      {"empty.mtx", "", "the file is empty"},
      {"short.mtx", head + "real general\n2 2 2\n1 1 1\n", "no sound Matrix Market"},
      {"words.mtx", head + "real general\n2 2 2\n1 1 1\n2 2 one\n", "no sound Matrix Market"},
      {"outside.mtx", head + "real general\n2 2 1\n3 1 1\n", "no sound Matrix Market"},
      {"nan.mtx", head + "real general\n2 2 2\n1 1 nan\n2 2 1\n", "not a finite number"},
      {"inf.mtx", head + "real general\n2 2 2\n1 1 inf\n2 2 1\n", "not a finite number"},
      {"complex.mtx", head + "complex general\n1 1 1\n1 1 1 1\n", "not real"},
      {"wide.mtx", head + "real general\n1 2 1\n1 1 1\n", "1 rows and 2 columns, not square"},
      {"text.dat", "1 2 3\n", "none of Matrix Market"},
      {"damaged.h5", "\x89HDF\r\n\x1a\n nothing", "damaged"},
      {"damaged.mat", "MATLAB 5.0 MAT-file", "MATLAB"},
      {"scipy.npz", "PK\x03\x04", "scripts/convert_matrix"},
  };
  for (const auto& [name, text, message] : cases) {
    const std::string error = errorReading(writeFile(name, text));
    EXPECT_TRUE(contains(error, name) && contains(error, message)) << name << ": " << error;
  }
  EXPECT_TRUE(contains(errorReading(SQUEAL_OUTPUT_DIR "/none.mtx"), "there is no such file"));
  EXPECT_TRUE(contains(errorReading(SQUEAL_OUTPUT_DIR), "there is no such file"));  // a folder
}

/// A matrix given by its rows.
using Rows = std::vector<std::vector<double>>;

std::string writeRows(const std::string& name, const Rows& rows) {
  matrices::Entries entries{static_cast<PetscInt>(rows.size()), static_cast<PetscInt>(rows.size()), {}, {}, {}};
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows.size(); ++j) entries.add(static_cast<long long>(i), static_cast<long long>(j), rows[i][j]);
  return written(name, [&](const auto& path) { matrices::writeMatrixMarket(path, entries); });
}

/// Options for M, K and f K_f.
std::string problem(const std::string& name, const Rows& mass, const Rows& stiffness, const Rows& friction) {
  return "-matrices_m_role mass -matrices_m_file " + writeRows(name + "_m.mtx", mass) +
         " -matrices_k_role stiffness -matrices_k_file " + writeRows(name + "_k.mtx", stiffness) +
         " -matrices_kf_role stiffness -matrices_kf_friction_exponent 1 -matrices_kf_file " +
         writeRows(name + "_kf.mtx", friction) + " ";
}

const Rows unit{{1, 0}, {0, 1}}, belt{{2, 1}, {1, 2}}, drag{{0, -4. / 3}, {0, 0}};

// Hoffmann et al. 2002: s² = −2 ± √(1 − 4f/3).
TEST(Matrices, BeltMergesAtItsCriticalFriction) {
  const std::string options = problem("belt", unit, belt, drag);
  for (const double f : {0.0, 0.3, 0.75 * (1 - 1e-6), 0.75 * (1 + 1e-6), 2.0}) {
    const Analysis analysis = runOptions(options + "-flutter_friction " + formatted("%.17g", f));
    std::vector<Complex> exact;
    for (const double sign : {-1.0, 1.0}) {
      const Complex s = std::sqrt(-2.0 + sign * std::sqrt(Complex(1 - 4 * f / 3)));
      exact.push_back(s.imag() < 0 ? -s : s);
    }
    const auto& point = analysis.segments.at(0).points.at(0);
    // At 1e-6 from the merger rounding of 1e-16 grows by 1e3.
    EXPECT_LT(worst(errors(exact, eigenvaluesOf(point)).relative), 1e-12) << f;
    EXPECT_EQ(point.unstableCount(), f > 0.75 ? 1 : 0) << f;
    EXPECT_EQ(analysis.segments.at(0).modes.angularFrequency.size(), 2U);  // of -modes_count 200
  }
}

TEST(Matrices, FactorsAndExponents) {
  // 3 · (M/3) and the friction entered as f² v / 10 at f = 0.5, v = 20: f K_f.
  const std::string third = writeRows("third.mtx", {{1. / 3, 0}, {0, 1. / 3}});
  const std::string options = problem("factors", unit, belt, drag) + "-flutter_friction 0.5 ";
  const auto plain = eigenvaluesOf(runOptions(options).segments.at(0).points.at(0));
  const auto scaled = eigenvaluesOf(
      runOptions(options + "-matrices_m_factor 3 -matrices_m_file " + third +
                 " -matrices_kf_friction_exponent 2 -matrices_kf_speed_exponent 1 -matrices_kf_factor 0.1 -flutter_speed 20")
          .segments.at(0)
          .points.at(0));
  EXPECT_LT(worst(errors(plain, scaled).relative), 1e-14);
}

// Friction inside the stiffness, as a program exports it: the same problem, on the modes of the symmetric part.
TEST(Matrices, FrictionInsideTheStiffness) {
  const auto apart = runOptions(problem("apart", unit, belt, drag) + "-flutter_friction 1").segments.at(0).points.at(0).eigenvalues;
  const std::string inside = problem("inside", unit, {{2, 1 - 4. / 3}, {1, 2}}, {{0, 0}, {0, 0}});
  const Analysis analysis = runOptions(inside + "-flutter_friction 1");
  const auto& point = analysis.segments.at(0).points.at(0);
  ASSERT_EQ(point.eigenvalues.size(), apart.size());
  for (std::size_t i = 0; i < apart.size(); ++i) EXPECT_LT(std::abs(point.eigenvalues[i].s - apart[i].s), 1e-14);
}

TEST(Matrices, WhatIsNoVibrationIsSaid) {
  const Rows zero{{0, 0}, {0, 0}};
  const std::vector<std::tuple<std::string, Rows, Rows, std::string>> cases{
      {"loose", unit, {{1, -1}, {-1, 1}}, "the stiffness 'k' is not positive definite: 0 negative and 1 zero"},
      {"indefinite", unit, {{1, 2}, {2, 1}}, "the stiffness 'k' is not positive definite: 1 negative and 0 zero"},
      {"none", unit, zero, "the stiffness 'k' is zero"},
      {"massless", {{1, 0}, {0, 0}}, belt, "the mass 'm' is not positive definite: 0 negative and 1 zero"},
      {"negative", {{1, 0}, {0, -1}}, belt, "the mass 'm' is not positive definite: 1 negative and 0 zero"},
      {"unsymmetric", {{1, 0.1}, {0, 1}}, belt, "the mass 'm' is not symmetric"},
      {"sizes", {{1}}, belt, "1 rows, but matrix"},
  };
  for (const auto& [name, mass, stiffness, message] : cases) {
    const std::string options = problem(name, mass, stiffness, zero);
    const std::string error = errorOf([&] { runOptions(options); });
    EXPECT_TRUE(contains(error, message)) << name << ": " << error;
  }
}

TEST(Matrices, OptionsThatMakeNoProblem) {
  const std::string options = problem("options", unit, belt, drag), mass = writeRows("alone.mtx", unit);
  const std::vector<std::pair<std::string, std::string>> cases{
      {options + "-matrices_m_role weight", "option -matrices_m_role weight"},
      {"-matrices_m_file " + mass, "option -matrices_m_role"},
      {"-matrices_m_role mass -matrices_m_file " + mass, "there is no stiffness matrix"},
      {"-matrices_m_role stiffness -matrices_m_file " + mass, "there is no mass matrix"},
      {options + "-matrices_other_factor 2", "there is no -matrices_other_file"},
      {options + "-mesh_file meshes/layer.geo", "not of both"},
      {options + "-steady_uniqueness on", "not of both"},
      {options + "-flutter_speed 1,2", "no matrix has -matrices_<name>_speed_exponent"},
      {options + "-flutter_pressure 2", "-flutter_pressure"},
  };
  for (const auto& [given, message] : cases) {
    const std::string error = errorOf([&, &given = given] { runOptions(given); });
    EXPECT_TRUE(contains(error, message)) << given << ": " << error;
  }
}

/// Masses in a row, each free to move along and across a belt and held by springs of its own, joined to the next in both directions.
/// The spring behind mass `at` along the belt has the stiffness `stiff`, those to the ground are `ground` times the usual.
struct Chain {
  std::size_t masses = 80;
  double ground = 1, stiff = 1;
  std::size_t at = 35;

  std::string options(const std::string& name) const {
    const std::size_t n = 2 * masses;
    Rows mass(n, std::vector<double>(n, 0)), stiffness = mass, friction = mass;
    const auto spring = [&](std::size_t i, std::size_t j, double k) {
      stiffness[i][i] += k, stiffness[j][j] += k, stiffness[i][j] -= k, stiffness[j][i] -= k;
    };
    for (std::size_t x = 0, y = 1; x < n; x += 2, y += 2) {
      mass[x][x] = mass[y][y] = 1 + 0.3 * std::sin(static_cast<double>(x));
      stiffness[x][x] += ground;
      stiffness[y][y] += 1.1 * ground;
      spring(x, y, 1. / 7);
      friction[x][y] = -0.4;
      if (x + 2 == n) break;
      spring(x, x + 2, (x / 2 == at ? stiff : 1) / 3);
      spring(y, y + 2, 1. / 3);
    }
    return problem(name, mass, stiffness, friction) + "-flutter_friction 0.3 ";
  }
};

// A spring 1e6 times the others leaves the low eigenvalues right. LAPACK on all unknowns errs by ε ‖M⁻¹K‖ = 1e-10 of eigenvalues of
// size one; so far may the two be apart.
TEST(Matrices, AStiffSpringDoesNotSpoilTheOthers) {
  Chain chain;
  chain.stiff = 1e6;
  chain.ground = 0.1;  // frequencies apart from each other
  const std::string options = chain.options("stiff");
  const Analysis reduced = runOptions(options + "-modes_count 20");
  const Analysis direct = runOptions(options + "-flutter_method direct -flutter_direct_count 160");
  const auto& found = reduced.segments.at(0).points.at(0).eigenvalues;
  const auto exact = matched(eigenvaluesOf(reduced.segments.at(0).points.at(0)), eigenvaluesOf(direct.segments.at(0).points.at(0)));
  EXPECT_GE(found.size(), 8U);
  for (std::size_t i = 0; i < found.size(); ++i) {
    // The backward error, one of ‖K‖ and so of the spring, would say 1e-12; the estimate says how much of s is right.
    EXPECT_TRUE(found[i].certified);
    EXPECT_LT(std::abs(found[i].s - exact[i]), std::max(found[i].errorEstimate, 1e-9) * std::abs(exact[i])) << i;
  }
  // All modes of a smaller one at once, by LAPACK, against block Lanczos or SLEPc.
  chain.masses = 30, chain.at = 15;
  const std::string smaller = chain.options("stiff_small") + "-flutter_friction 0 ";
  const auto all = runOptions(smaller + "-modes_count 60").segments.at(0).modes.angularFrequency;
  const auto some =
      runOptions(smaller + "-modes_count 10 -modes_solver eps -modes_tolerance 1e-12").segments.at(0).modes.angularFrequency;
  for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(all[i], some[i], 1e-10 * some[i]) << i;
}

// Loose to rounding, and nearly so: a third of each spring cannot be written without rounding, so that K has no exact zero pivot.
TEST(Matrices, ALooseChainIsFound) {
  Chain chain;
  chain.ground = 0;
  const std::string loose = errorOf([&] { runOptions(chain.options("chain_loose")); });
  EXPECT_TRUE(contains(loose, "not positive definite: 0 negative and 1 zero")) << loose;
  chain.ground = 2e-14;  // no zero pivot, but an eigenvalue of which rounding leaves one digit
  const std::string nearly = errorOf([&] { runOptions(chain.options("chain_nearly")); });
  EXPECT_TRUE(contains(nearly, "nothing but rounding")) << nearly;
}

TEST(Matrices, ExportOfTheLayerComesBack) {
  const std::string changes = "-modes_count 60 -mesh_set nx=18,ny=6 -flutter_friction 0,0.4 ", folder = SQUEAL_OUTPUT_DIR "/layer_";
  for (const std::string format : {"petsc", "matrix_market"}) {
    const Analysis mesh = runCase("layer", changes + "-report_matrices " + folder + format + " -report_matrices_format " + format);
    const Analysis files = runOptions("-options_file " + folder + format + "/options.txt");
    for (std::size_t p = 0; p < 2; ++p) {
      const auto wanted = eigenvaluesOf(mesh.segments.at(0).points.at(p)), found = eigenvaluesOf(files.segments.at(0).points.at(p));
      ASSERT_EQ(wanted.size(), found.size());
      EXPECT_GT(wanted.size(), 20U);
      // Both to a backward error of 1e-9 in the band; the sums of the pencil are the same to rounding.
      EXPECT_LT(worst(errors(wanted, found).relative), 1e-10) << format << " " << p;
    }
  }
}

TEST(Matrices, ExportOfAPointAlone) {
  // Friction damping belongs to the steady state of one point.
  const std::string changes =
      "-mesh_set nx=4,ny_disc=2,ny_pad=2 -modes_count 20 -flutter_band 0.3 -report_matrices " SQUEAL_OUTPUT_DIR "/antiplane ";
  const std::string error = errorOf([&] { runCase("two_layers_antiplane", changes + "-flutter_friction 0.2,0.4"); });
  EXPECT_TRUE(contains(error, "-report_matrices") && contains(error, "one -flutter_friction")) << error;
  const Analysis mesh = runCase("two_layers_antiplane", changes + "-flutter_friction 0.4");
  const Analysis files = runOptions("-options_file " SQUEAL_OUTPUT_DIR "/antiplane/options.txt");
  const auto wanted = eigenvaluesOf(mesh.segments.at(0).points.at(0)), found = eigenvaluesOf(files.segments.at(0).points.at(0));
  ASSERT_EQ(wanted.size(), found.size());
  EXPECT_GT(wanted.size(), 4U);
  EXPECT_LT(worst(errors(wanted, found).relative), 1e-10);
}

}  // namespace
}  // namespace squeal::test
