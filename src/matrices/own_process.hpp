#pragma once
/// For libraries that a damaged file brings to a crash: their work in a process of its own.
#include <functional>

#include "matrices/formats.hpp"

namespace squeal::matrices {

/// What `read()` returns, called in a child of this process. Error: as `read()` throws; the child does not live to return, `library` by
/// its name. Not collective; `read` must not call MPI.
Entries inOwnProcess(const char* library, const std::function<Entries()>& read);

}  // namespace squeal::matrices
