// The parts of the cursor that are not called for every number.
#include "io/mesh/msh_cursor.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace nanson {
namespace {

/// For messages: at most 30 characters, and no bytes of binary data.
std::string shown(std::string_view text) {
  std::string clean(text.substr(0, 30));
  std::replace_if(
      clean.begin(), clean.end(), [](unsigned char c) { return c < 32 || c > 126; }, '?');
  return text.size() > 30 ? clean + "..." : clean;
}

}  // namespace

std::size_t MshCursor::checked_count(std::int64_t count, std::string_view what, std::size_t bytes) const {
  if (count < 0) fail(fmt::format("the number of {} is {}, below zero", what, count));
  if (std::size_t(count) > std::size_t(end_ - at_) / bytes + 1)
    fail(fmt::format("the file says {} {} follow, more than its remaining {} bytes can hold: it is cut off or damaged",
                     count, what, end_ - at_));
  return std::size_t(count);
}

bool MshCursor::at_end() {
  skip_space();
  return at_ == end_;
}

std::string_view MshCursor::word() {
  skip_space();
  if (at_ == end_) fail_at_end();
  while (at_ != end_ && !is_space(*at_)) ++at_;
  return {token_, std::size_t(at_ - token_)};
}

std::string_view MshCursor::rest_of_line() {
  token_ = at_;
  at_ = std::find(at_, end_, '\n');
  if (at_ == end_) fail_at_end();
  return {token_, std::size_t(at_++ - token_)};
}

void MshCursor::end_of_line() {
  token_ = at_;
  while (at_ != end_ && (*at_ == ' ' || *at_ == '\t' || *at_ == '\r')) ++at_;
  if (at_ == end_) fail_at_end();
  if (*at_++ != '\n') fail("the line should end here");
}

void MshCursor::expect(std::string_view expected) {
  const auto found = word();
  if (found != expected) fail(fmt::format("expected {}, found \"{}\"", expected, shown(found)));
}

void MshCursor::skip_past(std::string_view line) {
  const std::string_view rest(at_, std::size_t(end_ - at_));
  const auto found = rest.find(fmt::format("\n{}", line));
  if (found == rest.npos) fail(fmt::format("{} is missing: the file is cut off", line));
  at_ += found + 1;
  expect(line);
}

void MshCursor::fail(const std::string& what) const {
  if (binary) throw MshError(fmt::format(" byte {}: {}", token_ - begin_, what));
  throw MshError(fmt::format("{}: {}", 1 + std::count(begin_, token_, '\n'), what));
}

void MshCursor::fail_at_end() const { fail("the file ends here: it is cut off"); }

void MshCursor::fail_number(bool whole) const {
  if (at_ == end_) fail_at_end();
  const char* stop = std::find_if(at_, end_, is_space);
  fail(fmt::format("expected a {}, found \"{}\"", whole ? "whole number" : "number",
                   shown({at_, std::size_t(stop - at_)})));
}

}  // namespace nanson
