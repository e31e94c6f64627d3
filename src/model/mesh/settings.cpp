// SPDX-License-Identifier: BSD-2-Clause
#include "model/mesh/settings.hpp"

#include "base/options/options.hpp"

namespace squeal::mesh {
namespace {

const ChoiceOption straightenOption(
    "mesh", "mesh_straighten", {"none", "bad", "all"}, "none",
    "curved cells whose edges the program straightens; bad: those whose Jacobian is not positive");

}  // namespace

Settings Settings::given() {
  const std::string which = straightenOption.get();
  return {which == "none"  ? Straightening::none
          : which == "bad" ? Straightening::folded
                           : Straightening::all};
}

}  // namespace squeal::mesh
