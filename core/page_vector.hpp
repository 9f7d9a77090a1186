#pragma once
// Arrays that share no page of memory with others, and of which only what is touched takes memory: a device
// may lock their pages, and ranks hold fields of which they use a part.

#include <sys/mman.h>

#include <cstddef>
#include <new>
#include <span>
#include <utility>
#include <vector>

namespace tread {

/// New elements are zero bytes, which nobody has written: arrays keep the size that they begin with.
template <class T>
struct PageAllocator {
  using value_type = T;
  static constexpr std::size_t kPage = 4096;  ///< [B]

  PageAllocator() = default;
  template <class U>
  PageAllocator(const PageAllocator<U>& /*other*/) {}

  /// From the kernel: calloc() clears memory that was used before, and so touches it.
  T* allocate(std::size_t n) {
    void* const pages = ::mmap(nullptr, bytes(n), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (pages == MAP_FAILED) throw std::bad_alloc();
    return static_cast<T*>(pages);
  }
  void deallocate(T* p, std::size_t n) { ::munmap(p, bytes(n)); }

  template <class U>
  void construct(U* /*zeros*/) {}
  template <class U, class Value>
  void construct(U* place, Value&& value) {
    ::new (static_cast<void*>(place)) U(std::forward<Value>(value));
  }
  bool operator==(const PageAllocator& /*other*/) const { return true; }

 private:
  static std::size_t bytes(std::size_t n) { return (n * sizeof(T) + kPage - 1) / kPage * kPage; }
};

template <class T>
using PageVector = std::vector<T, PageAllocator<T>>;

/// Asks for pages of 2 MiB, before the array is touched, where all of it will be: a step walks through more
/// pages of 4 KiB than a processor keeps addresses of. A kernel without such pages leaves all as it is.
template <class T>
void use_large_pages(PageVector<T>& values) {
  if (!values.empty()) ::madvise(values.data(), values.size() * sizeof(T), MADV_HUGEPAGE);
}

/// Gives the memory of the pages that lie in the elements [first, last) back; these are zeros again.
template <class T>
void forget(PageVector<T>& values, std::size_t first, std::size_t last) {
  constexpr std::size_t kPage = PageAllocator<T>::kPage;
  const std::size_t begin = (first * sizeof(T) + kPage - 1) / kPage * kPage;
  const std::size_t end = last * sizeof(T) / kPage * kPage;
  if (begin < end) ::madvise(reinterpret_cast<std::byte*>(values.data()) + begin, end - begin, MADV_DONTNEED);
}

/// Does so where no group of `size` elements is marked.
template <class T>
void keep_marked(PageVector<T>& values, std::span<const unsigned char> groups, std::size_t size) {
  for (std::size_t first = 0; first < groups.size(); ++first) {
    std::size_t last = first;
    while (last < groups.size() && groups[last] == 0) ++last;
    forget(values, first * size, last * size);
    first = last;
  }
}

}  // namespace tread
