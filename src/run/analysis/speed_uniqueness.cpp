// SPDX-License-Identifier: BSD-2-Clause
#include "run/analysis/speed_uniqueness.hpp"

#include "base/session/stages.hpp"
#include "base/system/termination.hpp"
#include "base/system/text.hpp"

namespace squeal::analysis {

UniquenessStudy examineUniqueness(const Model& model, const sweep::Sweep& sweep,
                                  const uniqueness::Settings& settings) {
  UniquenessStudy study;
  if (!settings.wanted || model.contact.interfaces.totalNodes == 0) return study;
  std::vector<double> speeds = sweep.speeds;
  if (model.contact.slipIsConstant()) speeds.resize(1);
  study.complete = completed([&] {
    for (const double speed : speeds) {
      stopIfRequested(model.mesh->comm);
      Stage stage(model.mesh->comm, "steady");
      study.speeds.push_back({speed, uniqueness::examine(model.bodies, model.contact, speed,
                                                         sweep.frictions, settings)});
      const auto& last = study.speeds.back().found.judgements.back();
      stage.finish(formatted("uniqueness at friction %g: %s (%s)", last.friction,
                             last.verdict.c_str(), last.reason.c_str()));
    }
  });
  return study;
}

}  // namespace squeal::analysis
