// Queries with one memory for all of them against the same queries cold: any_history [--queries N] [--seed S]
// [--threads T]. The sequences mix what a memory may have lived through: poses of exact lattices, jumps, slow
// motion, and pairs of the adversarial families in any order (boxes, needles, plates, hulls, 200-gons, balls,
// capsules), apart, touching and deep inside each other; the memory passes from pair to pair unforgotten.
// Each answer must be of the cold one's class, its distance that to 1e-12 of the pair's size, its numbers
// finite and its witnesses its distance along its normal apart. (In exact ties normals and features are a
// choice; and classes are intervals of the distance, so that two distances which are one but for rounding may
// lie on both sides of a border: those are told apart.) Each thread has a stream of its own, so a count
// repeats for the same seed and number of threads. Exit code 1 when an answer differs; the first ones are
// told on stderr.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <thread>
#include <vector>

#include "tests/bench/peers/carom_query.h"
#include "tests/oracle/adversarial_pairs.h"

namespace carom::bench {
namespace {

using oracle::Family;
using oracle::PosedPair;

constexpr double kSame = 1e-12;        // of the pair's size
constexpr double kRounding = 0x1p-50;  // likewise: four units in the last place
constexpr long kTold = 20;

struct Options {
  long queries = 1'000'000;
  long seed = 1;
  long threads = 2;
};

struct Counts {
  long asked = 0, penetrating = 0, classes = 0, distances = 0, witnesses = 0, not_finite = 0;
  long at_borders = 0;   ///< Classes that differ where distances do not but by rounding.
  double largest = 0.0;  ///< Difference from cold, relative to the pair's size.

  long wrong() const { return classes + distances + witnesses + not_finite; }
  void add(const Counts& other) {
    asked += other.asked;
    penetrating += other.penetrating;
    classes += other.classes;
    distances += other.distances;
    witnesses += other.witnesses;
    not_finite += other.not_finite;
    at_borders += other.at_borders;
    largest = std::max(largest, other.largest);
  }
};

class Stream {
 public:
  explicit Stream(std::uint64_t seed) : pairs_(seed) {}

  void run(long queries) {
    while (counts_.asked < queries) {
      const auto family = static_cast<Family>(random().integer(0, static_cast<int>(Family::kCount) - 1));
      sequence(pairs_.next(family), std::min(queries - counts_.asked, long{random().integer(1, 48)}));
    }
  }
  const Counts& counts() const { return counts_; }

 private:
  enum class Course { kLattice, kJumps, kSlow, kShuffled, kCount };

  oracle::Random& random() { return pairs_.random(); }
  void sequence(PosedPair pair, long queries);
  void check(const PosedPair& pair);
  void tell(const PosedPair& pair, const ClosestFeatures& got, const ClosestFeatures& want) const;

  oracle::AdversarialPairs pairs_;
  Memory memory_{};
  Memory cold_{};
  Counts counts_;
};

Quat latticeTurn(oracle::Random& random) {
  const double quarter = std::numbers::pi / 2;
  const Quat exact[] = {Quat(1, 0, 0, 0), Quat(0, 1, 0, 0), Quat(0, 0, 1, 0), Quat(0, 0, 0, 1)};
  const Quat half = exact[random.integer(0, 3)];
  if (random.integer(0, 1) == 0) return half;
  return oracle::turned(Vec3::Unit(random.integer(0, 2)), quarter * random.integer(0, 3)) * half;
}

// One pair on one course (or one query each of many pairs), from the pair's own pose on.
void Stream::sequence(PosedPair pair, long queries) {
  const auto course = static_cast<Course>(random().integer(0, static_cast<int>(Course::kCount) - 1));
  const double size = pair.a->core.radius() + pair.b->core.radius() + pair.a->radius_m + pair.b->radius_m;
  const double step = random().logUniform(1e-6, 0.3);
  const Quat turn = oracle::turned(random().direction(), step);
  Vec3 drift = step * size * random().direction();
  for (long i = 0; i < queries; ++i) {
    check(pair);
    const Vec3 between = pair.X_WB.position - pair.X_WA.position;
    switch (course) {
      case Course::kLattice: {
        Vec3 at;
        for (int k = 0; k < 3; ++k) at[k] = 0.125 * random().integer(-14, 14);
        pair.X_WA = {latticeTurn(random()), Vec3::Zero()};
        pair.X_WB = {latticeTurn(random()), 0.5 * size * at};
        if (random().integer(0, 1) == 0) pair.X_WB.position = at;
        break;
      }
      case Course::kJumps:
        pair.X_WA = random().pose(0.5);
        pair.X_WB = {random().rotation(),
                     pair.X_WA.position + random().uniform(0.0, 1.2) * size * random().direction()};
        break;
      case Course::kSlow:
        if (between.norm() > 1.2 * size) drift = -step * size * between.normalized();
        pair.X_WB.rotation = (turn * pair.X_WB.rotation).normalized();
        pair.X_WB.position += drift;
        break;
      default: {
        const int any = random().integer(0, static_cast<int>(Family::kCount) - 1);
        pair = pairs_.next(static_cast<Family>(any));
      }
    }
  }
}

bool isFinite(const ClosestFeatures& c) {
  return std::isfinite(c.distance_m) && c.p_A_W.allFinite() && c.p_B_W.allFinite() && c.n_W.allFinite();
}

void Stream::check(const PosedPair& pair) {
  forget(cold_);
  const ClosestFeatures want = ask(*pair.a, pair.X_WA, *pair.b, pair.X_WB, cold_);
  const ClosestFeatures got = ask(*pair.a, pair.X_WA, *pair.b, pair.X_WB, memory_);
  ++counts_.asked;
  counts_.penetrating += want.status == Separation::kPenetrating;
  // The rounding of the positions themselves is in the witnesses.
  const double size = pair.scale() + 1e-3 * (pair.X_WA.position.norm() + pair.X_WB.position.norm());
  const long wrong = counts_.wrong();
  if (!isFinite(got) || !isFinite(want)) {
    ++counts_.not_finite;
  } else {
    const double error = std::abs(got.distance_m - want.distance_m) / pair.scale();
    const Vec3 across = got.p_B_W - got.p_A_W - got.distance_m * got.n_W;
    counts_.largest = std::max(counts_.largest, error);
    const bool same_class = got.status == want.status;
    counts_.at_borders += !same_class && error <= kRounding;
    counts_.classes += !same_class && error > kRounding;
    counts_.distances += error > kSame;
    counts_.witnesses += across.norm() > kSame * size || std::abs(got.n_W.norm() - 1.0) > kSame;
  }
  if (counts_.wrong() > wrong && wrong < kTold) tell(pair, got, want);
}

void Stream::tell(const PosedPair& pair, const ClosestFeatures& got, const ClosestFeatures& want) const {
  const auto print = [](const char* name, const Pose& X) {
    std::fprintf(stderr, "  %s %.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", name, X.position.x(),
                 X.position.y(), X.position.z(), X.rotation.w(), X.rotation.x(), X.rotation.y(),
                 X.rotation.z());
  };
  std::fprintf(stderr, "query %ld, %d and %d vertices: class %d, distance %.17g; cold: class %d, %.17g\n",
               counts_.asked, pair.a->core.vertexCount(), pair.b->core.vertexCount(),
               static_cast<int>(got.status), got.distance_m, static_cast<int>(want.status), want.distance_m);
  print("A", pair.X_WA);
  print("B", pair.X_WB);
}

int run(const Options& options) {
  std::vector<Stream> streams;
  streams.reserve(static_cast<std::size_t>(options.threads));
  std::vector<std::thread> threads;
  for (long t = 0; t < options.threads; ++t) {
    const long share = options.queries / options.threads + (t < options.queries % options.threads ? 1 : 0);
    Stream& stream = streams.emplace_back(static_cast<std::uint64_t>(1000 * options.seed + t));
    threads.emplace_back([&stream, share] { stream.run(share); });
  }
  for (std::thread& thread : threads) thread.join();
  Counts all;
  for (const Stream& stream : streams) all.add(stream.counts());
  std::printf("%ld queries with one memory a thread, %ld penetrating: %ld differ from cold\n", all.asked,
              all.penetrating, all.wrong());
  std::printf(
      "%ld classes, %ld distances, %ld witnesses, %ld not finite; largest difference %.1e of the size; "
      "%ld at the border of two classes\n",
      all.classes, all.distances, all.witnesses, all.not_finite, all.largest, all.at_borders);
  return all.wrong() > 0 ? 1 : 0;
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
      std::fprintf(stderr, "usage: any_history [--queries N] [--seed S] [--threads T]\n");
      return 2;
    }
  }
  return carom::bench::run(options);
}
