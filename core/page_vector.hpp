#pragma once
// Arrays that share no page of memory with others: a device may lock their pages.

#include <cstddef>
#include <new>
#include <vector>

namespace tread {

template <class T>
struct PageAllocator {
  using value_type = T;
  static constexpr std::size_t kPage = 4096;  ///< [B]
  static constexpr std::align_val_t alignment{kPage};

  PageAllocator() = default;
  template <class U>
  PageAllocator(const PageAllocator<U>& /*other*/) {}

  T* allocate(std::size_t n) {
    const std::size_t pages = (n * sizeof(T) + kPage - 1) / kPage;
    return static_cast<T*>(::operator new(pages* kPage, alignment));
  }
  void deallocate(T* p, std::size_t /*n*/) { ::operator delete(p, alignment); }
  bool operator==(const PageAllocator& /*other*/) const { return true; }
};

template <class T>
using PageVector = std::vector<T, PageAllocator<T>>;

}  // namespace tread
