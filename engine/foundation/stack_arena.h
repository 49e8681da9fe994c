#pragma once
// Memory on the stack for vectors that live no longer than a call: what a query needs for its lists it has in
// its own frame, so that no memory is shared between threads, kept between calls or handed from caller to
// caller. Lists that outgrow it go on in the heap. Invariant: declared before the vectors that it feeds.
// Tested in tests/engine/foundation/stack_arena_test.cpp.

#include <array>
#include <cstddef>
#include <memory_resource>

namespace carom {

template <std::size_t kBytes>
class StackArena {
 public:
  StackArena() = default;
  StackArena(const StackArena&) = delete;
  StackArena& operator=(const StackArena&) = delete;

  /// What std::pmr::vector takes.
  std::pmr::memory_resource* resource() { return &resource_; }

 private:
  alignas(std::max_align_t) std::array<std::byte, kBytes> bytes_;  // not cleared: that would cost more
  std::pmr::monotonic_buffer_resource resource_{bytes_.data(), kBytes};
};

}  // namespace carom
