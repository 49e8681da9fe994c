#pragma once
// Things that calls borrow for their own time, such as lists of which only the room is kept: no call makes
// its own, no thread keeps one, and two that run at once have two. Tested in
// tests/engine/foundation/object_pool_test.cpp.

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace carom {

template <typename T>
class ObjectPool {
 public:
  /// Gives back at its end what was borrowed.
  class Lease {
   public:
    Lease(ObjectPool& pool, std::unique_ptr<T> thing) : pool_(pool), thing_(std::move(thing)) {}
    ~Lease() { pool_.release(std::move(thing_)); }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    T& operator*() const { return *thing_; }

   private:
    ObjectPool& pool_;
    std::unique_ptr<T> thing_;
  };

  /// From any thread. In the state in which it was last given back, or new.
  Lease acquire() {
    const std::scoped_lock lock(mutex_);
    if (things_.empty()) return {*this, std::make_unique<T>()};
    std::unique_ptr<T> thing = std::move(things_.back());
    things_.pop_back();
    return {*this, std::move(thing)};
  }

 private:
  void release(std::unique_ptr<T> thing) {
    const std::scoped_lock lock(mutex_);
    things_.push_back(std::move(thing));
  }

  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> things_;
};

}  // namespace carom
