// Words in messages: lists joined for reading, the one nearest to a misspelt word, names that are plain.
#pragma once
#include <algorithm>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace nanson {

/// Letters to insert, delete, replace or swap with their neighbour to get from `a` to `b` (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// Letters, digits, - and _ only: fit for a file name and a bare TOML key.
bool is_plain(std::string_view name);

/// "a | b | c", for any range of strings.
template <class Words>
std::string join_words(const Words& words, std::string_view separator = " | ") {
  std::string joined;
  for (const auto& word : words) {
    if (!joined.empty()) joined += separator;
    joined += word;
  }
  return joined;
}

/// The nearest of `words`, empty when none is near enough to be what was meant: at most a third of the letters differ, or one, and never all.
template <class Words>
std::string nearest_word(std::string_view word, const Words& words) {
  std::size_t reach = std::min(std::max<std::size_t>(1, word.size() / 3) + 1, word.size());
  std::string best;
  for (const auto& known : words) {
    const std::string_view k = known;
    if (std::max(k.size(), word.size()) - std::min(k.size(), word.size()) >= reach)
      continue;  // spares the table of long words
    if (const std::size_t d = edit_distance(word, k); d < reach) {
      reach = d;
      best = k;
    }
  }
  return best;
}

/// "unknown face, did you mean "zmin"? allowed: zmin | zmax"
template <class Words>
std::string unknown_word(std::string_view what, std::string_view word, const Words& allowed) {
  const std::string near = nearest_word(word, allowed);
  const std::string list = join_words(allowed);
  return fmt::format("unknown {}{} allowed: {}", what, near.empty() ? "," : fmt::format(", did you mean \"{}\"?", near),
                     list.empty() ? "none" : list);
}

}  // namespace nanson
