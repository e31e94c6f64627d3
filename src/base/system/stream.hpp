#pragma once
/// Serialisation of values for messages between processes and for files.
#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/system/error.hpp"

namespace squeal {

/// A Stream serialises values consecutively, or reads them back in the same order. A type of
/// several members takes part through a function `void fields(Stream&, T&)` in its own namespace,
/// which names all of them once, for both directions.
class Stream {
 public:
  /// Makes an empty stream to write to.
  Stream() = default;
  /// Takes bytes that another stream has written, to read from. `damaged` is the message of the
  /// Error if there are fewer than are read.
  explicit Stream(std::vector<char> bytes, const char* damaged = "a message is incomplete")
      : bytes_(std::move(bytes)), damaged_(damaged), reads_(true) {}
  bool reads() const { return reads_; }
  /// Returns the bytes written since the last ones that were borrowed; the stream is used up.
  std::vector<char> bytes() && { return std::move(bytes_); }
  /// Returns the bytes written, in consecutive pieces; borrowed.
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
  /// Not collective. Writes `size` bytes from `data`, or reads them to it. Throws Error if fewer
  /// are left.
  void raw(void* data, std::size_t size) {
    if (!reads_) {
      const auto* from = static_cast<const char*>(data);
      bytes_.insert(bytes_.end(), from, from + size);
      return;
    }
    if (size > bytes_.size() - read_) throw Error(damaged_);
    if (size > 0) std::memcpy(data, bytes_.data() + read_, size);
    read_ += size;
  }
  /// Not collective. Writes or sets these values. Throws Error if there are fewer bytes than they
  /// take.
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
      if (count > bytes_.size()) throw Error(damaged_);
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
  template <class Value>
  void exchange(std::map<std::string, Value>& values) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : values) keys.push_back(key);
    exchange(keys);
    for (const auto& key : keys) exchange(values[key]);
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
  std::vector<char> bytes_;  // the last ones, or those to be read
  const char* damaged_ = "";
  std::size_t read_ = 0;
  bool reads_ = false;
};

}  // namespace squeal
