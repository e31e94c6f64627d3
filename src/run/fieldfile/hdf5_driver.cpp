// SPDX-License-Identifier: BSD-2-Clause
#include "run/fieldfile/hdf5_driver.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <iterator>

#include "base/output/file.hpp"

namespace squeal::fieldfile {
namespace {

int firstError = 0;
std::string refusal;

struct File {
  H5FD_t base;  // the library's own part comes first
  int descriptor = -1;
  haddr_t allocated = 0;
  haddr_t end = 0;  ///< end of the written bytes
};

File* own(H5FD_t* file) { return reinterpret_cast<File*>(file); }
const File* own(const H5FD_t* file) { return reinterpret_cast<const File*>(file); }

void note(int error) {
  if (firstError == 0) firstError = error;
}

H5FD_t* openFile(const char* name, unsigned flags, hid_t, haddr_t) {
  if (!(flags & H5F_ACC_CREAT)) return nullptr;  // the driver only writes new files
  firstError = 0;
  refusal.clear();
  int descriptor = -1;
  try {
    descriptor = output::openToWrite(name, O_RDWR);
  } catch (const output::WriteError& error) {  // an exception must not pass through the library
    refusal = error.what();
    return nullptr;
  }
  auto* file = new File{};
  file->descriptor = descriptor;
  return &file->base;
}

herr_t closeFile(H5FD_t* file) {
  if (close(own(file)->descriptor) != 0) note(errno);
  delete own(file);
  return 0;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  if (flags)
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA;
  return 0;
}

haddr_t allocated(const H5FD_t* file, H5FD_mem_t) { return own(file)->allocated; }

herr_t setAllocated(H5FD_t* file, H5FD_mem_t, haddr_t address) {
  own(file)->allocated = address;
  return 0;
}

haddr_t end(const H5FD_t* file, H5FD_mem_t) { return own(file)->end; }

herr_t readBytes(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, void* buffer) {
  auto* bytes = static_cast<char*>(buffer);
  while (size > 0) {
    const auto count = pread(own(file)->descriptor, bytes, size, address);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return -1;
    if (count == 0) {  // beyond the end of the file
      std::memset(bytes, 0, size);
      return 0;
    }
    bytes += count;
    size -= count;
    address += count;
  }
  return 0;
}

herr_t writeBytes(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t size,
                  const void* buffer) {
  own(file)->end = std::max(own(file)->end, address + size);
  const auto* bytes = static_cast<const char*>(buffer);
  while (size > 0 && firstError == 0) {
    const auto count = pwrite(own(file)->descriptor, bytes, size, address);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      note(count < 0 ? errno : ENOSPC);
      break;
    }
    bytes += count;
    size -= count;
    address += count;
  }
  return 0;
}

herr_t truncateFile(H5FD_t* file, hid_t, hbool_t) {
  auto& self = *own(file);
  if (self.end == self.allocated) return 0;
  if (firstError == 0 && ftruncate(self.descriptor, self.allocated) != 0) note(errno);
  self.end = self.allocated;
  return 0;
}

H5FD_class_t driver() {
  H5FD_class_t driver{};
  driver.name = "squeal";
  driver.maxaddr = (haddr_t{1} << 62) - 1;
  driver.fc_degree = H5F_CLOSE_WEAK;
  driver.open = openFile;
  driver.close = closeFile;
  driver.query = query;
  driver.get_eoa = allocated;
  driver.set_eoa = setAllocated;
  driver.get_eof = end;
  driver.read = readBytes;
  driver.write = writeBytes;
  driver.truncate = truncateFile;
  const H5FD_mem_t oneList[] = H5FD_FLMAP_SINGLE;
  std::copy(std::begin(oneList), std::end(oneList), driver.fl_map);
  return driver;
}

}  // namespace

hid_t errorRecordingProperties() {
  static const H5FD_class_t description = driver();
  static const hid_t registered = H5FDregister(&description);
  const hid_t properties = H5Pcreate(H5P_FILE_ACCESS);
  if (H5Pset_driver(properties, registered, nullptr) < 0) {
    H5Pclose(properties);
    return -1;
  }
  return properties;
}

int recordedError() { return firstError; }

const std::string& refusalReason() { return refusal; }

}  // namespace squeal::fieldfile
