#pragma once
// A crew of threads that share out the parts of a job. Which thread does which part is left open, so the
// parts of a job must not depend on each other; what is then computed is the same for every number of
// threads. A step has hundreds of jobs of microseconds each: the crew waits for the next one awake for a
// moment before it sleeps. Tested in tests/engine/foundation/crew_test.cpp.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <type_traits>

namespace carom {

class Crew {
 public:
  /// `threads` >= 1, the caller's own among them; the others start with the first job of several parts.
  explicit Crew(int threads = 1);
  ~Crew();
  Crew(Crew&&) noexcept;
  Crew& operator=(Crew&&) noexcept;

  int threads() const;

  /// Calls `work(part)` once for every part of [0, parts) and returns when all have ended. Throws what a part
  /// has thrown, of several the one with the lowest number. One job at a time, from one thread; a part must
  /// not begin another.
  template <typename Work>
  void run(int parts, Work&& work) {
    using Called = std::remove_reference_t<Work>;
    const auto call = [](const void* object, int part) {
      (*const_cast<Called*>(static_cast<const Called*>(object)))(part);
    };
    share(parts, {&work, call});
  }

  /// Calls `work(begin, end)` for stretches that together are all of [0, count), most of them at least
  /// `least` long; what comes of it must not depend on where they end. As `run` in all else.
  template <typename Work>
  void runStretches(std::size_t count, std::size_t least, Work&& work) {
    const std::size_t most = kStretchesAThread * static_cast<std::size_t>(threads());
    const int stretches =
        threads() == 1 ? 1 : static_cast<int>(std::clamp<std::size_t>(count / least, 1, most));
    run(stretches, [&](int i) {
      const auto end = [&](int k) {
        return count * static_cast<std::size_t>(k) / static_cast<std::size_t>(stretches);
      };
      work(end(i), end(i + 1));
    });
  }

 private:
  static constexpr std::size_t kStretchesAThread = 8;  // so that none waits long for another

  struct Job {  // without owning what it calls
    const void* object = nullptr;
    void (*call)(const void* object, int part) = nullptr;
    void operator()(int part) const { call(object, part); }
  };
  struct State;
  void share(int parts, Job job);

  std::unique_ptr<State> state_;
};

}  // namespace carom
