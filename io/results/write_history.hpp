// history.csv: one row per recorded step, readable by anything while the run goes on.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/history.hpp"
#include "io/posix_file.hpp"

namespace nanson {

/// The first line of the file, line break and all.
std::string history_header(const std::vector<HistoryColumn>& columns);

class HistoryWriter {
 public:
  /// Creates the file (an existing one is emptied) with the header `t [s],dt [s],...`.
  HistoryWriter(std::filesystem::path path, const std::vector<HistoryColumn>& columns);

  /// Goes on after the first `size` bytes of a file of the same columns; what comes later is cut off. Throws FolderError where the file has fewer.
  HistoryWriter(std::filesystem::path path, const std::vector<HistoryColumn>& columns, std::size_t size);

  /// [bytes] so far.
  std::size_t size() const { return size_; }

  /// Appends a row, on disk when this returns; numbers are the shortest text that reads back to the same double, or nan, inf, -inf.
  /// Throws std::runtime_error with the reason when it cannot be written; the file then ends with the last whole row.
  void row(std::span<const double> values);

 private:
  void append(const std::string& line);

  std::filesystem::path path_;
  std::size_t columns_;
  Descriptor file_;
  std::size_t size_ = 0;  // [bytes] written so far, all of them whole rows
  std::string line_;
};

}  // namespace nanson
