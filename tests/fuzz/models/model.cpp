// SPDX-License-Identifier: BSD-2-Clause
#include "fuzz/models/model.hpp"

#include <algorithm>

namespace squeal::fuzz {

const char* text(Bond bond) {
  static const char* const names[] = {"second follows", "first follows", "role tied", "welded"};
  return names[static_cast<int>(bond)];
}

bool Model::has(const std::string& feature) const {
  return std::find(features.begin(), features.end(), feature) != features.end();
}

void Model::note(const std::string& feature) {
  if (!has(feature)) features.push_back(feature);
}

Written written(const Model& model, const Form& form) {
  Writing writing;
  writing.shuffled = form.shuffled;
  writing.turn = model.mesh.dimension == 3 ? form.turn : 0;
  Settings settings = model.settings;
  if (model.glue) {
    const Glue& glue = *model.glue;
    const Bond bond = form.bond.value_or(glue.form);
    if (bond == Bond::welded) {
      writing.weldedTo = static_cast<int>(std::min(glue.firstBox, glue.secondBox));
      writing.welded = static_cast<int>(std::max(glue.firstBox, glue.secondBox));
    } else if (bond == Bond::tiedRole) {
      settings.set("contact_bond_pad", glue.secondSide);
      settings.set("contact_bond_disc", glue.firstSide);
      settings.set("contact_bond_role", "tied");
    } else {
      const bool second = bond == Bond::slaveIsSecond;
      settings.set("tie_bond_slave", second ? glue.secondSide : glue.firstSide);
      settings.set("tie_bond_master", second ? glue.firstSide : glue.secondSide);
    }
  }
  return {meshText(model.mesh, writing), settings.turnedBy(writing.turn)};
}

std::string caseText(const Written& written, const std::string& meshFile,
                     const std::string& comment) {
  std::string text = "# " + comment + "\nmesh_file: " + meshFile + "\n";
  for (const auto& [name, value] : written.options) text += name + ": \"" + value + "\"\n";
  return text;
}

}  // namespace squeal::fuzz
