#include <suitesparse/cholmod.h>

#include <cstdio>
#include <fstream>
#include <memory>

#include "matrices/formats.hpp"
#include "petsc/check.hpp"
#include "petsc/text.hpp"

namespace squeal::matrices {
namespace {

struct Closer {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Closer>;

File opened(const std::filesystem::path& path) {
  File file(std::fopen(path.c_str(), "r"));
  if (!file) throw Error("the file cannot be opened");
  return file;
}

/// CHOLMOD's state, silent: what it says reaches the user through our errors.
class Cholmod {
 public:
  Cholmod() {
    cholmod_l_start(&common_);
    common_.print = 0;
  }
  ~Cholmod() {
    cholmod_l_free_sparse(&sparse, &common_);
    cholmod_l_free_triplet(&triplet, &common_);
    cholmod_l_finish(&common_);
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;
  operator cholmod_common*() { return &common_; }  // NOLINT

  cholmod_sparse* sparse = nullptr;
  cholmod_triplet* triplet = nullptr;

 private:
  cholmod_common common_{};
};

/// Both triangles of a symmetric matrix, all entries of an array.
cholmod_sparse* readSparse(std::FILE* file, cholmod_common* common) {
  int type = 0;
  void* read = cholmod_l_read_matrix(file, 1, &type, common);
  if (!read || type != CHOLMOD_DENSE) return static_cast<cholmod_sparse*>(read);
  auto* dense = static_cast<cholmod_dense*>(read);
  cholmod_sparse* sparse = cholmod_l_dense_to_sparse(dense, 1, common);
  cholmod_l_free_dense(&dense, common);
  return sparse;
}

/// Entries without values stand for ones; CHOLMOD makes up other values for a symmetric pattern.
bool isPattern(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line.find("pattern") != std::string::npos;
}

}  // namespace

Entries readMatrixMarket(const std::filesystem::path& path) {
  const bool pattern = isPattern(path);
  const File file = opened(path);
  Cholmod cholmod;
  cholmod.sparse = readSparse(file.get(), cholmod);
  if (!cholmod.sparse) throw Error("CHOLMOD finds no sound Matrix Market content");
  cholmod.triplet = cholmod_l_sparse_to_triplet(cholmod.sparse, cholmod);
  if (!cholmod.triplet) throw Error("CHOLMOD lacks memory");
  const auto& t = *cholmod.triplet;
  if (t.xtype != CHOLMOD_REAL) throw Error("the matrix is not real");
  Entries entries{static_cast<PetscInt>(t.nrow), static_cast<PetscInt>(t.ncol), {}, {}, {}};
  for (std::size_t k = 0; k < t.nnz; ++k)
    entries.add(static_cast<SuiteSparse_long*>(t.i)[k], static_cast<SuiteSparse_long*>(t.j)[k],
                pattern ? 1 : static_cast<double*>(t.x)[k]);
  return entries;
}

void writeMatrixMarket(const std::filesystem::path& path, const Entries& entries) {
  // By hand: CHOLMOD leaves out the values of a matrix of ones and reads another one from that.
  std::ofstream file(path);
  file << formatted("%%%%MatrixMarket matrix coordinate real general\n%d %d %zu\n", static_cast<int>(entries.rows),
                    static_cast<int>(entries.columns), entries.value.size());
  for (std::size_t k = 0; k < entries.value.size(); ++k)
    file << formatted("%d %d %.17g\n", static_cast<int>(entries.row[k]) + 1, static_cast<int>(entries.column[k]) + 1,
                      entries.value[k]);
  if (!file.flush()) throw Error("cannot write " + path.string());
}

}  // namespace squeal::matrices
