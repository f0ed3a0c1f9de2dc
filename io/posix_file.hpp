// A file descriptor that closes itself, and writing to it in full: for the places where std::ofstream would hide why a write failed.
#pragma once
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string_view>
#include <utility>

namespace nanson {

class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  Descriptor(const std::filesystem::path& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  /// 0, or the errno of a write that was only noticed now (network file systems).
  int close() { return fd_ >= 0 && ::close(std::exchange(fd_, -1)) != 0 ? errno : 0; }
  explicit operator bool() const { return fd_ >= 0; }
  int get() const { return fd_; }

 private:
  int fd_;
};

/// 0 when all of it was written, otherwise errno.
inline int write_all(int fd, std::string_view text) {
  while (!text.empty()) {
    const auto written = ::write(fd, text.data(), text.size());
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) text.remove_prefix(std::size_t(written));
  }
  return 0;
}

/// 0 when the disk has all of a file, or the names in a folder; otherwise errno.
inline int sync_file(const std::filesystem::path& path) {
  const Descriptor file(path, O_RDONLY);
  return file && ::fsync(file.get()) == 0 ? 0 : errno;
}

}  // namespace nanson
