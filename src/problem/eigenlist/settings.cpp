// SPDX-License-Identifier: BSD-2-Clause
#include "problem/eigenlist/settings.hpp"

#include "base/options/options.hpp"

namespace squeal::eigenlist {
namespace {

const FileOption listFile("referee", "referee_list",
                          "eigenvalues of another program for the matrices -matrices_<name>_file; "
                          "the run proves which of them are right and which are missing");
const ChoiceOption formatOption(
    "referee", "referee_format", {"auto", "columns", "abaqus", "calculix", "nastran", "ansys"},
    "auto",
    "layout of the list; auto: recognised by the titles in the file; without titles, columns");
const ChoiceOption unitOption("referee", "referee_unit", {"auto", "rad", "Hz"}, "auto",
                              "unit of a list in columns; rad: s in 1/s and rad/s; Hz: s / (2 pi) "
                              "in both columns; auto: as its header states");

Format formatOf(const std::string& word) {
  if (word == "columns") return Format::columns;
  if (word == "abaqus") return Format::abaqus;
  if (word == "calculix") return Format::calculix;
  if (word == "nastran") return Format::nastran;
  if (word == "ansys") return Format::ansys;
  return Format::automatic;
}

}  // namespace

std::string listOption() { return listFile.dashed(); }

std::optional<Settings> Settings::given() {
  if (!listFile.given()) {
    requireOption({&formatOption, &unitOption}, listFile);
    return {};
  }
  Settings settings{.file = listFile.get(), .format = formatOf(formatOption.get()), .unit = {}};
  if (const auto unit = unitOption.get(); unit != "auto")
    settings.unit = unit == "Hz" ? Unit::hertz : Unit::radians;
  return settings;
}

}  // namespace squeal::eigenlist
