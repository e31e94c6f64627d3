// SPDX-License-Identifier: BSD-2-Clause
// This reads MATLAB files without matio: in a truncated file, matio 1.5 replaces missing values by
// zeros and omits the variables after them.
#include "problem/matrixfile/matlab.hpp"

#include "base/petsc/check.hpp"
#include "base/system/text.hpp"
#include "problem/matrixfile/bytes.hpp"
#include "problem/matrixfile/matlab4.hpp"
#include "problem/matrixfile/matlab5.hpp"
#include "problem/matrixfile/matlab_variable.hpp"

namespace squeal::matrixfile {
namespace {

bool isMatrix(const Variable& variable) { return variable.real && variable.shape.size() == 2; }

bool isSquareMatrix(const Variable& variable) {
  return isMatrix(variable) && variable.shape[0] == variable.shape[1] && variable.shape[0] > 1;
}

/// Returns a text such as "k (2 x 2 sparse)".
std::string described(const Variable& variable) {
  std::vector<std::string> sizes;
  for (const auto size : variable.shape) sizes.push_back(std::to_string(size));
  return variable.name + " (" + joined(sizes, " x ") + (sizes.empty() ? "" : " ") + variable.kind +
         ")";
}

std::string describedAll(const std::vector<Variable>& variables) {
  constexpr std::size_t most = 20;
  std::vector<std::string> texts;
  for (const auto& variable : variables)
    if (texts.size() < most) texts.push_back(described(variable));
  if (variables.size() > most) texts.emplace_back("...");
  return texts.empty() ? "no variable" : joined(texts);
}

const Variable& chosen(const std::vector<Variable>& variables, const std::string& name) {
  std::vector<const Variable*> found;
  std::vector<std::string> names;
  for (const auto& variable : variables)
    if (name.empty() ? isSquareMatrix(variable) : variable.name == name)
      found.push_back(&variable), names.push_back(variable.name);
  if (found.empty())
    throw Error((name.empty()
                     ? std::string("the MATLAB file contains no square matrix of real numbers")
                     : "the MATLAB file contains no variable '" + name + "'") +
                ", but " + describedAll(variables));
  if (found.size() > 1)
    throw Error("the MATLAB file contains several " +
                (name.empty() ? "matrices, " + joined(names) + ": name one" : "variables " + name));
  if (!isMatrix(*found[0]))
    throw Error("variable " + described(*found[0]) + " is not a matrix of real numbers");
  return *found[0];
}

bool isVersion5(BinaryFile& file) {
  if (file.size() < 128) return false;
  char mark[2];
  file.seek(126);
  file.read(mark, 2);
  return (mark[0] == 'I' && mark[1] == 'M') || (mark[0] == 'M' && mark[1] == 'I');
}

/// Returns true if the file begins with the text of version 5, even without a byte-order mark.
bool beginsLikeVersion5(BinaryFile& file) {
  char text[6] = {};
  file.seek(0);
  file.read(text, std::min<std::size_t>(sizeof text, file.size()));
  return std::string(text, sizeof text) == "MATLAB";
}

}  // namespace

Entries readMatlab(const std::filesystem::path& path, const std::string& name) {
  BinaryFile file(path);
  const bool version5 = isVersion5(file);
  if (!version5 && beginsLikeVersion5(file))
    throw Error("the header of the MATLAB file is truncated or damaged");
  const auto variables = version5 ? variablesOfVersion5(file) : variablesOfVersion4(file);
  const Variable& variable = chosen(variables, name);
  if (!variable.sparse || version5) requireSquare(variable.shape[0], variable.shape[1]);
  try {
    return version5 ? readVersion5(file, variable) : readVersion4(file, variable);
  } catch (const Error& error) {
    throw Error("variable '" + variable.name + "': " + error.what());
  }
}

}  // namespace squeal::matrixfile
