// The long run: long_run [--queries N] [--seed S] [--threads T]. Random hulls of 8 to 252 vertices, half of
// the queries coherent (a short flight remembered from query to query), half cold; apart and penetrating.
// Every answer is checked by the linear certificate; what it leaves open, and every 4096th depth, by the
// exhaustive oracle. Each thread has a stream of its own, so a count repeats for the same seed and number of
// threads. Exit code 1 when an answer is off by more than 1e-12 of the pair's size.

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <thread>
#include <vector>

#include "tests/bench/peers/carom_query.h"
#include "tests/bench/queries/linear_certificate.h"
#include "tests/bench/queries/true_gap.h"
#include "tests/oracle/test_shapes.h"

namespace carom::bench {
namespace {

constexpr double kRight = 1e-12;         // of the pair's size
constexpr double kDirection = 1e-7;      // the same, for a depth's normal
constexpr long kDepthsPerSearch = 4096;  // the certificate bounds a depth from one side only

struct Options {
  long queries = 100'000'000;
  long seed = 1;
  long threads = 2;
};

struct Counts {
  long asked = 0, penetrating = 0, searched = 0, violations = 0, limits = 0;
  double largest = 0.0;  ///< Error, relative to the pair's size.
};

class Stream {
 public:
  Stream(std::uint64_t seed, std::atomic<long>& done) : random_(seed), done_(done) {
    constexpr int kHulls = 48;
    for (int i = 0; i < kHulls; ++i) {
      const Vec3 axes(1.0, random_.uniform(0.2, 1.0), random_.uniform(0.2, 1.0));
      const int n = static_cast<int>(random_.logUniform(8.0, 253.0));
      hulls_.push_back({oracle::randomHull(random_, n, axes), 0.0});
    }
  }

  void run(long queries) {
    while (counts_.asked < queries) fly(std::min(queries - counts_.asked, long{random_.integer(1, 127)}));
  }
  const Counts& counts() const { return counts_; }

 private:
  const ConvexPart& pick() {
    return hulls_[static_cast<std::size_t>(random_.integer(0, static_cast<int>(hulls_.size()) - 1))];
  }
  void fly(long queries);
  void check(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
             const ClosestFeatures& c);
  double searchedError(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
                       const ClosestFeatures& c, double size);

  oracle::Random random_;
  std::atomic<long>& done_;
  std::vector<ConvexPart> hulls_;
  PartPlacer placer_;
  Memory memory_{};
  Counts counts_;
};

// A flight of one pair: coherent, or a fresh pose and nothing remembered each time.
void Stream::fly(long queries) {
  const ConvexPart &a = pick(), &b = pick();
  const bool coherent = random_.integer(0, 1) == 1;
  const double reach = a.core.radiusAbout(Vec3::Zero()) + b.core.radiusAbout(Vec3::Zero());
  const auto start = [&](Pose& X_WA, Pose& X_WB) {
    X_WA = random_.pose(0.5);
    X_WB = {random_.rotation(), X_WA.position + random_.uniform(0.2, 2.0) * reach * random_.direction()};
  };
  Pose X_WA, X_WB;
  start(X_WA, X_WB);
  const double turn_rad = random_.logUniform(1e-6, 0.1);
  const Quat turn_a = oracle::turned(random_.direction(), turn_rad);
  const Quat turn_b = oracle::turned(random_.direction(), turn_rad);
  const Vec3 step = turn_rad * random_.uniform(0.0, 1.0) * random_.direction();
  forget(memory_);
  for (long i = 0; i < queries; ++i) {
    if (coherent) {
      X_WA.rotation = (turn_a * X_WA.rotation).normalized();
      X_WB.rotation = (turn_b * X_WB.rotation).normalized();
      X_WB.position += step;
    } else {
      start(X_WA, X_WB);
      forget(memory_);
    }
    check(a, X_WA, b, X_WB, ask(a, X_WA, b, X_WB, memory_));
  }
  done_ += queries;
}

double Stream::searchedError(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
                             const ClosestFeatures& c, double size) {
  ++counts_.searched;
  const JudgedPart pa = placer_.at(a, X_WA), pb = placer_.at(b, X_WB);
  const Real freed = gapAlong(pa.placed, pb.placed, c.n_W.cast<Real>());
  const double error = std::abs(double(std::max(trueGap(pa, pb), freed)) - c.distance_m) / size;
  const bool frees = c.distance_m > 0.0 || std::abs(double(freed) - c.distance_m) <= kDirection * size;
  return frees ? error : std::numeric_limits<double>::infinity();
}

void Stream::check(const ConvexPart& a, const Pose& X_WA, const ConvexPart& b, const Pose& X_WB,
                   const ClosestFeatures& c) {
  ++counts_.asked;
  counts_.penetrating += c.distance_m <= 0.0;
  counts_.limits += c.reached_limit;
  const double size = a.core.radiusAbout(Vec3::Zero()) + b.core.radiusAbout(Vec3::Zero());
  double error = provenWithin(a, X_WA, b, X_WB, c) / size;
  const bool in_turn = c.distance_m <= 0.0 && counts_.penetrating % kDepthsPerSearch == 0;
  if (!(error <= kRight) || in_turn) error = searchedError(a, X_WA, b, X_WB, c, size);
  counts_.largest = std::max(counts_.largest, error);
  if (error <= kRight) return;
  ++counts_.violations;
  std::fprintf(stderr, "query %ld: off by %.3g of the size, distance %.17g\n", counts_.asked, error,
               c.distance_m);
}

// A line every half minute, until all is done.
void tellProgress(const std::atomic<long>& done, long all) {
  constexpr auto kPause = std::chrono::milliseconds(100);
  constexpr int kPausesPerLine = 300;
  for (int i = 1; done < all; ++i) {
    std::this_thread::sleep_for(kPause);
    if (i % kPausesPerLine == 0)
      std::fprintf(stderr, "%ld of %ld queries, %ld s\n", done.load(), all, long{i / (kPausesPerLine / 30)});
  }
}

int run(const Options& options) {
  std::atomic<long> done = 0;
  std::vector<Stream> streams;
  streams.reserve(static_cast<std::size_t>(options.threads));
  std::vector<std::thread> threads;
  for (long t = 0; t < options.threads; ++t) {
    const long share = options.queries / options.threads + (t < options.queries % options.threads ? 1 : 0);
    Stream& stream = streams.emplace_back(static_cast<std::uint64_t>(1000 * options.seed + t), done);
    threads.emplace_back([&stream, share] { stream.run(share); });
  }
  tellProgress(done, options.queries);
  for (std::thread& thread : threads) thread.join();
  Counts all;
  for (const Stream& stream : streams) {
    all.asked += stream.counts().asked;
    all.penetrating += stream.counts().penetrating;
    all.searched += stream.counts().searched;
    all.violations += stream.counts().violations;
    all.limits += stream.counts().limits;
    all.largest = std::max(all.largest, stream.counts().largest);
  }
  std::printf("%ld queries, %ld penetrating, %ld answered by exhaustive search of ours\n", all.asked,
              all.penetrating, all.limits);
  std::printf(
      "%ld violations; %ld judged by the exhaustive oracle, the rest certified; largest error %.1e of the "
      "size\n",
      all.violations, all.searched, all.largest);
  return all.violations > 0 ? 1 : 0;
}

}  // namespace
}  // namespace carom::bench

int main(int argc, char** argv) {
  carom::bench::Options options;
  for (int i = 1; i < argc; i += 2) {
    const std::string_view option = argv[i];
    long* const value = option == "--queries"   ? &options.queries
                        : option == "--seed"    ? &options.seed
                        : option == "--threads" ? &options.threads
                                                : nullptr;
    char* end = nullptr;
    if (value != nullptr && i + 1 < argc) *value = std::strtol(argv[i + 1], &end, 10);
    const bool good = end != nullptr && end != argv[i + 1] && *end == '\0' && *value >= 0 &&
                      options.threads >= 1 && options.threads <= 256 && options.seed <= 1'000'000'000;
    if (!good) {
      std::fprintf(stderr, "usage: long_run [--queries N] [--seed S] [--threads T]\n");
      return 2;
    }
  }
  return carom::bench::run(options);
}
