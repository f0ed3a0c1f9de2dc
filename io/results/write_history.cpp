// Rows as text, and files that take no more of them.
#include "io/results/write_history.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cmath>
#include <cstring>
#include <iterator>
#include <stdexcept>

#include "io/read_csv.hpp"
#include "io/results/results_folder.hpp"

namespace nanson {

std::string history_header(const std::vector<HistoryColumn>& columns) {
  std::string line;
  for (const auto& column : columns) {
    if (!line.empty()) line += ',';
    line += csv_text(fmt::format("{} [{}]", column.name, column.unit));
  }
  return line += '\n';
}

HistoryWriter::HistoryWriter(std::filesystem::path path, const std::vector<HistoryColumn>& columns)
    : path_(std::move(path)), columns_(columns.size()), file_(path_, O_WRONLY | O_CREAT | O_TRUNC) {
  if (!file_)
    throw std::runtime_error(fmt::format("{}: could not be created: {}", path_.string(), std::strerror(errno)));
  append(history_header(columns));
}

HistoryWriter::HistoryWriter(std::filesystem::path path, const std::vector<HistoryColumn>& columns, std::size_t size)
    : path_(std::move(path)), columns_(columns.size()), file_(path_, O_WRONLY), size_(size) {
  struct stat now {};
  const bool read = file_ && ::fstat(file_.get(), &now) == 0;
  const bool whole = read && now.st_size >= off_t(size);
  if (whole && ::ftruncate(file_.get(), off_t(size)) == 0 && ::lseek(file_.get(), 0, SEEK_END) >= 0) return;
  throw FolderError(
      fmt::format("{}: the run cannot go on in it: {}", path_.string(),
                  read && !whole ? fmt::format("it has {} of {} bytes", now.st_size, size) : std::strerror(errno)));
}

void HistoryWriter::row(std::span<const double> values) {
  if (values.size() != columns_)
    throw std::logic_error(fmt::format("a history row of {} values for {} columns", values.size(), columns_));
  line_.clear();
  for (const double value : values) {
    if (!line_.empty()) line_ += ',';
    if (std::isnan(value)) line_ += "nan";  // fmt would write -nan for half of them
    else fmt::format_to(std::back_inserter(line_), "{}", value);
  }
  append(line_ += '\n');
}

/// Straight to the system, a few microseconds: a row held back would be lost with a killed run. A file that was deleted still takes rows, to nobody's use.
void HistoryWriter::append(const std::string& line) {
  int error = write_all(file_.get(), line);
  struct stat now {};
  if (error == 0 && ::fstat(file_.get(), &now) == 0 && now.st_nlink == 0) error = ENOENT;
  if (error == 0) {
    size_ += line.size();
    return;
  }
  const bool cut = ::ftruncate(file_.get(), off_t(size_)) == 0 && ::lseek(file_.get(), off_t(size_), SEEK_SET) >= 0;
  throw std::runtime_error(fmt::format("{}: a row could not be written: {}{}", path_.string(), std::strerror(error),
                                       cut ? "" : "; the last row is cut"));
}

}  // namespace nanson
