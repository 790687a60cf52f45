// SPDX-License-Identifier: Apache-2.0
#include "etendue/acceleration/huge_pages.hpp"

#include <cstdlib>
#ifdef __linux__
#include <sys/mman.h>
#endif

namespace etendue {

namespace {

constexpr std::size_t kPage = std::size_t{1} << 21;
constexpr std::size_t kCacheLine = 64;

std::size_t rounded_up_to(std::size_t bytes, std::size_t step) {
  return (bytes + step - 1) / step * step;
}

}  // namespace

void* allocate_huge(std::size_t bytes) {
  const std::size_t alignment = bytes >= 2 * kPage ? kPage : kCacheLine;
  void* memory = bytes <= std::numeric_limits<std::size_t>::max() - kPage
                     ? std::aligned_alloc(alignment, rounded_up_to(bytes == 0 ? 1 : bytes, alignment))
                     : nullptr;
  if (!memory) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  // A wish; where it is not granted, everything is only slower.
  if (alignment == kPage) (void)madvise(memory, rounded_up_to(bytes, kPage), MADV_HUGEPAGE);
#endif
  return memory;
}

void free_huge(void* memory) {
  std::free(memory);
}

}  // namespace etendue
