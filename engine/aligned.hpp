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
    void* p = ::operator new(n * sizeof(T), alignment(n));
#if defined(__linux__)
    if (n * sizeof(T) >= huge_page) madvise(p, n * sizeof(T), MADV_HUGEPAGE);  // a wish: nothing is lost when it is refused
#endif
    return static_cast<T*>(p);
  }
  void deallocate(T* p, std::size_t n) { ::operator delete(p, alignment(n)); }
  static constexpr std::size_t huge_page = std::size_t{2} << 20;  // [bytes]
  static std::align_val_t alignment(std::size_t n) { return std::align_val_t{n * sizeof(T) >= huge_page ? huge_page : 64}; }
  template <class Other>
  bool operator==(const CacheLineAllocator<Other>&) const { return true; }
};

template <class T>
using Aligned = std::vector<T, CacheLineAllocator<T>>;

}  // namespace nanson
