// physics: what stands, and what falls.

#include "tests/bench/physics/physics.h"
#include "tests/physics/experiments/standing/arch.h"
#include "tests/physics/experiments/standing/four_balls.h"
#include "tests/physics/experiments/standing/heavy_on_light.h"
#include "tests/physics/experiments/standing/ladder.h"
#include "tests/physics/experiments/standing/overhang.h"
#include "tests/physics/experiments/standing/standing_boxes.h"

namespace carom::bench {
namespace {

using namespace physics;

// To 0.5 %; a stack that falls at 0.1 of the limit counts as none.
Figure overhang(const Simulator& s) {
  const double share = thresholdOf(0.0, 1.28, 8, [&](double x) { return overhangStands(s, x, 60.0); });
  return {share > 0.0 ? within("%.3f", share, 0, 2).text : "< 0.005",
          overhangStands(s, 0.99, 60.0) && !overhangStands(s, 1.01, 60.0)};
}

Row archRow(const char* name, double rate_hz, const char* rate) {
  const auto measure = [=](const Simulator& s) {
    const bool thick = archStands(s, 0.12, rate_hz), thin = archStands(s, 0.09, rate_hz);
    return Figure{std::string(thick ? "stands" : "falls") + " / " + (thin ? "stands" : "falls"),
                  thick && !thin};
  };
  return {name, std::string("arch of 21 stones, ") + rate + ": at t/R = 0.12 / 0.09",
          "stands from t/R = 0.1075", "stands / falls", measure};
}

Figure heavyOnLight(const Simulator& s) {
  const HeavyLoad load = loadHeavyOnLight(s, 1000.0, 60.0);
  return {
      std::string(load.stands ? "stands" : "falls") + within(", %.1f mm deep", 1e3 * load.sunk_m, 0, 0).text,
      load.stands && load.sunk_m <= 0.0};
}

Figure ladder(const Simulator& s) {
  return allOf({errorWithin(ladderError(s, {.angle = radians(60.0)}), 1e-3),
                errorWithin(ladderError(s, {.rate_hz = 240.0, .angle = radians(60.0)}), 1e-3)});
}

Figure fourBalls(const Simulator& s) {
  const double least = leastFrictionOfBalls();
  return allOf({errorWithin(fourBallsError(s, {}, &FourBalls::between, least), 1e-3),
                errorWithin(fourBallsError(s, {}, &FourBalls::below, least / 4.0), 1e-3)});
}

Figure restingStack(const Simulator& s) {
  const Standing standing = standFor(Trial(s, boxStack(10, 60.0, true)), 60.0);
  return allOf({lengthWithin(standing.drift_m, 1e-4),
                within(standing.rest_s < 59.9 ? "rest %.2f s" : "no rest", standing.rest_s, 0.0, 1.0)});
}

Figure driftAndSag(const Standing& standing) {
  return allOf({lengthWithin(standing.drift_m, 1e-3), lengthWithin(standing.sag_m, 1e-2)});
}
Figure stack(const Simulator& s) {
  return driftAndSag(standFor(Trial(s, boxStack(10, 60.0, false)), 60.0));
}
Figure turnedStack(const Simulator& s) {
  return driftAndSag(standFor(Trial(s, boxStack(10, 60.0, false, 0.5, 0.05)), 60.0));
}
Figure pyramid(const Simulator& s) {
  return driftAndSag(standFor(Trial(s, boxPyramid(20, 60.0, false)), 60.0));
}
Figure wall(const Simulator& s) {
  return driftAndSag(standFor(Trial(s, brickWall(20, 31, 60.0, false)), 60.0));
}

// Peers are not asked: an hour of theirs, awake, takes longer than the rest of the table.
Row hourRow(const char* name, const char* what, const Experiment& e) {
  const auto measure = [=](const Simulator& s) {
    if (!s.keeps_gaps) return Figure{"-", false};
    const Rest rest = restFor(Trial(s, e), 3600.0);
    Figure figure = allOf({within("rest %.2f s", rest.rest_s, 0.0, 1.0), lengthWithin(rest.moved_m, 0.0)});
    figure.met = figure.met && rest.unturned;
    return figure;
  };
  return {name,    std::string(what) + ", 60 Hz, an hour: rest / moved from then on",
          "0",     "1 s / no bit",
          measure, true};
}

}  // namespace

std::vector<Row> pileRows() {
  return {
      {"overhang", "8 blocks: greatest share of the harmonic overhang that stands", "1",
       "0.99 stands, 1.01 not", overhang},
      archRow("arch", 60.0, "60 Hz"),
      archRow("arch-240", 240.0, "240 Hz"),
      {"heavy-on-light", "1000 kg on 1 kg, 10 s", "stands, 0 deep", "stands, 0 mm", heavyOnLight},
      {"ladder", "ladder at 60 deg on a smooth wall, 60 / 240 Hz: error of the least mu of its foot",
       "cot / 2", "+-0.1 %", ladder},
      {"four-balls", "one ball on three, 60 Hz: errors of the least mu between them / below them",
       "sqrt 3 - sqrt 2, a quarter of it", "+-0.1 %", fourBalls},
      {"stack-resting", "stack of 10 cubes of 0.5 m, 60 s: drift / rest", "0", "< 0.1 mm, 1 s", restingStack},
      {"stack", "the same, resting off: drift / sag", "0", "< 1 mm / <= 10 mm", stack},
      {"stack-turned", "the same, each cube turned by 0.05 on the one below: drift / sag", "0",
       "< 1 mm / <= 10 mm", turnedStack},
      {"pyramid", "pyramid of 210, resting off, 60 s: drift / sag", "0", "< 1 mm / <= 10 mm", pyramid, true},
      {"wall", "wall of 610, resting off, 60 s: drift / sag", "0", "< 1 mm / <= 10 mm", wall, true},
      hourRow("stack-hour", "stack of 10 cubes", boxStack(10, 60.0, true)),
      hourRow("pyramid-hour", "pyramid of 210", boxPyramid(20, 60.0, true)),
      hourRow("wall-hour", "wall of 610", brickWall(20, 31, 60.0, true))};
}

}  // namespace carom::bench
