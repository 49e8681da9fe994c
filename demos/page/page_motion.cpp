#include "demos/page/page_motion.h"

#include <algorithm>
#include <cmath>

namespace carom::demos {
namespace {

constexpr double kLengthError = 1e-4;   // Of the smallest moving body's radius.
constexpr double kContactError = 4e-3;  // Likewise.
constexpr double kSpeedQuantum = 1e-3;  // Radii a second.

double powerOfTwoBelow(double value) {
  return std::exp2(std::floor(std::log2(value)));
}

/// The step for which rounding three coordinates to the nearest moves a point by at most `error`.
double stepOfPoints(double error) {
  return powerOfTwoBelow(2.0 * error / std::sqrt(3.0));
}

std::int64_t steps(double value, double quantum) {
  return std::llround(std::clamp(value / quantum, -0x1p50, 0x1p50));
}

void writeRuns(ByteStream& out, const std::vector<std::int64_t>& values) {
  for (std::size_t begin = 0, end = 0; begin < values.size(); begin = end) {
    while (end < values.size() && values[end] == values[begin]) ++end;
    out.add(values[begin]);
    out.add(static_cast<std::int64_t>(end - begin));
  }
}

}  // namespace

PageQuanta pageQuanta(const World& world) {
  double radius = 1.0;
  for (const BodyDescription& body : world.bodies())
    if (!body.is_static)
      radius = std::min(radius, world.solids()[static_cast<std::size_t>(body.solid)].radius());
  PageQuanta quanta;
  quanta.length_m = stepOfPoints(kLengthError * radius);
  quanta.contact_m = stepOfPoints(kContactError * radius);
  quanta.speed_mps = powerOfTwoBelow(kSpeedQuantum * radius);
  return quanta;
}

PageMotion::PageMotion(const World& world, const PageQuanta& quanta)
    : world_(world), quanta_(quanta), tracks_(world.bodies().size()) {}

std::array<std::int64_t, PageMotion::kColumns> PageMotion::rounded(const BodyState& state,
                                                                   const Track& track) const {
  std::array<std::int64_t, kColumns> row{};
  const Quat& q = state.X_WB.rotation;
  Eigen::Vector4d wxyz(q.w(), q.x(), q.y(), q.z());
  // Of the two quaternions of a rotation the one that is nearer to the last: the columns stay smooth.
  double towards = wxyz[0];
  if (frames_ > 0) {
    towards = 0.0;
    for (std::size_t i = 0; i < 4; ++i)
      towards += wxyz[static_cast<Eigen::Index>(i)] * static_cast<double>(track.columns[3 + i].back());
  }
  if (towards < 0.0) wxyz = -wxyz;
  for (Eigen::Index i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    row[at] = steps(state.X_WB.position[i], quanta_.length_m);
    row[7 + at] = steps(state.linear_velocity[i], quanta_.speed_mps);
    row[10 + at] = steps(state.angular_velocity[i], quanta_.spin_radps);
  }
  for (std::size_t i = 0; i < 4; ++i)
    row[3 + i] = steps(wxyz[static_cast<Eigen::Index>(i)], quanta_.quaternion);
  return row;
}

void PageMotion::add(std::span<const BodyState> states) {
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    Track& track = tracks_[i];
    if (world_.bodies()[i].is_static && frames_ > 0) continue;
    const std::array<std::int64_t, kColumns> row = rounded(states[i], track);
    for (std::size_t c = 0; c < kColumns; ++c) {
      track.moves = track.moves || (frames_ > 0 && track.columns[c].back() != row[c]);
      track.columns[c].push_back(row[c]);
    }
    track.modes.push_back(static_cast<std::int64_t>(states[i].mode));
  }
  ++frames_;
}

void PageMotion::write(ByteStream& out) const {
  for (const Track& track : tracks_) {
    out.add(track.moves ? 1 : 0);
    for (std::size_t c = 0; c < (track.moves ? kColumns : 7); ++c)
      out.addColumn(std::span(track.columns[c]).first(track.moves ? track.columns[c].size() : 1));
  }
  for (std::size_t i = 0; i < tracks_.size(); ++i)
    if (!world_.bodies()[i].is_static) writeRuns(out, tracks_[i].modes);
}

}  // namespace carom::demos
