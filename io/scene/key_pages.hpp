// What a table of keys tells people: on the terminal, and as pages.
#pragma once
#include <span>
#include <string>
#include <string_view>

#include "io/scene/key.hpp"

namespace nanson {

/// "number above 0 [s], required"; "alternating | kuhn, default alternating".
std::string value_text(const Key& key);

/// True for the path itself, one that lies in the section `name`, one whose last part is `name`, and for every path when `name` is empty.
bool is_meant(std::string_view path, std::string_view name);

/// Broken at blanks for a terminal, every line after `indent` blanks.
std::string wrapped(const std::string& text, std::size_t indent);

/// All keys, or those whose path, section or last name is `name`; empty when there are none.
std::string keys_text(std::span<const Key> keys, std::string_view name);

/// A table for each section, below headings of the third level.
std::string keys_markdown(std::span<const Key> keys);

/// What --set can be completed to, one a line: "time.end=", "time.step=dual", ...
std::string settings_text(std::span<const Key> keys);

/// Paths, sections and last names, each once: what a user may ask for.
std::vector<std::string> key_names(std::span<const Key> keys);

/// The default as it is shown; empty where there is none, or where it stands for "not at all".
std::string shown_default(const Key& key);

/// Text for a cell of a Markdown table.
std::string table_cell(std::string text);

/// A section with its own sentence, or a list of such.
bool is_section(const Key& key);

}  // namespace nanson
