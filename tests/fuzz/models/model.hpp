// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Small brakes of random features: the n-th is the same on every machine.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/models/boxes.hpp"
#include "fuzz/models/settings.hpp"

namespace squeal::fuzz {

/// Two bodies that do not move against each other where they touch, which has several forms.
enum class Bond {
  slaveIsSecond,  ///< a tie, the side of the second box follows that of the first
  slaveIsFirst,   ///< a tie the other way round
  tiedRole,       ///< an interface whose role is `tied`
  welded          ///< the nodes are the same in the mesh
};
inline constexpr int bondForms = 4;
const char* text(Bond bond);

/// A bond of a model whose meshes match, and the form that it has.
struct Glue {
  std::size_t firstBox = 0, secondBox = 0;
  std::string firstSide, secondSide;
  Bond form = Bond::slaveIsSecond;
};

/// A model: its mesh and its options.
struct Model {
  std::uint64_t seed = 0;
  BoxMesh mesh;
  Settings settings;  ///< without those of the glue
  std::optional<Glue> glue;
  std::vector<std::string> features;  ///< for the statistics
  std::vector<double> frictions;
  bool modalDamping = false;  ///< the direct method does not know it

  bool has(const std::string& feature) const;
  /// Adds a feature, once.
  void note(const std::string& feature);
};

/// Another form of a model, which has the same eigenvalues.
struct Form {
  bool shuffled = false;
  int turn = 0;
  std::optional<Bond> bond;  ///< in place of its own
};

/// The mesh file and the options of a model in one of its forms.
struct Written {
  std::string mesh;
  std::vector<std::pair<std::string, std::string>> options;  ///< without `mesh_file`
};
Written written(const Model& model, const Form& form);
/// Returns the text of an options file.
std::string caseText(const Written& written, const std::string& meshFile,
                     const std::string& comment);

/// Returns the model of a seed.
Model modelOf(std::uint64_t seed);

}  // namespace squeal::fuzz
