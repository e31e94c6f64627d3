// SPDX-License-Identifier: BSD-2-Clause
#include "run/report/table_shapes.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "base/petsc/check.hpp"
#include "base/system/regular_file.hpp"
#include "base/system/text.hpp"
#include "run/report/names.hpp"

namespace squeal::report {

nlohmann::ordered_json tableShapes(MPI_Comm comm, const std::filesystem::path& folder) {
  nlohmann::ordered_json shapes = nlohmann::ordered_json::object();
  onFirstRank(comm, std::string("option ") + folderOption + ": ", [&] {
    std::map<std::string, nlohmann::ordered_json>
        byName;  // the order of files in a folder is undefined
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() != ".csv") continue;
      const std::string text = contentOfRegular(entry.path()).value_or("");
      byName[entry.path().stem().string()] = {
          {"rows", std::ranges::count(text, '\n') - 1},
          {"columns", split(text.substr(0, text.find('\n')), ',')}};
    }
    for (const auto& [name, shape] : byName) shapes[name] = shape;
  });
  return shapes;
}

}  // namespace squeal::report
