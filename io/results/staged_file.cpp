// The driver: an overlay of blocks that are held back, the order in which they are written, and the callbacks that HDF5 asks for.
#include "io/results/staged_file.hpp"

#include <sys/file.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <string_view>
#include <tuple>
#include <vector>

#if H5_VERSION_GE(1, 13, 0)
#include <H5FDdevelop.h>
#endif

#include "io/posix_file.hpp"
#include "io/results/hdf5.hpp"

namespace nanson::hdf5 {
namespace {

using Bytes = std::vector<char>;

struct StagedFile : H5FD_t {
  Descriptor file;
  haddr_t eoa = 0;       // end of the addresses that HDF5 has allocated
  haddr_t size = 0;      // of the file now
  haddr_t old_size = 0;  // of the file when it was opened or last committed: below it nothing changes before a commit
  std::map<haddr_t, Bytes> staged;  // what is held back, by address
  int error =
      0;  // errno of the first failure: from then on everything is staged, for HDF5 to read, and no flush succeeds
};

StagedFile& staged_file(H5FD_t* file) { return *static_cast<StagedFile*>(file); }
const StagedFile& staged_file(const H5FD_t* file) { return *static_cast<const StagedFile*>(file); }

/// Puts the reason on HDF5's error stack, under a name that `take_error` knows, and returns a failure.
herr_t report(int error) {
  H5Epush2(H5E_DEFAULT, __FILE__, driver_errors, __LINE__, H5E_ERR_CLS, H5E_FILE, H5E_WRITEERROR, "%s",
           std::strerror(error));
  return -1;
}

herr_t fail(StagedFile& f, int error) {
  f.error = error;
  return report(error);
}

int pwrite_all(int fd, haddr_t at, const char* data, std::size_t size) {
  while (size > 0) {
    const auto written = ::pwrite(fd, data, size, off_t(at));
    if (written < 0 && errno != EINTR) return errno;
    if (written <= 0) continue;
    at += haddr_t(written);
    data += written;
    size -= std::size_t(written);
  }
  return 0;
}

/// Calls visit(block address, block, first, last) for the staged blocks that overlap [first, last), clipped to it.
template <class Staged, class Visit>
void overlaps(Staged& staged, haddr_t begin, haddr_t end, Visit visit) {
  for (auto& [at, block] : staged) {
    if (at >= end) break;
    const haddr_t first = std::max(begin, at), last = std::min(end, at + block.size());
    if (first < last) visit(at, block, first, last);
  }
}

/// Blocks that the new one only partly covers stay, with the new bytes in them, so that their order of writing does not matter.
void stage(std::map<haddr_t, Bytes>& staged, haddr_t begin, const char* data, std::size_t size) {
  const haddr_t end = begin + size;
  overlaps(staged, begin, end, [&](haddr_t at, Bytes& block, haddr_t first, haddr_t last) {
    std::copy(data + (first - begin), data + (last - begin), block.begin() + std::ptrdiff_t(first - at));
  });
  std::erase_if(staged,
                [&](const auto& entry) { return entry.first >= begin && entry.first + entry.second.size() <= end; });
  auto& block = staged[begin];
  if (block.size() < size)
    block.assign(data, data + size);  // otherwise a longer block starts here, and has the bytes already
}

/// The place of a block in the order of a commit, lower first; HDF5's blocks begin with a signature, and a tree node has its level in byte 5.
int rank(haddr_t at, const Bytes& block) {
  const auto begins = [&](std::string_view signature) {
    return std::string_view(block.data(), std::min<std::size_t>(block.size(), 4)) == signature;
  };
  if (at == 0) return 0;
  if (begins("TREE") && block.size() > 5) return 2 + 255 - static_cast<unsigned char>(block[5]);
  if (begins("SNOD")) return 2 + 256;
  return 1;
}

/// Closing a second descriptor of the file makes a network file system say now whether it took the data; a local one does nothing.
int delivery_error(int fd) { return ::close(::dup(fd)) == 0 ? 0 : errno; }

herr_t commit(StagedFile& f) {
  if (f.error == 0) f.error = delivery_error(f.file.get());
  if (f.error != 0) return report(f.error);
  if (f.eoa > f.size) {
    if (::ftruncate(f.file.get(), off_t(f.eoa)) != 0) return fail(f, errno);
    f.size = f.eoa;
  }
  std::vector<std::tuple<int, haddr_t, const Bytes*>> order;
  for (const auto& [at, block] : f.staged) order.emplace_back(rank(at, block), at, &block);
  std::sort(order.begin(), order.end());
  f.old_size = f.size;  // from here on the file is not cut back to what it was
  for (const auto& [unused, at, block] : order)
    if (const int error = pwrite_all(f.file.get(), at, block->data(), block->size())) return fail(f, error);
  if (f.eoa < f.size) {
    if (::ftruncate(f.file.get(), off_t(f.eoa)) != 0) return fail(f, errno);
    f.old_size = f.size = f.eoa;
  }
  f.staged.clear();
  return 0;
}

H5FD_t* open(const char* name, unsigned flags, hid_t, haddr_t) {
  int mode = (flags & H5F_ACC_RDWR) ? O_RDWR : O_RDONLY;
  if (flags & H5F_ACC_CREAT) mode |= O_CREAT;
  if (flags & H5F_ACC_EXCL) mode |= O_EXCL;
  if (flags & H5F_ACC_TRUNC) mode |= O_TRUNC;
  auto f = std::make_unique<StagedFile>();
  f->file = Descriptor(name, mode);
  struct stat now {};
  if (!f->file || ::fstat(f->file.get(), &now) != 0) {
    report(errno);
    return nullptr;
  }
  f->size = f->old_size = haddr_t(now.st_size);
  return f.release();
}

/// Never fails, as HDF5 keeps what it could not close and stumbles over it at the program's end: what is to be known for sure has to be flushed first.
herr_t close(H5FD_t* file) {
  const std::unique_ptr<StagedFile> f(&staged_file(file));
  const bool cut = f->error != 0
                   && ::ftruncate(f->file.get(), off_t(f->old_size)) == 0;  // gives the space of a failed frame back
  static_cast<void>(cut);  // where that is impossible, bytes stay behind the end that the superblock tells
  return 0;
}

/// Never fails either, for the same reason: a data set's last chunks are written when it is closed.
herr_t write(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, const void* data) {
  auto& f = staged_file(file);
  const char* bytes = static_cast<const char*>(data);
  if (f.error == 0 && at >= f.old_size) f.error = pwrite_all(f.file.get(), at, bytes, size);
  if (f.error == 0 && at >= f.old_size) f.size = std::max(f.size, at + size);
  else stage(f.staged, at, bytes, size);
  return 0;
}

herr_t flush(H5FD_t* file, hid_t, hbool_t closing) {
  const herr_t done = commit(staged_file(file));
  return closing ? 0 : done;
}

herr_t read(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t at, std::size_t size, void* data) {
  auto& f = staged_file(file);
  char* bytes = static_cast<char*>(data);
  std::size_t done = 0;
  while (done < size) {
    const auto got = ::pread(f.file.get(), bytes + done, size - done, off_t(at + done));
    if (got < 0 && errno != EINTR) return report(errno);
    if (got == 0) break;
    if (got > 0) done += std::size_t(got);
  }
  std::fill(bytes + done, bytes + size, 0);  // beyond the end of the file HDF5 expects zeros
  overlaps(f.staged, at, at + size, [&](haddr_t begin, const Bytes& block, haddr_t first, haddr_t last) {
    std::copy(block.begin() + std::ptrdiff_t(first - begin), block.begin() + std::ptrdiff_t(last - begin),
              bytes + (first - at));
  });
  return 0;
}

herr_t lock(H5FD_t* file, hbool_t exclusive) {
  return ::flock(staged_file(file).file.get(), (exclusive ? LOCK_EX : LOCK_SH) | LOCK_NB) == 0 ? 0 : report(errno);
}

herr_t unlock(H5FD_t* file) { return ::flock(staged_file(file).file.get(), LOCK_UN) == 0 ? 0 : report(errno); }

herr_t query(const H5FD_t*, unsigned long* flags) {
  // no accumulation of metadata: it would merge neighbouring blocks, which the order of a commit has to tell apart
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_DATA_SIEVE | H5FD_FEAT_AGGREGATE_SMALLDATA
           | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

H5FD_class_t driver_class() {
  H5FD_class_t c{};
#ifdef H5FD_CLASS_VERSION
  c.version = H5FD_CLASS_VERSION;
  c.value = H5FD_class_value_t(512);  // the first number that HDF5 leaves to programs for themselves
#endif
  c.name = "nanson_staged";
  c.maxaddr = (haddr_t{1} << 63) - 1;
  c.fc_degree = H5F_CLOSE_SEMI;
  c.open = open;
  c.close = close;
  c.query = query;
  c.get_eoa = [](const H5FD_t* file, H5FD_mem_t) { return staged_file(file).eoa; };
  c.set_eoa = [](H5FD_t* file, H5FD_mem_t, haddr_t eoa) {
    staged_file(file).eoa = eoa;
    return herr_t{0};
  };
  c.get_eof = [](const H5FD_t* file, H5FD_mem_t) { return staged_file(file).size; };
  c.read = read;
  c.write = write;
  c.flush = flush;
  c.truncate = [](H5FD_t*, hid_t, hbool_t) { return herr_t{0}; };  // part of the commit
  c.lock = lock;
  c.unlock = unlock;
  std::fill(std::begin(c.fl_map), std::end(c.fl_map),
            H5FD_MEM_SUPER);  // one free list for metadata and one for data, like HDF5's own driver
  c.fl_map[H5FD_MEM_DRAW] = c.fl_map[H5FD_MEM_GHEAP] = H5FD_MEM_DRAW;
  return c;
}

}  // namespace

void use_staged_driver(hid_t file_access) {
  static const H5FD_class_t driver = driver_class();
  static const hid_t id = check(H5FDregister(&driver), "file driver");
  check(H5Pset_driver(file_access, id, nullptr), "file driver");
}

}  // namespace nanson::hdf5
