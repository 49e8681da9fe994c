// physics: bounces, oblique blows, cradles, momentum.

#include <cstdio>

#include "tests/bench/physics/physics.h"
#include "tests/physics/experiments/bouncing_ball.h"
#include "tests/physics/experiments/closed_system.h"
#include "tests/physics/experiments/elastic_bounce.h"
#include "tests/physics/experiments/newtons_cradle.h"
#include "tests/physics/experiments/oblique_impact.h"
#include "tests/physics/experiments/painleve_rod.h"

namespace carom::bench {
namespace {

using namespace physics;

Row elasticRow(const char* name, const char* what, const Shape& shape, const Quat& attitude) {
  const auto measure = [=](const Simulator& s) {
    return within("%+.1e", bounceElastically(s, shape, attitude, 60.0, 60.0).worst(), -1e-9, 1e-9);
  };
  return {name, std::string(what) + ", e = 1, no friction, 60 s: worst E/E0 - 1", "0", "1e-9", measure};
}

Figure bounce(const Simulator& s) {
  const double expected = closedFormBounceStop(1.0, 0.5);
  const auto at = [&](double rate) {
    return within("%.4f", bounceStop(s, 1.0, 0.5, 0.25, rate), 0.99 * expected, 1.01 * expected);
  };
  return allOf({at(60.0), at(240.0)});
}

Figure obliqueError(const Simulator& s, double friction, double tangential_mps) {
  double worst = 0.0;
  for (double heading : {0.0, 0.5, 0.785}) {
    const ObliqueImpact impact{.friction = friction, .tangential_mps = tangential_mps, .heading = heading};
    const double error = reboundOf(s, impact).loss_mps / impact.closedFormLoss() - 1.0;
    if (!(std::abs(error) <= std::abs(worst))) worst = error;
  }
  return errorWithin(worst, 1e-3);
}

Row cradleRow(const char* name, const char* what, double gap_m) {
  const auto measure = [=](const Simulator& s) {
    const std::array<double, 5> v =
        cradleSpeeds(s, gap_m > 0.0 || !s.keeps_gaps ? gap_m : restGap(0.2), 60.0);
    std::string text;
    for (double speed : v) text += within(text.empty() ? "%.2f" : " %.2f", speed, 0.0, 0.0).text;
    const double error = cradleError(v);
    return error < 1e-3 ? within("0 0 0 0 1 to %.0e", error, 0.0, 1e-9) : Figure{text, false};
  };
  return {name, std::string("Newton's cradle, e = 1, ") + what + ": speeds", "0 0 0 0 1", "1e-9", measure};
}

Figure painleve(const Simulator& s) {
  const auto at = [&](double rate_hz) {
    const PainleveOutcome outcome = slidePainleveRod(s, {.rate_hz = rate_hz});
    Figure figure = within("%+.1e", outcome.energy_gain, -1.0, 1e-9);
    figure.met = figure.met && outcome.fastest <= 1.0;
    return figure;
  };
  return allOf({at(60.0), at(240.0)});
}

Figure momentum(const Simulator& s) {
  return within("%.0e", collideInFreeSpace(s, 60.0, 5.0).linear, 0.0, 1e-12);
}
Figure angularMomentum(const Simulator& s) {
  return within("%.0e", collideInFreeSpace(s, 60.0, 5.0).angular, 0.0, 1e-12);
}

}  // namespace

std::vector<Row> impactRows() {
  const Shape cube = Shape::box(Vec3::Constant(0.5));
  return {elasticRow("elastic-ball", "ball dropped from 1 m", Shape::ball(0.25), Quat::Identity()),
          elasticRow("elastic-flat-box", "box dropped flat", cube, Quat::Identity()),
          elasticRow("elastic-tilted-box", "box dropped tilted", cube, rotatedBy({1.0, 0.4, 0.2}, 0.6)),
          {"bounce", "ball from 1 m, e = 0.5, 60 / 240 Hz: stops after, s", "sqrt(2h/g)(1+e)/(1-e) = 1.3546",
           "+-1 %", bounce},
          {"oblique-sliding", "ball strikes a floor, mu 0.2, e 0.5, 3 headings: error of the speed it loses",
           "mu (1+e) v_n", "+-0.1 %", [](const Simulator& s) { return obliqueError(s, 0.2, 5.0); }},
          {"oblique-sticking", "the same, mu 0.8", "2/7 v_t", "+-0.1 %",
           [](const Simulator& s) { return obliqueError(s, 0.8, 2.0); }},
          cradleRow("cradle-touching", "touching", 0.0),
          cradleRow("cradle-separated", "2 cm apart", 0.02),
          {"painleve", "rod slides tip first, mu 2, tan 2, 60 / 240 Hz: largest E/E0 - 1", "<= 0, finite",
           "<= 1e-9", painleve},
          {"momentum", "12 bodies meet in free space: worst change of momentum", "0", "1e-12", momentum},
          {"angular-momentum", "the same: of angular momentum", "0", "1e-12", angularMomentum}};
}

}  // namespace carom::bench
