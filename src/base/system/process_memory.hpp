// SPDX-License-Identifier: BSD-2-Clause
#pragma once
/// Memory of this process and of its machine. Not collective; programs without MPI use it too.

namespace squeal {

/// Returns the memory available to this process, in bytes: the free memory of the machine or of the
/// process's control group, whichever is less.
double availableMemory();

/// Returns the size of the address space of this process, in bytes.
double addressSpace();

/// Makes the C library retain freed memory, up to 512 MB of it at the end of the heap (see
/// releaseFreedMemory()). The program allocates and frees many blocks of columns, and otherwise the
/// kernel would clear their pages each time. This would take up to a tenth of the time of a run.
void retainFreedMemory();

/// Returns the freed memory of the heap to the kernel, also between blocks in use, if the heap has
/// more than 0.5 GB of it. Long stages of a large model leave a third of the heap in such gaps. In
/// smaller models they are retained, since the kernel takes long to clear the pages when they are
/// used again.
void releaseFreedMemory();

}  // namespace squeal
