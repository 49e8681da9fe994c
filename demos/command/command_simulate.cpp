// `carom simulate`: physics without pictures; trajectory and audit as files, the final state hash on stdout.
#include "demos/command/command.h"

#include <iostream>
#include <optional>
#include <sstream>

#include "demos/command/stepless_scene.h"
#include "demos/format/content_hash.h"
#include "demos/format/progress.h"
#include "demos/language/scene_values.h"
#include "demos/motion/frame_clock.h"
#include "demos/motion/frame_states.h"
#include "demos/motion/simulation_check.h"
#include "demos/record/csv_file.h"
#include "demos/record/recording.h"
#include "demos/record/trajectory_files.h"
#include "demos/scene/scene_world.h"
#include "demos/system/interrupt.h"

namespace carom::demos {
namespace {

void writeAudit(CsvFile& csv, int step, const Audit& audit) {
  const Vec3& p = audit.linear_momentum;
  const Vec3& l = audit.angular_momentum;
  const StepCounters& c = audit.last_step;
  std::ostringstream row = exactRow();
  row << step << ',' << audit.time_s << ',' << audit.kinetic_energy_J << ',' << audit.potential_energy_J
      << ',' << p.x() << ',' << p.y() << ',' << p.z() << ',' << l.x() << ',' << l.y() << ',' << l.z() << ','
      << audit.smallest_gap_m << ',' << audit.resting_bodies << ',' << c.candidate_pairs << ','
      << c.distance_queries << ',' << c.contact_points << ',' << c.events << ',' << c.impacts << ','
      << c.newton_steps << ',' << c.stopped_bodies << ',' << c.iteration_limits << ',' << c.substeps;
  csv.row(row);
}

RecordingHeader recordingHeader(const SimulateOptions& options, const Scene& scene, const SceneWorld& made) {
  const std::filesystem::path given(options.choice.scene);
  const bool is_shipped_name = !given.has_parent_path() && !given.has_extension();
  RecordingHeader header;
  header.scene = is_shipped_name ? given.string() : std::filesystem::absolute(scene.file).string();
  if (options.choice.mesh) header.mesh = std::filesystem::absolute(*options.choice.mesh).string();
  header.scene_hash = sceneHash(scene, options.choice.mesh);
  header.seed = scene.seed;
  header.rate_hz = scene.rate_hz;
  header.fps = options.fps;
  header.duration_s = scene.duration_s;
  header.bodies = static_cast<int>(made.names.size());
  header.frames = FrameClock({options.fps, scene.rate_hz}).frameCount(scene.duration_s);
  return header;
}

/// What there is to write of each frame.
struct FrameOutputs {
  TrajectoryFiles& trajectory;
  std::optional<RecordingWriter>& recording;
};

void writeFrames(FrameOutputs outputs, const SceneWorld& made, const FrameClock& clock, int frames,
                 FrameStates& states) {
  if (!outputs.trajectory && !outputs.recording) return;
  for (int frame = 0; frame < frames; ++frame) {
    const std::span<const BodyState> bodies = states.advanceTo(frame);
    if (outputs.trajectory) outputs.trajectory.add(clock.time(frame), bodies);
    if (outputs.recording) outputs.recording->add({bodies, made.world.stepCount(), made.world.stateHash()});
  }
}

void printFacts(const World& world, const RunFacts& facts, std::ostream& out) {
  const Audit audit = world.audit();
  out << hexText(world.stateHash()) << '\n'
      << "steps=" << world.stepCount() << " time_s=" << world.time() << " bodies=" << world.bodies().size()
      << " resting=" << audit.resting_bodies << " kinetic_J=" << audit.kinetic_energy_J
      << " potential_J=" << audit.potential_energy_J << " smallest_gap_m=" << facts.smallest_gap_m
      << " events=" << facts.events << " stopped_bodies=" << facts.stopped_bodies
      << " iteration_limits=" << facts.iteration_limits;
  if (facts.work_J != 0.0) out << " work_J=" << facts.work_J;
  if (facts.kinematic_late_s > 0.0) out << " kinematic_late_s=" << facts.kinematic_late_s;
  out << '\n';
}

/// What the counters of `printFacts` mean, for whoever reads along.
void explainFacts() {
  std::cerr
      << "resting: bodies at rest at the end; smallest_gap_m: between any two bodies in any step, never "
         "below 0\n"
         "events: times between steps at which impulses acted; stopped_bodies: held for the rest of a step "
         "when\n"
         "its events were used up; iteration_limits: closest-feature searches that reached their bound (0 is "
         "usual)\n";
}

}  // namespace

ExitCode simulate(const SimulateOptions& options) {
  const Scene scene = chosenScene(options.choice);
  SceneWorld made = makeSceneWorld(scene, options.choice.mesh, threadsOf(options.choice));
  const FrameClock clock({options.fps, scene.rate_hz});
  const int steps = clock.stepCount(scene.duration_s);
  const int frames = clock.frameCount(scene.duration_s);
  const bool has_frames =
      !options.output.empty() || !options.trajectory.csv.empty() || !options.trajectory.npy.empty();
  if (has_frames && frames < 1)
    throw UsageError("the duration of " + plainNumber(scene.duration_s) + " s holds no frame at " +
                     plainNumber(options.fps) + " fps to write");
  requireAStep(options.choice, scene);

  catchInterrupts();
  TrajectoryFiles trajectory(options.trajectory, made.names, frames);
  CsvFile audits(
      options.audit,
      "step,time_s,kinetic_J,potential_J,px,py,pz,lx,ly,lz,smallest_gap_m,resting_bodies,candidate_pairs,"
      "distance_queries,contact_points,events,impacts,newton_steps,stopped_bodies,iteration_limits,substeps");
  std::optional<RecordingWriter> recording;
  if (!options.output.empty()) recording.emplace(options.output, recordingHeader(options, scene, made));
  RunFacts facts;
  const ProgressStyle style = progressStyle(options.telling.progress, options.telling.quiet);
  {
    Progress progress({"step", steps}, style, std::cerr, steadySeconds);
    FrameStates states(made.world, clock, [&](const World& world) {
      throwIfInterrupted();
      const Audit audit = world.audit();
      checkStep(world, audit, made.names, facts);
      if (audits) writeAudit(audits, world.stepCount(), audit);
      progress.done(world.stepCount());
    });
    writeFrames({trajectory, recording}, made, clock, frames, states);
    states.stepTo(steps);
  }
  trajectory.commit();
  audits.commit();
  if (recording) recording->commit();
  const bool has_rows = options.trajectory.csv == kStandardOutput || options.audit == kStandardOutput;
  if (!has_rows || !options.telling.quiet) printFacts(made.world, facts, has_rows ? std::cerr : std::cout);
  if (style == ProgressStyle::kLines || style == ProgressStyle::kTerminal) explainFacts();
  const std::string hash = hexText(made.world.stateHash());
  if (options.expected_hash.empty() || options.expected_hash == hash) return ExitCode::kOk;
  std::cerr << "carom: state hash " << hash << " differs from the expected " << options.expected_hash << '\n';
  return ExitCode::kNo;
}

}  // namespace carom::demos
