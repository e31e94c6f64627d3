// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Settings of the local axes. Not collective: all ranks have the same options, and therefore the
/// same results and Errors.
#include <map>
#include <string>
#include <vector>

#include "base/options/option_types.hpp"

namespace squeal::frame {

struct FrameSettings {
  std::string name;
  bool cylindrical = false;
  VectorValue origin = {};  ///< m; a point on the axis if cylindrical
  VectorValue first = {};   ///< direction of x or, if cylindrical, of the axis
  VectorValue second = {};  ///< another direction in the plane of x and y, if rectangular
  double turn = 0;          ///< angle by which the axes are turned about one of them, rad
  int turnAxis = 2;         ///< the axis of the turn; 0, 1, 2: x, y, z of the frame
  std::string firstOption, secondOption, turnAxisOption;  ///< with their dash, for messages
  std::string originOption = {};  ///< likewise; empty if the origin is not given
};

/// Returns the frames of the options, [name]. Throws Error for a frame without directions, and for
/// a frame with the directions of both kinds, rectangular and cylindrical.
std::map<std::string, FrameSettings> framesGiven();

/// Returns the names of frames that no option `…_frame` selects.
std::vector<std::string> idleFrames();

}  // namespace squeal::frame
