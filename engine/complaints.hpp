// Errors about a large input: of each kind the first five in full, the rest as a count.
#pragma once
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace nanson {

/// Indices with commas between: "3, 5, 7". (fmt::join makes g++ 12 warn of an overflow that is not there.)
template <class Indices>
std::string listed(const Indices& indices) {
  std::string text;
  for (const auto i : indices) text += (text.empty() ? "" : ", ") + std::to_string(i);
  return text;
}

class Complaints {
 public:
  /// `plural` names the kind in "... and 12 more <plural>".
  explicit Complaints(std::string plural) : plural_(std::move(plural)) {}

  /// Takes a function that makes the text, so that only texts that are shown are made.
  template <class Text>
  void add(Text&& text) {
    if (++count_ <= shown) texts_.push_back(text());
  }
  std::size_t count() const { return count_; }
  void append_to(std::vector<std::string>& errors) const {
    errors.insert(errors.end(), texts_.begin(), texts_.end());
    if (count_ > shown) errors.push_back("... and " + std::to_string(count_ - shown) + " more " + plural_);
  }

 private:
  static constexpr std::size_t shown = 5;
  std::string plural_;
  std::vector<std::string> texts_;
  std::size_t count_ = 0;
};

}  // namespace nanson
