// What people read. On a stream that is full or closed it is lost, which must not end a run, and nothing in it steers the terminal.
#pragma once
#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <string_view>

namespace nanson {

/// Control characters other than line breaks and tabs, and bytes that are no UTF-8, as \xNN.
std::string printable(std::string_view text);

void print_text(std::FILE* to, std::string_view text);

template <class... T>
void print(std::FILE* to, fmt::format_string<T...> format, T&&... values) {
  print_text(to, fmt::format(format, std::forward<T>(values)...));
}

/// To be called before anything is opened: /dev/null for each standard stream that is closed, as the first file opened would take its place and its text.
/// SIGPIPE is ignored: a run goes on when nobody reads its lines any more.
void open_standard_streams();

/// Why text for the standard output was lost, an errno; 0 when all of it is out, or nobody reads it any more.
int lost_output();

}  // namespace nanson
