// How figures of the table are written and compared with their goals.

#include <array>
#include <cmath>
#include <cstdio>

#include "tests/bench/physics/physics.h"

namespace carom::bench {

Figure within(const char* format, double value, double low, double high) {
  if (std::isnan(value)) return {"none", false};
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return {text.data(), value >= low && value <= high};
}

Figure errorWithin(double error, double allowed) {
  return within(std::abs(error) < 1e-4 ? "%+.2g %%" : "%+.3g %%", 100.0 * error, -100.0 * allowed,
                100.0 * allowed);
}

Figure lengthWithin(double length_m, double most_m) {
  Figure figure =
      within(length_m < 1.0 ? "%.2g mm" : "%.1f m", length_m * (length_m < 1.0 ? 1e3 : 1.0), 0.0, 0.0);
  figure.met = length_m <= most_m;
  return figure;
}

Figure allOf(const std::vector<Figure>& figures) {
  Figure all{"", true};
  for (const Figure& figure : figures) {
    all.text += (all.text.empty() ? "" : " / ") + figure.text;
    all.met = all.met && figure.met;
  }
  return all;
}

}  // namespace carom::bench
