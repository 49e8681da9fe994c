#include "demos/record/trajectory_files.h"

#include <algorithm>

#include "engine/foundation/contract.h"

namespace carom::demos {
namespace {

constexpr Mode kLastMode = Mode::kKinematic;

/// Names come from JSON, which is UTF-8 throughout; a path converts them.
std::u32string characters(const std::string& utf8) {
  return std::filesystem::path(utf8).u32string();
}

std::vector<std::string> modeNames() {
  std::vector<std::string> names;
  for (int mode = 0; mode <= static_cast<int>(kLastMode); ++mode)
    names.emplace_back(modeName(static_cast<Mode>(mode)));
  return names;
}

std::size_t longest(std::span<const std::string> texts) {
  std::size_t length = 0;
  for (const std::string& text : texts) length = std::max(length, characters(text).size());
  return length;
}

void addVector(NpyFile& array, const Vec3& v) {
  for (const double x : v) array.add(x);
}

}  // namespace

TrajectoryFiles::Arrays::Arrays(const std::filesystem::path& folder, std::span<const std::string> body_names,
                                std::size_t frames)
    : times(folder / "times.npy", NpyType::kFloat64, {frames}),
      positions(folder / "positions.npy", NpyType::kFloat64, {frames, body_names.size(), 3}),
      rotations(folder / "rotations.npy", NpyType::kFloat64, {frames, body_names.size(), 4}),
      linear_velocities(folder / "linear_velocities.npy", NpyType::kFloat64, {frames, body_names.size(), 3}),
      angular_velocities(folder / "angular_velocities.npy", NpyType::kFloat64,
                         {frames, body_names.size(), 3}),
      modes(folder / "modes.npy", NpyType::kUint8, {frames, body_names.size()}),
      names(folder / "names.npy", NpyType::kText, {body_names.size()}, longest(body_names)),
      mode_names(folder / "mode_names.npy", NpyType::kText, {modeNames().size()}, longest(modeNames())) {
  for (const std::string& name : body_names) names.add(characters(name));
  for (const std::string& name : modeNames()) mode_names.add(characters(name));
}

void TrajectoryFiles::Arrays::add(double time_s, std::span<const BodyState> states) {
  times.add(time_s);
  for (const BodyState& s : states) {
    addVector(positions, s.X_WB.position);
    rotations.add(s.X_WB.rotation.w());
    addVector(rotations, s.X_WB.rotation.vec());
    addVector(linear_velocities, s.linear_velocity);
    addVector(angular_velocities, s.angular_velocity);
    modes.add(static_cast<std::uint8_t>(s.mode));
  }
}

void TrajectoryFiles::Arrays::commit() {
  for (NpyFile* array :
       {&times, &positions, &rotations, &linear_velocities, &angular_velocities, &modes, &names, &mode_names})
    array->commit();
}

TrajectoryFiles::TrajectoryFiles(const TrajectoryPaths& paths, std::span<const std::string> names, int frames)
    : names_(names), csv_(paths.csv, "frame,time_s,body,px,py,pz,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,mode") {
  if (!paths.npy.empty()) arrays_.emplace(paths.npy, names, static_cast<std::size_t>(frames));
}

void TrajectoryFiles::add(double time_s, std::span<const BodyState> states) {
  REQUIRE(states.size() == names_.size(), states.size(), names_.size());
  if (csv_) addRows(time_s, states);
  if (arrays_) arrays_->add(time_s, states);
  ++frames_;
}

void TrajectoryFiles::addRows(double time_s, std::span<const BodyState> states) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    const BodyState& s = states[i];
    const Vec3& p = s.X_WB.position;
    const Quat& q = s.X_WB.rotation;
    const Vec3& v = s.linear_velocity;
    const Vec3& w = s.angular_velocity;
    std::ostringstream row = exactRow();
    row << frames_ << ',' << time_s << ',' << quotedField(names_[i]) << ',' << p.x() << ',' << p.y() << ','
        << p.z() << ',' << q.w() << ',' << q.x() << ',' << q.y() << ',' << q.z() << ',' << v.x() << ','
        << v.y() << ',' << v.z() << ',' << w.x() << ',' << w.y() << ',' << w.z() << ',' << modeName(s.mode);
    csv_.row(row);
  }
}

void TrajectoryFiles::commit() {
  csv_.commit();
  if (arrays_) arrays_->commit();
}

}  // namespace carom::demos
