#include "run/report/settings.hpp"

#include "base/options/options.hpp"
#include "eigen/pencil/settings.hpp"

namespace squeal::report {
namespace {

const IntegerOption modesOption("report", "report_modes", 10, 0, 100'000,
                                "number of free modes written as fields");

}  // namespace

Settings Settings::given() {
  Settings settings;
  // The direct method reports no free modes.
  if (pencil::Settings::given().method == pencil::Method::reduced)
    settings.modes = modesOption.get();
  return settings;
}

}  // namespace squeal::report
