#pragma once
/// The name of squeal::broadcast in this room.
#include "base/system/stream.hpp"

namespace squeal::checkpoint {

using squeal::broadcast;

}  // namespace squeal::checkpoint
