#include <matio.h>

#include <memory>

#include "matrices/formats.hpp"
#include "petsc/check.hpp"
#include "petsc/text.hpp"

namespace squeal::matrices {
namespace {

struct Closer {
  void operator()(mat_t* file) const { Mat_Close(file); }
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using File = std::unique_ptr<mat_t, Closer>;
using Variable = std::unique_ptr<matvar_t, Closer>;

/// A table of reals of two dimensions. (Those of a sparse matrix of version 4 are known when it has been read.)
bool isMatrix(const matvar_t& variable) {
  const auto type = variable.class_type;
  return variable.rank == 2 && (type == MAT_C_SPARSE || type == MAT_C_DOUBLE || type == MAT_C_SINGLE);
}

/// The only square matrix of more than one row.
std::string onlyMatrix(mat_t* file) {
  std::vector<std::string> names;
  for (;;) {
    const Variable variable(Mat_VarReadNextInfo(file));
    if (!variable) break;
    const bool isSquare = variable->rank == 2 && variable->dims[0] == variable->dims[1] && variable->dims[0] > 1;
    if (isMatrix(*variable) && (isSquare || variable->class_type == MAT_C_SPARSE)) names.emplace_back(variable->name);
  }
  Mat_Rewind(file);
  if (names.empty()) throw Error("the MATLAB file holds no square matrix of real numbers");
  if (names.size() > 1) throw Error("the MATLAB file holds several matrices, " + joined(names) + ": name one");
  return names[0];
}

Entries sparseEntries(const matvar_t& variable) {
  const auto& s = *static_cast<const mat_sparse_t*>(variable.data);
  if (variable.data_type != MAT_T_DOUBLE) throw Error("the sparse matrix does not hold doubles");
  const auto* values = static_cast<const double*>(s.data);
  return compressed(static_cast<long long>(variable.dims[0]), static_cast<long long>(variable.dims[1]), true, {s.jc, s.jc + s.njc},
                    {s.ir, s.ir + s.nir}, {values, values + s.ndata});
}

Entries fullEntries(const matvar_t& variable) {
  Entries entries{static_cast<PetscInt>(variable.dims[0]), static_cast<PetscInt>(variable.dims[1]), {}, {}, {}};
  const bool isDouble = variable.data_type == MAT_T_DOUBLE;
  if (!isDouble && variable.data_type != MAT_T_SINGLE) throw Error("the matrix does not hold reals");
  for (std::size_t j = 0, k = 0; j < variable.dims[1]; ++j)
    for (std::size_t i = 0; i < variable.dims[0]; ++i, ++k)
      entries.add(static_cast<long long>(i), static_cast<long long>(j),
                  isDouble ? static_cast<const double*>(variable.data)[k]
                           : static_cast<double>(static_cast<const float*>(variable.data)[k]));
  return entries;
}

}  // namespace

Entries readMatlab(const std::filesystem::path& path, const std::string& name) {
  Mat_LogInitFunc("squeal", [](int, char*) {});  // what it says reaches the user through our errors
  const File file(Mat_Open(path.c_str(), MAT_ACC_RDONLY));
  if (!file) throw Error("matio finds no sound MATLAB content");
  const std::string wanted = name.empty() ? onlyMatrix(file.get()) : name;
  const Variable variable(Mat_VarRead(file.get(), wanted.c_str()));
  if (!variable) throw Error("the MATLAB file holds no variable '" + wanted + "', or is damaged");
  if (!isMatrix(*variable) || !variable->data) throw Error("variable '" + wanted + "' is not a matrix of real numbers");
  if (variable->isComplex) throw Error("variable '" + wanted + "' is complex");
  return variable->class_type == MAT_C_SPARSE ? sparseEntries(*variable) : fullEntries(*variable);
}

}  // namespace squeal::matrices
