#pragma once
/// Messages that carry meshes and matrices between processes.
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace squeal {

/// A flat message of numbers and texts. Take them in the order and with the types in which they
/// were put; nothing checks this.
class Buffer {
 public:
  template <class Number>
  void put(const std::vector<Number>& values) {
    static_assert(std::is_trivially_copyable_v<Number>);
    const std::size_t count = values.size(), begin = bytes_.size();
    bytes_.resize(begin + sizeof count + count * sizeof(Number));
    std::memcpy(bytes_.data() + begin, &count, sizeof count);
    if (count)
      std::memcpy(bytes_.data() + begin + sizeof count, values.data(), count * sizeof(Number));
  }
  void put(const std::vector<std::string>& texts) {
    put(std::vector<std::size_t>{texts.size()});
    for (const auto& text : texts) put(std::vector<char>(text.begin(), text.end()));
  }
  template <class Number>
  std::vector<Number> take() {
    std::size_t count = 0;
    std::memcpy(&count, bytes_.data() + at_, sizeof count);
    std::vector<Number> values(count);
    if (count)
      std::memcpy(values.data(), bytes_.data() + at_ + sizeof count, count * sizeof(Number));
    at_ += sizeof count + count * sizeof(Number);
    return values;
  }
  std::vector<std::string> takeTexts() {
    std::vector<std::string> texts(take<std::size_t>().at(0));
    for (auto& text : texts) {
      const auto characters = take<char>();
      text.assign(characters.begin(), characters.end());
    }
    return texts;
  }
  std::vector<char>& bytes() { return bytes_; }

 private:
  std::vector<char> bytes_;
  std::size_t at_ = 0;
};

}  // namespace squeal
