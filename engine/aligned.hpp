// Arrays that start on a cache line, large ones on a huge page: neighbours' rows are far apart, and small pages cost address look-ups.
#pragma once
#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <cstddef>
#include <new>
#include <vector>

namespace nanson {

template <class T>
struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class Other>
  CacheLineAllocator(const CacheLineAllocator<Other>&) {}
  T* allocate(std::size_t n) {
    const std::size_t bytes = n * sizeof(T);
    void* p = ::operator new(bytes, alignment(n));
    if (bytes < huge_page) return static_cast<T*>(p);
#if defined(__linux__)
    madvise(p, bytes, MADV_HUGEPAGE);  // a wish: nothing is lost when it is refused
#endif
    touch(static_cast<volatile char*>(p), bytes);
    return static_cast<T*>(p);
  }
  void deallocate(T* p, std::size_t n) { ::operator delete(p, alignment(n)); }
  static constexpr std::size_t huge_page = std::size_t{2} << 20;  // [bytes]
  /// Memory belongs to the processor that first writes to it: shares in the threads' order, as parts are dealt out. Inside a parallel region: all to its thread.
  static void touch(volatile char* p, std::size_t bytes) {
    const std::ptrdiff_t pages = static_cast<std::ptrdiff_t>((bytes + small_page - 1) / small_page);
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t page = 0; page < pages; ++page) p[page * static_cast<std::ptrdiff_t>(small_page)] = 0;
  }
  static constexpr std::size_t small_page = 4096;  // [bytes]
  static std::align_val_t alignment(std::size_t n) {
    return std::align_val_t{n * sizeof(T) >= huge_page ? huge_page : 64};
  }
  template <class Other>
  bool operator==(const CacheLineAllocator<Other>&) const {
    return true;
  }
};

template <class T>
using Aligned = std::vector<T, CacheLineAllocator<T>>;

}  // namespace nanson
