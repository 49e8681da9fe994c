// Loaded into the program by LD_PRELOAD: the time of day goes back an hour at every second question, as when
// a clock is set, by hand or by the network. For tests/demos/program/faults_program_test.cpp.
#include <atomic>
#include <ctime>

#include <dlfcn.h>
#include <sys/time.h>

namespace {

constexpr time_t kHour_s = 3600;

time_t jump() {
  static std::atomic<unsigned> asked{0};
  return asked++ % 2 == 0 ? 0 : -kHour_s;
}

template <typename Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* at) noexcept {
  static auto* const original = next<int(clockid_t, timespec*)>("clock_gettime");
  const int answer = original(clock, at);
  if (answer == 0 && clock == CLOCK_REALTIME) at->tv_sec += jump();
  return answer;
}

extern "C" int gettimeofday(timeval* at, void* zone) noexcept {
  static auto* const original = next<int(timeval*, void*)>("gettimeofday");
  const int answer = original(at, zone);
  if (answer == 0) at->tv_sec += jump();
  return answer;
}

extern "C" time_t time(time_t* at) noexcept {
  static auto* const original = next<time_t(time_t*)>("time");
  const time_t now = original(nullptr) + jump();
  if (at != nullptr) *at = now;
  return now;
}
