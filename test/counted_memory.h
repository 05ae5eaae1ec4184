// SPDX-License-Identifier: MIT

#ifndef RW_SEGMENTATION_TEST_COUNTED_MEMORY_H
#define RW_SEGMENTATION_TEST_COUNTED_MEMORY_H

// Counts what a program holds by `operator new`. One file of a program includes it.

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace counted_memory {

inline std::atomic<std::size_t> in_use = 0, most_in_use = 0;     // several threads may allocate
constexpr std::size_t size_of_note = alignof(std::max_align_t);  // before each block: its size

inline void* allocate(std::size_t size) {
  auto* const block = static_cast<char*>(std::malloc(size + size_of_note));
  if (!block) throw std::bad_alloc();
  *reinterpret_cast<std::size_t*>(block) = size;
  const std::size_t now = in_use += size;
  for (std::size_t most = most_in_use; most < now && !most_in_use.compare_exchange_weak(most, now);) continue;
  return block + size_of_note;
}

inline void release(void* memory) {
  if (!memory) return;
  char* const block = static_cast<char*>(memory) - size_of_note;
  in_use -= *reinterpret_cast<std::size_t*>(block);
  std::free(block);
}

/// The bytes that work holds at most, above what is held before it.
template <class Work>
std::size_t peak_of(const Work& work) {
  const std::size_t before = in_use;
  most_in_use = before;
  work();
  return most_in_use - before;
}

}  // namespace counted_memory

void* operator new(std::size_t size) { return counted_memory::allocate(size); }
void* operator new[](std::size_t size) { return counted_memory::allocate(size); }
// Those of a sanitizer do not call the above, as the standard library's do.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  try {
    return counted_memory::allocate(size);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}
void* operator new[](std::size_t size, const std::nothrow_t& tag) noexcept { return operator new(size, tag); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { counted_memory::release(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { counted_memory::release(memory); }
void operator delete(void* memory) noexcept { counted_memory::release(memory); }
void operator delete[](void* memory) noexcept { counted_memory::release(memory); }
void operator delete(void* memory, std::size_t) noexcept { counted_memory::release(memory); }
void operator delete[](void* memory, std::size_t) noexcept { counted_memory::release(memory); }

#endif
