#pragma once
// A trajectory for other programs: a CSV file with a row a body and frame, and a folder of NumPy arrays. The
// arrays, of F frames and B bodies (SI units, world frame, double precision; rotations are w, x, y, z):
//   times.npy (F)  positions.npy (F, B, 3), of the centres of mass  rotations.npy (F, B, 4)
//   linear_velocities.npy, angular_velocities.npy (F, B, 3)  modes.npy (F, B), bytes
//   names.npy (B), text  mode_names.npy: what a mode's number means
// Tested in tests/demos/record/trajectory_files_test.cpp.

#include <optional>
#include <span>
#include <string>

#include "demos/record/csv_file.h"
#include "demos/record/npy_file.h"
#include "engine/simulation/world.h"

namespace carom::demos {

struct TrajectoryPaths {
  std::filesystem::path csv;  ///< "-": standard output. Empty: none, as the others.
  std::filesystem::path npy;  ///< A folder.
};

class TrajectoryFiles {
 public:
  /// Throws CannotWrite, as do the others; until `commit` there are no files of these names. `names` must
  /// outlive this.
  TrajectoryFiles(const TrajectoryPaths& paths, std::span<const std::string> names, int frames);

  explicit operator bool() const { return csv_ || arrays_; }
  /// Frames are added in order, from 0.
  void add(double time_s, std::span<const BodyState> states);
  void commit();

 private:
  struct Arrays {
    Arrays(const std::filesystem::path& folder, std::span<const std::string> names, std::size_t frames);
    void add(double time_s, std::span<const BodyState> states);
    void commit();

    NpyFile times, positions, rotations, linear_velocities, angular_velocities, modes, names, mode_names;
  };
  void addRows(double time_s, std::span<const BodyState> states);

  std::span<const std::string> names_;
  CsvFile csv_;
  std::optional<Arrays> arrays_;
  int frames_ = 0;
};

}  // namespace carom::demos
