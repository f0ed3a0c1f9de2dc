// Errors of an input file, collected with their places and listed in the file's order.
#pragma once
#include <compare>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <toml++/toml.h>

namespace nanson {

struct Key;

/// Line and column of the file, or within the n-th --set (settings are listed after the file).
struct Place {
  long setting = 0;  // 0: the file
  long line = 1;
  long column = 1;
  auto operator<=>(const Place&) const = default;
};

struct Diagnostics {
  std::string file;
  std::vector<std::pair<Place, std::string>> found;
  std::set<std::string> wrong;  // keys that were reported, so that nothing is concluded from their values
  std::set<const Key*> asked;   // keys of the tables that a reader asked for
};

/// A word of the input that is checked later: its place and its key go along.
struct Word {
  std::string text;
  Place place;
  std::string path;
};

/// Text parsed for the n-th setting carries its number as source path; the file carries none.
std::string source_of_setting(long number);
Place place_of(const toml::source_region& source);

/// "file:line:column" or "--set #n".
std::string where(const Diagnostics& d, const Place& place);

/// A value as a message shows it: on one line, cut when long.
std::string shown(const toml::node& node);

/// A key as TOML writes it: quoted unless it is bare.
std::string shown_key(std::string_view key);

void report(Diagnostics& d, const Place& place, std::string text);

/// "path = found: why", where `found` is left out for tables.
void report(Diagnostics& d, const Place& place, const std::string& path, const toml::node& found, std::string_view why);
void report(Diagnostics& d, const toml::node& found, const std::string& path, std::string_view why);
void report(Diagnostics& d, const Word& word, std::string_view why);

/// All errors as "where: text", sorted by place.
std::vector<std::string> listed(Diagnostics d);

}  // namespace nanson
