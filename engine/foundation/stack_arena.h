#pragma once
// Memory on the stack for vectors that live no longer than a call: what a query needs for its lists it has in
// its own frame, so that no memory is shared between threads, kept between calls or handed from caller to
// caller. What is given back is not used again; lists that outgrow it go on in the heap. (As
// std::pmr::monotonic_buffer_resource, without its virtual calls, which a short query feels.) Invariant: an
// arena is declared before the vectors that it feeds. Tested in tests/engine/foundation/stack_arena_test.cpp.

#include <cstddef>
#include <functional>
#include <new>
#include <vector>

namespace carom {

class Arena {
 public:
  Arena(std::byte* begin, std::size_t bytes) : begin_(begin), next_(begin), end_(begin + bytes) {}
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  /// Null: it has not so much left.
  void* take(std::size_t bytes) {
    const std::size_t whole = (bytes + kAlignment - 1) / kAlignment * kAlignment;
    if (whole > static_cast<std::size_t>(end_ - next_)) return nullptr;
    void* const place = next_;
    next_ += whole;
    return place;
  }
  bool owns(const void* place) const {
    return !std::less<>{}(place, static_cast<const void*>(begin_)) &&
           std::less<>{}(place, static_cast<const void*>(end_));
  }

  static constexpr std::size_t kAlignment = alignof(std::max_align_t);

 private:
  std::byte* begin_;
  std::byte* next_;
  std::byte* end_;
};

template <std::size_t kBytes>
class StackArena : public Arena {
 public:
  StackArena() : Arena(bytes_, kBytes) {}

 private:
  alignas(kAlignment) std::byte bytes_[kBytes];  // not cleared: that would cost more
};

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wfree-nonheap-object"  // gcc 12 does not follow what owns() tells

/// Of the standard library's kind. Without an arena, and for a copy, all comes from the heap.
template <typename T>
class ArenaAllocator {
 public:
  static_assert(alignof(T) <= Arena::kAlignment);
  using value_type = T;

  ArenaAllocator(Arena* arena = nullptr) : arena_(arena) {}
  template <typename Other>
  ArenaAllocator(const ArenaAllocator<Other>& other) : arena_(other.arena()) {}

  T* allocate(std::size_t count) {
    if (arena_ != nullptr)
      if (void* const place = arena_->take(count * sizeof(T))) return static_cast<T*>(place);
    return static_cast<T*>(::operator new(count * sizeof(T)));
  }
  void deallocate(T* place, std::size_t) {
    if (arena_ == nullptr || !arena_->owns(place)) ::operator delete(place);
  }
  ArenaAllocator select_on_container_copy_construction() const { return {}; }
  Arena* arena() const { return arena_; }
  friend bool operator==(const ArenaAllocator&, const ArenaAllocator&) = default;

 private:
  Arena* arena_;
};

#pragma GCC diagnostic pop

template <typename T>
using ArenaVector = std::vector<T, ArenaAllocator<T>>;

}  // namespace carom
