// physics: sliding, sticking, rolling.

#include "tests/bench/physics/physics.h"
#include "tests/physics/experiments/groove_ball.h"
#include "tests/physics/experiments/leaving_ball.h"
#include "tests/physics/experiments/resisted_ball.h"
#include "tests/physics/experiments/rest_or_slip.h"
#include "tests/physics/experiments/rolling_ball.h"
#include "tests/physics/experiments/sliding_block.h"
#include "tests/physics/experiments/standing/balls_on_a_box.h"
#include "tests/physics/experiments/step_ball.h"

namespace carom::bench {
namespace {

using namespace physics;

// The error largest in size, with its sign; no number when one of them is none.
template <typename Measure>
double worstOver(const std::vector<double>& choices, const Measure& measure) {
  double worst = 0.0;
  for (double choice : choices) {
    const double error = measure(choice);
    if (!(std::abs(error) <= std::abs(worst))) worst = error;
    if (std::isnan(error)) return error;
  }
  return worst;
}

Row stoppingRow(const char* name, double friction) {
  const auto measure = [=](const Simulator& s) {
    const double worst = worstOver({0.0, 30.0, 45.0, 80.0}, [&](double heading_deg) {
      return stoppingError(s, {.friction = friction, .heading = radians(heading_deg), .velocity_mps = 5.0});
    });
    return errorWithin(worst, 1e-4);
  };
  return {name, "block at 5 m/s, headings 0, 30, 45, 80 deg: worst error of its way", "v^2 / 2 mu g",
          "+-0.01 %", measure};
}

Figure incline(const Simulator& s) {
  const double worst = worstOver({0.0, 0.7}, [&](double heading) {
    return inclineError(s, {.angle = radians(30.0), .friction = 0.3, .heading = heading});
  });
  return errorWithin(worst, 1e-6);
}

Figure stickSlip(const Simulator& s) {
  const auto worst = [&](bool resting) {
    return worstOver({0.0, 0.4, 0.785}, [&](double heading) {
      return stickSlipError(s, {.friction = 0.5, .heading = heading, .resting = resting});
    });
  };
  return allOf({errorWithin(worst(true), 1e-4), errorWithin(worst(false), 1e-4)});
}

Figure resting(const Simulator& s) {
  const Verdicts verdicts = restOrSlip(s, 60.0);
  return allOf({within("%.0f held", verdicts.held_wrongly, 0.0, 0.0),
                within("%.0f slid", verdicts.slid_wrongly, 0.0, 0.0)});
}

Figure creep(const Simulator& s) {
  const double worst = worstOver({0.0, 0.4}, [&](double heading) {
    const Slope slope{.angle = radians(20.0), .friction = 0.4, .heading = heading, .resting = false};
    return creepOf(s, slope, 60.0);
  });
  return within("%.1e m", worst, 0.0, 1e-9);
}

Figure rolling(const Simulator& s) {
  const double worst = worstOver({10.0, 30.0}, [&](double angle_deg) {
    return rollingError(s, {.angle = radians(angle_deg), .friction = 0.8, .heading = 0.7});
  });
  return errorWithin(worst, 1e-4);
}

Figure rollingThreshold(const Simulator& s) {
  return errorWithin(rollingThresholdError(s, {.angle = radians(30.0), .heading = 0.7}), 5e-3);
}

// Peers brake turning by other models, so that no figure of theirs would be fair.
const Figure kNotModelled{"-", false};

Figure rollingResistance(const Simulator& s) {
  if (!s.resists_turning) return kNotModelled;
  const auto worst = [&](const auto& error) {
    return worstOver({0.02, 0.25, 2.0}, [&](double radius) {
      return error(s, {.radius_m = radius,
                       .rolling = 0.05,
                       .heading = 0.7,
                       .velocity_mps = std::sqrt(kGravity * radius)});
    });
  };
  return allOf({errorWithin(worst(rollingLossError), 1e-6), errorWithin(worst(rollingWayError), 1e-3),
                errorWithin(standingThresholdError(s, {.rolling = 0.2, .heading = 0.7}), 1e-3)});
}

Figure spinningResistance(const Simulator& s) {
  if (!s.resists_turning) return kNotModelled;
  const ResistedBall ball{.spinning = 0.005, .heading = 0.7, .spin_radps = 20.0};
  return allOf({errorWithin(spinLossError(s, ball), 1e-6), errorWithin(spinTimeError(s, ball), 5e-3)});
}

Figure groove(const Simulator& s) {
  const double worst = worstOver({30.0, 60.0}, [&](double opening_deg) {
    return grooveError(s, {.angle = radians(20.0), .friction = 1.5, .heading = 0.7}, radians(opening_deg));
  });
  return errorWithin(worst, 1e-4);
}

Figure leaving(const Simulator& s) {
  return errorWithin(leavingError(s, 60.0, 0.8), 1e-3);
}

Figure step(const Simulator& s) {
  return allOf({errorWithin(stepError(s, {.heading = 0.6}), 1e-3),
                errorWithin(stepError(s, {.rate_hz = 240.0, .heading = 0.6}), 1e-3)});
}

Figure ballsOnBox(const Simulator& s) {
  return within("%.1e", rollingVelocityError(s, 1e-3, radians(45.0)), 0.0, 1e-12);
}

}  // namespace

std::vector<Row> frictionRows() {
  return {
      stoppingRow("stopping-0.2", 0.2),
      stoppingRow("stopping-0.5", 0.5),
      stoppingRow("stopping-0.8", 0.8),
      {"incline", "block on 30 deg, mu 0.3: error of its acceleration", "g (sin - mu cos)", "1e-6", incline},
      {"stick-slip", "block, mu 0.5, 3 headings, resting on / off: error of the steepest slope that holds it",
       "tan = mu", "+-0.01 %", stickSlip},
      {"rest-or-slip", "6 flat solids, 1 to 60 deg, mu 0 to 1.5, +-0.11 % of it: wrong verdicts", "tan = mu",
       "0 / 0", resting},
      {"creep", "block on 20 deg, mu 0.4, resting off: its way in 60 s", "0", "< 1e-9 m", creep},
      {"rolling", "ball on 10 and 30 deg, mu 0.8: error of its acceleration", "5/7 g sin", "+-0.01 %",
       rolling},
      {"rolling-threshold", "ball on 30 deg: error of the least mu with which it rolls", "2/7 tan", "+-0.5 %",
       rollingThreshold},
      {"groove",
       "ball in a groove between planes turned by 30 and 60 deg, on 20 deg: error of its acceleration",
       "g sin / (1 + 2/5 / cos^2)", "+-0.01 %", groove},
      {"step", "ball rolls against a step of r / 5, 60 / 240 Hz: error of the least speed that takes it up",
       "sqrt(10/7 g h) / (1 - 5/7 h / r)", "+-0.1 %", step},
      {"leaving", "smooth ball slides off a fixed one, 60 Hz: error of the cosine where it leaves",
       "cos = 2/3", "+-0.1 %", leaving},
      {"rolling-resistance",
       "ball, c / r 0.05 (0.2 on the slope), 3 sizes: errors of deceleration / way / steepest slope",
       "5/7 g c / r, v^2 / 2a, tan = c / r", "1e-6 / +-0.1 % / +-0.1 %", rollingResistance},
      {"spinning-resistance", "ball on the spot, s / r 0.005: errors of deceleration / time to its stop",
       "5/2 g s / r^2", "1e-6 / +-0.5 %", spinningResistance},
      {"rolling-on-a-box", "25 balls on a sliding box, 1 kHz: mean squared error of velocity, (m/s)^2",
       "box mu g (M+m)/(M+2m/7), balls 2/7 of it", "1e-12", ballsOnBox}};
}

}  // namespace carom::bench
