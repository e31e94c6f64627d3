#pragma once
/// An archive is a part of the state of a run, on its way to or from a checkpoint.
#include <mpi.h>

#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "base/petsc/check.hpp"
#include "base/petsc/owned.hpp"

namespace squeal::checkpoint {

/// What is said of a checkpoint whose files do not hold what they should.
inline constexpr const char* damaged =
    "an entry of the checkpoint does not hold what it should; without -resume the run begins anew";

/// A Stream writes values one behind the other as bytes, or reads them back in the same order. A
/// type of several members takes part through a function `void fields(Stream&, T&)` in its own
/// namespace, which names all of them once, for both directions.
class Stream {
 public:
  /// Makes an empty stream to write to.
  Stream() = default;
  /// Takes bytes that another stream has written, to read from.
  explicit Stream(std::vector<char> bytes) : bytes_(std::move(bytes)), reads_(true) {}
  bool reads() const { return reads_; }
  /// Returns the bytes written, in pieces one behind the other; borrowed.
  std::vector<std::span<const char>> pieces() const {
    std::vector<std::span<const char>> all;
    for (const auto& [bytes, borrowed, owner] : written_) {
      all.emplace_back(bytes);
      if (!borrowed.empty()) all.push_back(borrowed);
    }
    all.emplace_back(bytes_);
    return all;
  }
  /// Not collective. Writes bytes without a copy: they are borrowed, and `owner` is kept, during
  /// the life of the stream.
  void borrow(std::span<const char> bytes, std::shared_ptr<const void> owner = {}) {
    written_.push_back({std::move(bytes_), bytes, std::move(owner)});
    bytes_.clear();
  }
  /// Not collective. Writes `size` bytes from `data`, or reads them to it. Throws Error where fewer
  /// are left.
  void raw(void* data, std::size_t size) {
    if (!reads_) {
      const auto* from = static_cast<const char*>(data);
      bytes_.insert(bytes_.end(), from, from + size);
      return;
    }
    if (size > bytes_.size() - read_) throw Error(damaged);
    if (size > 0) std::memcpy(data, bytes_.data() + read_, size);
    read_ += size;
  }
  /// Not collective. Writes or sets these values. Throws Error where there are fewer bytes than
  /// they take.
  template <class... Values>
  void operator()(Values&... values) {
    (exchange(values), ...);
  }

 private:
  template <class Value>
  void exchange(Value& value) {
    if constexpr (requires { fields(*this, value); }) {
      fields(*this, value);
    } else {
      static_assert(std::is_trivially_copyable_v<Value> && !std::is_pointer_v<Value>);
      raw(&value, sizeof value);
    }
  }
  template <class Value>
  void exchange(std::vector<Value>& values) {
    std::size_t count = values.size();
    exchange(count);
    if (reads_) {
      if (count > bytes_.size()) throw Error(damaged);
      values.resize(count);
    }
    if constexpr (std::is_trivially_copyable_v<Value> &&
                  !requires(Stream & stream, Value & value) { fields(stream, value); })
      raw(values.data(), count * sizeof(Value));
    else
      for (auto& value : values) exchange(value);
  }
  void exchange(std::string& text) {
    std::vector<char> letters(text.begin(), text.end());
    exchange(letters);
    text.assign(letters.begin(), letters.end());
  }
  template <class Value>
  void exchange(std::optional<Value>& value) {
    bool has = value.has_value();
    exchange(has);
    if (reads_ && has) value.emplace();
    if (reads_ && !has) value.reset();
    if (has) exchange(*value);
  }
  template <class First, class Second>
  void exchange(std::pair<First, Second>& both) {
    exchange(both.first);
    exchange(both.second);
  }

  /// Bytes, and those that lie elsewhere and follow them.
  struct Written {
    std::vector<char> bytes;
    std::span<const char> borrowed;
    std::shared_ptr<const void> owner;
  };
  std::vector<Written> written_;
  std::vector<char> bytes_;  // those behind, or those to be read
  std::size_t read_ = 0;
  bool reads_ = false;
};

/// An Archive holds what all ranks share once, and besides what each rank has alone. The same calls
/// in the same order write it and read it.
class Archive {
 public:
  /// Makes an empty archive to write to.
  explicit Archive(MPI_Comm comm) : comm_(comm) {}
  /// Takes what another archive has written. The common part is the same on all ranks.
  Archive(MPI_Comm comm, std::vector<char> common, std::vector<char> own)
      : common(std::move(common)), own(std::move(own)), comm_(comm) {}
  bool reads() const { return own.reads(); }
  MPI_Comm comm() const { return comm_; }
  /// Collective. Writes a vector, or makes one with the layout that it had; null stays null.
  void vector(OwnedVec& values);

  Stream common;  ///< the same on all ranks; that of rank 0 is kept
  Stream own;     ///< of this rank

 private:
  MPI_Comm comm_;
};

}  // namespace squeal::checkpoint
