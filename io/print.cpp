// UTF-8 by its lead bytes; the first failure of the standard output is kept.
#include "io/print.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace nanson {
namespace {

int output_error = 0;

/// Bytes of the character that text begins with; 0 when it is none that may be shown.
std::size_t shown_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return (lead >= 0x20 && lead != 0x7f) || lead == '\n' || lead == '\t' ? 1 : 0;
  const std::size_t length = lead >= 0xf0 && lead < 0xf5 ? 4 : lead >= 0xe0 && lead < 0xf0 ? 3 : lead >= 0xc2 ? 2 : 0;
  if (length == 0 || lead >= 0xf5 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  return lead == 0xc2 && byte(1) < 0xa0 ? 0 : length;  // U+0080 to U+009F: controls
}

}  // namespace

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = shown_length(text);
    if (length == 0) out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[0]));
    else out += text.substr(0, length);
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return out;
}

void print_text(std::FILE* to, std::string_view text) {
  const std::string shown = printable(text);
  errno = 0;
  const bool out = std::fwrite(shown.data(), 1, shown.size(), to) == shown.size();
  if (!out && to == stdout && output_error == 0) output_error = errno != 0 ? errno : EIO;
}

void open_standard_streams() {
  for (int fd = 0; fd < 3; ++fd)
    if (::fcntl(fd, F_GETFD) < 0 && errno == EBADF) {
      const int null = ::open("/dev/null", O_RDWR);  // the lowest that is free: fd, as those below are open
      static_cast<void>(null);
    }
  std::signal(SIGPIPE, SIG_IGN);
}

int lost_output() {
  errno = 0;
  if (std::fflush(stdout) != 0 && output_error == 0) output_error = errno != 0 ? errno : EIO;
  if (output_error == 0 && std::ferror(stdout)) output_error = EIO;
  return output_error == EPIPE ? 0 : output_error;
}

}  // namespace nanson
