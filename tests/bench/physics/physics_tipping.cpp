// physics: spinning, toppling, falling, rocking.

#include "tests/bench/physics/physics.h"
#include "tests/physics/experiments/falling_rod.h"
#include "tests/physics/experiments/gyroscope.h"
#include "tests/physics/experiments/standing/dominoes.h"
#include "tests/physics/experiments/standing/rocking_block.h"
#include "tests/physics/experiments/standing/toppling_block.h"

namespace carom::bench {
namespace {

using namespace physics;

constexpr double kSpin = 10.0;  // rad/s

Figure gyroscopeEnergy(const Simulator& s) {
  return within("%+.1e", spinGyroscope(s, kSpin, 60.0).energy, -1e-6, 1e-6);
}
Figure gyroscopeMomentum(const Simulator& s) {
  return within("%.1e", spinGyroscope(s, kSpin, 60.0).momentum, 0.0, 1e-12);
}
Figure gyroscopePeriod(const Simulator& s) {
  return errorWithin(spinGyroscope(s, kSpin, 60.0).flip_period, 1e-4);
}

Figure toppling(const Simulator& s) {
  return errorWithin(topplingError(s, {.heading = 0.5}), 1e-3);
}

Row rodRow(const char* name, double rate_hz, double thickness_m, const char* what) {
  const auto measure = [=](const Simulator& s) {
    const FallingRod rod{.rate_hz = rate_hz, .thickness_m = thickness_m, .heading = 0.4};
    return errorWithin(dropRod(s, rod).worst, 1e-3);
  };
  return {name, std::string(what) + ", falls on a smooth floor: worst error of w^2, 30 to 80 deg",
          "12g (cos a0 - cos a) / (L (1 + 3 sin^2 a))", "+-0.1 %", measure};
}

Row rockingRow(const char* name, double rate_hz, const char* rate) {
  const auto measure = [=](const Simulator& s) {
    const std::vector<double> ratios = rockingRatios(s, 1.0, rate_hz, 3, 0.3);
    const double expected = closedFormRockingRatio(0.25);
    std::vector<Figure> figures;
    for (double ratio : ratios) figures.push_back(within("%.4f", ratio, 0.995 * expected, 1.005 * expected));
    Figure all = allOf(figures);
    all.met = all.met && ratios.size() == 3;
    return figures.empty() ? Figure{"does not rock", false} : all;
  };
  return {name, std::string("1 x 4 block of 1 m rocks, ") + rate + ": energy kept at 3 landings",
          "(1 - 3/2 sin^2 a)^2 = 0.8313", "+-0.5 %", measure};
}

Figure dominoes(const Simulator& s) {
  return within("%.4f", dominoSpeed(s, 4.0, 60.0) / dominoSpeed(s, 1.0, 60.0), 1.9995, 2.0005);
}
Figure finerDominoes(const Simulator& s) {
  return within("%.4f", dominoSpeed(s, 4.0, 240.0) / dominoSpeed(s, 1.0, 240.0), 1.9995, 2.0005);
}

}  // namespace

std::vector<Row> tippingRows() {
  return {{"gyroscope-energy", "free box about its middle axis, 10 rad/s, 60 s: worst E/E0 - 1", "0", "1e-6",
           gyroscopeEnergy},
          {"gyroscope-momentum", "the same: worst |L - L0| / |L0|", "0", "1e-12", gyroscopeMomentum},
          {"gyroscope-period", "the same: error of the time between flips", "2 K(k) sqrt(I1 I2 I3 / ...)",
           "+-0.01 %", gyroscopePeriod},
          {"toppling", "0.3 x 0.9 m block: error of the steepest slope on which it stands", "tan = b/h",
           "+-0.1 %", toppling},
          rodRow("falling-rod", 60.0, 0.02, "rod of 1 x 0.02 m, 60 Hz"),
          rodRow("falling-rod-240", 240.0, 0.02, "rod of 1 x 0.02 m, 240 Hz"),
          rodRow("falling-bar", 60.0, 0.1, "bar of 1 x 0.1 m, 60 Hz"),
          rodRow("falling-bar-240", 240.0, 0.1, "bar of 1 x 0.1 m, 240 Hz"),
          rockingRow("rocking", 60.0, "60 Hz"),
          rockingRow("rocking-240", 240.0, "240 Hz"),
          {"dominoes", "speed of the wave, 4 times the size over once, 60 Hz", "2", "2.000", dominoes},
          {"dominoes-240", "the same, 240 Hz", "2", "2.000", finerDominoes}};
}

}  // namespace carom::bench
