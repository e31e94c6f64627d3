// SPDX-License-Identifier: BSD-2-Clause
#include "model/frame/settings.hpp"

#include <cmath>
#include <set>

#include "base/options/options.hpp"
#include "base/system/error.hpp"

namespace squeal::frame {
namespace {

const RealListOption originOption(
    "frame", "frame_<name>_origin", "0,0,0", "m", anyReal,
    "origin of the local axes; for cylindrical axes, a point on the axis");
const RealListOption xOption("frame", "frame_<name>_x", "", "", anyReal,
                             "direction of the x axis of rectangular local axes");
const RealListOption xyOption(
    "frame", "frame_<name>_xy", "0,1,0", "", anyReal,
    "second direction of rectangular local axes: it lies in their x-y plane, on the side of y");
const RealListOption axisOption(
    "frame", "frame_<name>_axis", "", "", anyReal,
    "direction of the axis of cylindrical local axes; x is radial, y tangential, z axial");
const RealOption turnOption("frame", "frame_<name>_turn", 0.0, "deg", anyReal,
                            "angle, such as a ply or cone angle, by which the local axes are "
                            "turned about one of them, right-handed");
const ChoiceOption turnAxisOption("frame", "frame_<name>_turn_about", {"x", "y", "z"}, "z",
                                  "local axis about which -frame_<name>_turn turns the others");

}  // namespace

std::map<std::string, FrameSettings> framesGiven() {
  std::set<std::string> names;
  for (const Option* option : std::vector<const Option*>{&originOption, &xOption, &xyOption,
                                                         &axisOption, &turnOption, &turnAxisOption})
    for (const auto& name : option->subjects()) names.insert(name);
  std::map<std::string, FrameSettings> frames;
  for (const auto& name : names) {
    const bool cylindrical = axisOption.given(name), rectangular = xOption.given(name);
    if (cylindrical == rectangular)
      throw Error("frame '" + name + "': give either " + xOption.dashed(name) +
                  ", for rectangular axes, or " + axisOption.dashed(name) +
                  ", for cylindrical ones");
    if (cylindrical && xyOption.given(name))
      throw Error("option " + xyOption.dashed(name) + " needs " + xOption.dashed(name));
    if (turnAxisOption.given(name) && !turnOption.given(name))
      throw Error("option " + turnAxisOption.dashed(name) + " needs " + turnOption.dashed(name));
    frames[name] = {.name = name,
                    .cylindrical = cylindrical,
                    .origin = originOption.vector(name),
                    .first = (cylindrical ? axisOption : xOption).vector(name),
                    .second = xyOption.vector(name),
                    .turn = turnOption.get(name) * M_PI / 180,
                    .turnAxis = turnAxisOption.get(name)[0] - 'x',
                    .firstOption = (cylindrical ? axisOption : xOption).dashed(name),
                    .secondOption = xyOption.dashed(name),
                    .turnAxisOption = turnAxisOption.dashed(name)};
    if (originOption.given(name)) frames[name].originOption = originOption.dashed(name);
  }
  return frames;
}

std::vector<std::string> idleFrames() {
  std::set<std::string> used;
  for (const Option* option : Option::all())
    if (const auto* text = dynamic_cast<const TextOption*>(option);
        text && option->name.ends_with("_frame"))
      for (const auto& subject : option->subjects()) used.insert(text->get(subject));
  std::vector<std::string> idle;
  for (const auto& [name, frame] : framesGiven())
    if (!used.contains(name)) idle.push_back(name);
  return idle;
}

}  // namespace squeal::frame
