#pragma once
// Arrays that share no page of memory with others, and of which only what is touched takes memory: a device
// may lock their pages, and ranks hold fields of which they use a part.

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <memory>
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

  T* allocate(std::size_t n) {
    const std::size_t pages = (n * sizeof(T) + kPage - 1) / kPage;
    void* const whole = std::calloc(pages + 2, kPage);
    if (whole == nullptr) throw std::bad_alloc();
    // The first page boundary behind a pointer's length: the place before it holds where all began.
    void* first = static_cast<std::byte*>(whole) + sizeof(void*);
    std::size_t room = (pages + 2) * kPage - sizeof(void*);
    auto* const values = static_cast<void**>(std::align(kPage, pages * kPage, first, room));
    values[-1] = whole;
    return reinterpret_cast<T*>(values);
  }
  void deallocate(T* p, std::size_t /*n*/) { std::free(reinterpret_cast<void**>(p)[-1]); }

  template <class U>
  void construct(U* /*zeros*/) {}
  template <class U, class Value>
  void construct(U* place, Value&& value) {
    ::new (static_cast<void*>(place)) U(std::forward<Value>(value));
  }
  bool operator==(const PageAllocator& /*other*/) const { return true; }
};

template <class T>
using PageVector = std::vector<T, PageAllocator<T>>;

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
