#include "demos/cli/command_line.h"

#include <iostream>
#include <sstream>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "demos/against/against_result.h"
#include "demos/cli/manual_page.h"
#include "demos/cli/shell_completion.h"
#include "demos/command/command.h"
#include "demos/format/nearest_name.h"
#include "demos/overlay/overlay_choice.h"
#include "demos/system/build_info.h"
#include "demos/video/moving_picture.h"

namespace carom::demos {
namespace {

constexpr int kMostWorkers = 64;
constexpr int kMostThreads = 64;
constexpr double kLongest_s = 3600.0;
constexpr double kHighestFps = 1000.0;
constexpr double kHighestPictureFps = 30.0;
constexpr double kLowestSpeed = 0.001, kHighestSpeed = 1000.0;
constexpr double kLongestBudget_ms = 1e6;
constexpr int kSmallestSide = 16;
constexpr int kLargestSide = 8192;

std::string quotedCommandLine(int argc, char** argv) {
  std::string text = "carom";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool plain = !word.empty() && word.find_first_of(" \t\"'\\$&|;<>()*?#") == std::string::npos;
    text += plain ? " " + word : " '" + word + "'";
  }
  return text;
}

template <typename Options>
void readSize(const std::string& text, Options& options) {
  int width = 0, height = 0;
  char cross = 0, rest = 0;
  std::istringstream in(text);
  const bool parsed = static_cast<bool>(in >> width >> cross >> height) && cross == 'x' && !(in >> rest);
  const auto fits = [](int side) { return side >= kSmallestSide && side <= kLargestSide; };
  if (!parsed || !fits(width) || !fits(height))
    throw UsageError("--size " + text + ": accepted: WIDTHxHEIGHT such as 1280x720, each " +
                     std::to_string(kSmallestSide) + " to " + std::to_string(kLargestSide));
  options.width = width;
  options.height = height;
}

/// Finite and within (0, most]: comparisons with NaN are false.
void requireWithin(const char* option, double value, double most) {
  if (value > 0.0 && value <= most) return;
  std::ostringstream message;
  message << option << ' ' << value << ": accepted: above 0, at most " << most;
  throw UsageError(message.str());
}

/// "10%" or "10".
double readPercentage(const char* option, const std::string& text) {
  std::istringstream in(text);
  double percent = 0.0;
  std::string rest;
  const bool number = static_cast<bool>(in >> percent);
  in >> rest;
  if (number && (rest.empty() || rest == "%") && percent >= 0.0 && percent <= 1000.0) return percent;
  throw UsageError(std::string(option) + " " + text + ": accepted: 0% to 1000%, such as 10%");
}

void requireHash(const std::string& text) {
  if (text.size() == 16 && text.find_first_not_of("0123456789abcdef") == std::string::npos) return;
  throw UsageError("--expect-hash " + text + ": accepted: the 16 hexadecimal digits that simulate prints");
}

void addMeshOptions(CLI::App& command, SceneChoice& choice) {
  command.add_option("--mesh", choice.mesh, "A mesh file in place of the scene's replaceable ones");
  command.add_flag("--hull", choice.as_hull,
                   "Its convex hull, or that of each of its meshes, in place of the mesh");
}

void addSettings(CLI::App& command, SceneChoice& choice) {
  command
      .add_option("--set", choice.settings,
                  "PATH=VALUE put into the scene, such as bodies.crate.position=[0,0,3] or set.n=5")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void addSceneOptions(CLI::App& command, SceneChoice& choice) {
  command.add_option("SCENE", choice.scene, "A shipped scene's name (see list) or a path to a .json file")
      ->required();
  command.add_option("--duration", choice.duration_s, "Seconds instead of the scene's own");
  command.add_option("--seed", choice.seed, "Seed of the scene's jitter");
  addMeshOptions(command, choice);
  addSettings(command, choice);
}

void addThreadsOption(CLI::App& command, SceneChoice& choice) {
  command
      .add_option(
          "--threads", choice.threads,
          "That step large islands together (0: one for each processor); states are the same for any number")
      ->check(CLI::Range(0, kMostThreads))
      ->capture_default_str();
}

void addTellingOptions(CLI::App& command, Telling& telling) {
  command
      .add_option("--progress", telling.progress,
                  "json, none, or auto: redrawn on a terminal, else a line a second")
      ->check(CLI::IsMember({"json", "none", "auto"}));
  command.add_flag("-q,--quiet", telling.quiet, "Nothing on stderr but errors");
}

void addGlOption(CLI::App& command, std::string& gl) {
  command
      .add_option(
          "--gl", gl,
          "Who makes the GL context: osmesa, egl without a surface, or auto: osmesa where it is, else egl")
      ->check(CLI::IsMember(renderer::backendNames()))
      ->capture_default_str();
}

void addLightOption(CLI::App& command, std::string& light) {
  command.add_option("--light", light, "In place of the scene's own light")
      ->check(CLI::IsMember(renderer::lightNames()));
}

void addPresetOption(CLI::App& command, std::string& preset) {
  command.add_option("--preset", preset, "How much a frame may cost")
      ->check(CLI::IsMember(renderer::presetNames()))
      ->capture_default_str();
}

void addTrajectoryOptions(CLI::App& command, TrajectoryPaths& paths) {
  command.add_option("--csv", paths.csv, "One row a body and frame: poses, velocities, modes");
  command.add_option("--npy", paths.npy, "A folder of NumPy arrays: times, poses, velocities, modes, names");
}

/// Everything that can be asked for, with the places its values go.
struct CommandLine {
  CLI::App app{"Carom: impulse-based rigid bodies on V-Clip, drawn off screen to PNG frames.", "carom"};
  ListOptions list_options;
  RenderOptions render_options;
  SimulateOptions simulate_options;
  ExportOptions export_options;
  CheckOptions check_options;
  DistanceOptions distance_options;
  CompareOptions compare_options;
  RegressOptions regress_options;
  BudgetOptions budget_options;
  FiguresOptions figures_options;
  GalleryOptions gallery_options;
  DoctorOptions doctor_options;
  NewOptions new_options;
  bool wants_manual = false;
  bool wants_completion = false;
  bool wants_zsh = false;
  bool wants_fish = false;
  std::string help_of;
  std::string size;
  std::string caption;
  std::string budget_size;
  std::string figures_size;
  std::string gallery_size;
  std::string budget_tolerance;
  std::string budget_work_tolerance;
  CLI::App* list_command = nullptr;
  CLI::App* render_command = nullptr;
  CLI::App* simulate_command = nullptr;
  CLI::App* export_command = nullptr;
  CLI::App* check_command = nullptr;
  CLI::App* distance_command = nullptr;
  CLI::App* compare_command = nullptr;
  CLI::App* regress_command = nullptr;
  CLI::App* budget_command = nullptr;
  CLI::App* figures_command = nullptr;
  CLI::App* gallery_command = nullptr;
  CLI::App* doctor_command = nullptr;
  CLI::App* new_command = nullptr;
  CLI::App* help_command = nullptr;
  CLI::App* version_command = nullptr;

  CommandLine();
  void addRender();
  void addLongJobOptions();
  void addLookOptions();
  void addOverlayOptions();
  void addSimulate();
  void addExport();
  void addDistance();
  void addCompare();
  void addRegress();
  void addBudget();
  void addFigures();
  void addGallery();
  void groupOptions();
};

/// Each option of these names, of whatever command, stands under a heading of the help.
void CommandLine::groupOptions() {
  struct Group {
    const char* heading;
    std::vector<std::string> options;
  };
  const std::vector<Group> groups{
      {"What is simulated",
       {"--duration", "--seed", "--set", "--mesh", "--hull", "--threads", "--from", "--scene"}},
      {"What is written",
       {"--output",      "--sheet",   "--ffmpeg", "--stream", "--aov",    "--states", "--csv",
        "--npy",         "--audit",   "--json",   "--trace",  "--plot",   "--report", "--report-pairs",
        "--differences", "--amplify", "--junit",  "--update", "--accept", "--undo"}},
      {"Which moments", {"--fps", "--speed", "--at", "--frames"}},
      {"How it looks",
       {"--size", "--camera", "--preset", "--style", "--light", "--exposure", "--shutter", "--background",
        "--overlay", "--focus", "--caption", "--portable"}},
      {"Long jobs", {"--shard", "--resume", "--workers", "--jobs", "--part", "--gl"}},
      {"What is asked",
       {"--budget", "--percentile", "--replays", "--baseline", "--against", "--paced", "--clock",
        "--tolerance", "--work-tolerance", "--tolerance16", "--allow-pixels", "--mask", "--expect-hash",
        "--pose-a", "--pose-b", "--batch", "--cold"}},
      {"What is told", {"--progress", "--quiet", "--verbose"}}};
  for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    for (const Group& group : groups)
      for (const std::string& name : group.options)
        if (CLI::Option* option = command->get_option_no_throw(name)) option->group(group.heading);
}

CommandLine::CommandLine() {
  app.set_version_flag("-V,--version", "carom " + programVersion() + " (" + buildName() + ")");
  app.footer(
      "Example: carom render sliding -o out/frame_%04d.png\n"
      "Exit codes: 0 ok, 1 the answer is no, 2 usage, 3 bad scene or asset,\n"
      "            4 cannot write, or no more memory, threads or processes,\n"
      "            5 simulation invalid, 6 no renderer, 7 budget inconclusive,\n"
      "            128+n signal n");
  app.add_flag("--manual-page", wants_manual, "Prints carom(1), as it is installed");
  app.add_flag("--bash-completion", wants_completion, "Prints the completion for bash, as it is installed");
  app.add_flag("--zsh-completion", wants_zsh, "The same for zsh");
  app.add_flag("--fish-completion", wants_fish, "The same for fish");
  list_command = app.add_subcommand("list", "The shipped scenes, one line each");
  list_command->add_flag("--json", list_options.json, "As a JSON array");
  list_command->footer("Example: carom list --json");
  addRender();
  addSimulate();
  addExport();
  check_command = app.add_subcommand("check", "Validates a scene or a mesh file without rendering");
  check_command
      ->add_option("SCENE|MESH", check_options.choice.scene, "A scene (name or .json) or a mesh file")
      ->required();
  addMeshOptions(*check_command, check_options.choice);
  addSettings(*check_command, check_options.choice);
  check_command->footer("Example: carom check assets/meshes/gem.obj");
  addDistance();
  addCompare();
  addRegress();
  addBudget();
  addFigures();
  addGallery();
  doctor_command = app.add_subcommand("doctor", "What this machine offers, and what is missing");
  addGlOption(*doctor_command, doctor_options.gl);
  doctor_command->footer("Example: carom doctor --gl egl");
  new_command = app.add_subcommand(
      "new", "Writes a scene with comments to begin with; never over a file that is there");
  new_command->add_option("FILE", new_options.output, "A name that ends in .json")->required();
  new_command->footer("Example: carom new my_scene.json");
  help_command = app.add_subcommand("help", "What a command does and takes; the same as COMMAND --help");
  help_command->add_option("COMMAND", help_of, "One of the commands; none: all of them");
  help_command->footer("Example: carom help render");
  version_command = app.add_subcommand("version", "The version and the build; the same as --version");
  version_command->footer("Example: carom version");
  groupOptions();
  for (CLI::App* command : app.get_subcommands({})) command->allow_extras();
  app.allow_extras();
  app.require_subcommand(0, 1);
}

void CommandLine::addRender() {
  render_command = app.add_subcommand("render", "Simulates a scene and writes PNG frames");
  addSceneOptions(*render_command, render_options.choice);
  render_command->add_option(
      "-o,--output", render_options.output,
      "Frame files, with %04d or #### (frames/SCENE/frame_%04d.png); one picture (x.png: of the start,\n"
      "or of --at); a moving picture (x.apng; by the installed ffmpeg x.gif, x.webp, x.mp4 and more);\n"
      "or - and --stream");
  addLongJobOptions();
  render_command->add_option("--fps", render_options.fps, "Frames a second; frame k shows exactly k / fps")
      ->capture_default_str();
  render_command->get_option("--from")->excludes(render_command->get_option("--fps"));
  render_command->add_option("--size", size, "WIDTHxHEIGHT in pixels (1280x720)");
  render_command->add_option(
      "--camera", render_options.camera,
      "One of the scene's cameras (main, or its first), auto, fit, orbit or follow:BODY");
  addLookOptions();
  addOverlayOptions();
  render_command->add_flag("--portable", render_options.portable,
                           "The same pixels on every CPU, a third slower: golden frames");
  render_command->add_flag("--states", render_options.states,
                           "A record beside the frames (states.carom), by which compare names what changed;\n"
                           "with --portable always");
  addGlOption(*render_command, render_options.gl);
  render_command
      ->add_option("--workers", render_options.workers,
                   "Processes that draw (0: one for each processor); frames are the same for any number")
      ->check(CLI::Range(0, kMostWorkers))
      ->capture_default_str();
  addThreadsOption(*render_command, render_options.choice);
  addTellingOptions(*render_command, render_options.telling);
  render_command->add_flag("-v,--verbose", render_options.telling.verbose,
                           "Tell about scene and renderer first");
  render_command->footer(
      "Example: carom render drop-mesh --mesh part.stl --size 1920x1080 -o out/part_####.png");
}

void CommandLine::addLookOptions() {
  RenderOptions& options = render_options;
  CLI::App& render = *render_command;
  addPresetOption(render, options.preset);
  render.add_option("--style", options.style, "print: white background and ground, for paper")
      ->check(CLI::IsMember(renderer::styleNames()))
      ->capture_default_str();
  addLightOption(render, options.light);
  render.add_option("--exposure", options.exposure, "Factor of all light on its way to the picture")
      ->check(CLI::Range(0.01, 100.0));
  render
      .add_option(
          "--shutter", options.shutter_degrees,
          "Degrees of a turn a frame that the shutter is open (180: half of a frame), for the presets of\n"
          "several exposures: what moves is blurred along its exact path")
      ->check(CLI::Range(0.0, 360.0));
  render
      .add_option("--background", options.background,
                  "none: bodies and the shadows on the ground alone, with alpha, to lay over something else")
      ->check(CLI::IsMember({"scene", "none"}))
      ->capture_default_str();
  render.add_option(
      "--aov", options.aov,
      "depth, normal, id: 16-bit PNG files beside each frame (frame_0001.depth.png); with --stream "
      "one of them, in the frame's place");
  render.add_option("--speed", options.speed, "Of the scene's time: 0.1 is ten times slow motion")
      ->capture_default_str();
  CLI::Option* at = render.add_option("--at", options.at_s, "One picture, at exactly this many seconds");
  for (const char* other :
       {"--frames", "--shard", "--from", "--ffmpeg", "--sheet", "--fps", "--speed", "--duration"})
    at->excludes(render.get_option(other));
}

void CommandLine::addLongJobOptions() {
  RenderOptions& options = render_options;
  CLI::App& render = *render_command;
  render.get_option("SCENE")->required(false);  // a recording knows its scene
  render.add_option("--frames", options.frames, "Only these, such as 0-99,150,200-300x5");
  render.add_option("--shard", options.shard, "i/n: the i-th of n parts of the frames, i from 1");
  CLI::Option* resume = render.add_flag("--resume", options.resume,
                                        "Keeps frames that are whole and up to date, draws the others");
  CLI::Option* stream = render.add_option("--stream", options.stream,
                                          "With -o -: frames to standard output as ppm, png or rgb24");
  CLI::Option* ffmpeg =
      render.add_option("--ffmpeg", options.moving, "A video by the installed ffmpeg, as -o x.mp4 is");
  CLI::Option* sheet = render.add_option(
      "--sheet", options.sheet,
      "COLUMNSxROWS: moments of the run in one picture, with their times; --size is of each");
  for (CLI::Option* other :
       {stream, ffmpeg, resume, render.get_option("--frames"), render.get_option("--shard")})
    sheet->excludes(other);
  CLI::Option* from = render.add_option("--from", options.from, "Draws a recording of simulate -o");
  ffmpeg->excludes(render.get_option("--output"))->excludes(stream);
  resume->excludes(stream)->excludes(ffmpeg);
  from->excludes(render.get_option("--seed"))->excludes(render.get_option("--duration"));
}

void CommandLine::addOverlayOptions() {
  std::string names;
  for (const OverlayDescription& d : overlayDescriptions())
    names.append(names.empty() ? "" : ", ").append(d.name);
  render_command->add_option(
      "--overlay", render_options.overlays,
      "Drawn over each frame, comma separated (--overlay help says what each is):\n" + names);
  render_command->add_option("--focus", render_options.focus,
                             "Overlays speak of these bodies only; of one, all its pairs");
  render_command
      ->add_option("--caption", caption,
                   "on, off: the scene's line of text over each frame (on; with --portable off, for it "
                   "depends on fonts)")
      ->check(CLI::IsMember({"on", "off"}));
}

void CommandLine::addSimulate() {
  simulate_command =
      app.add_subcommand("simulate", "Simulates a scene; prints the final state hash and a line of facts");
  addSceneOptions(*simulate_command, simulate_options.choice);
  addTrajectoryOptions(*simulate_command, simulate_options.trajectory);
  simulate_command->add_option("-o,--output", simulate_options.output,
                               "Recording of poses and velocities, for render --from");
  simulate_command->add_option("--fps", simulate_options.fps, "Frames a second of --csv, --npy and -o")
      ->capture_default_str();
  simulate_command->add_option("--audit", simulate_options.audit,
                               "One row a step: energy, momentum, gap, counters");
  simulate_command->add_option("--expect-hash", simulate_options.expected_hash,
                               "Exit 1 when the final state hash differs");
  addThreadsOption(*simulate_command, simulate_options.choice);
  addTellingOptions(*simulate_command, simulate_options.telling);
  simulate_command->footer("Example: carom simulate resting --csv run.csv --audit steps.csv");
}

void CommandLine::addExport() {
  ExportOptions& options = export_options;
  export_command = app.add_subcommand(
      "export", "Writes a scene's motion as animated glTF, CSV, NumPy arrays, or a page that plays it");
  addSceneOptions(*export_command, options.choice);
  CLI::Option* scene = export_command->get_option("SCENE");
  scene->description("A shipped scene's name, a path to a .json file, or a recording of simulate -o");
  export_command->add_option(
      "OUT", options.output,
      "A .glb file: glTF 2.0 with one node a body and camera; or an .html file: a page that\n"
      "plays the run in any browser, with the engine's overlays");
  addTrajectoryOptions(*export_command, options.trajectory);
  export_command->add_option("--fps", options.fps,
                             "Frames a second (30; of a page 60; a recording has its own)");
  export_command->add_option("--scene", options.moved, "Where the scene of the recording is now");
  addThreadsOption(*export_command, options.choice);
  addTellingOptions(*export_command, options.telling);
  export_command->footer(
      "Example: carom export sliding sliding.glb\n"
      "A page to open in a browser: carom export fifty-bodies fifty-bodies.html");
}

void CommandLine::addDistance() {
  DistanceOptions& options = distance_options;
  distance_command = app.add_subcommand(
      "distance",
      "Closest features, distance or depth of two meshes, as JSON; all meshes of a file count\n"
      "together, as one convex hull that stands where the file puts it");
  distance_command->add_option("A", options.mesh_a, "A mesh file");
  distance_command->add_option("B", options.mesh_b, "A mesh file");
  distance_command->add_option("--pose-a", options.pose_a, "x,y,z or x,y,z,qw,qx,qy,qz of A (identity)");
  distance_command->add_option("--pose-b", options.pose_b, "x,y,z or x,y,z,qw,qx,qy,qz of B (identity)");
  distance_command->add_option("--batch", options.batch,
                               "Queries, one JSON object a line, from a file or - for standard input; one\n"
                               "answer a line, in order; exit 3 at the end if a line has an \"error\"");
  distance_command->add_flag("--cold", options.cold,
                             "Starts each query of --batch afresh, not from the features of the one before");
  distance_command->footer(
      "Example: carom distance cube.obj gem.obj --pose-b 0.9,0.1,0,1,0,0,0\n"
      "A line of --batch: {\"a\": \"cube.obj\", \"b\": \"gem.obj\",\n"
      "                    \"poseB\": {\"position\": [0.9, 0.1, 0], \"rotation\": [1, 0, 0, 0]}}");
}

void CommandLine::addCompare() {
  CompareOptions& options = compare_options;
  compare_command = app.add_subcommand(
      "compare",
      "Gates rendered PNG files against golden ones: files or folders; exit 1 when a pair does not pass");
  compare_command->add_option("ACTUAL", options.actual, "What was rendered: a file or a folder")->required();
  compare_command->add_option("GOLDEN", options.golden, "What it is to look like")->required();
  compare_command
      ->add_option("--tolerance", options.tolerance,
                   "Largest difference of any pixel's channel, in steps of 1/255")
      ->check(CLI::Range(0, 255))
      ->capture_default_str();
  compare_command
      ->add_option("--tolerance16", options.tolerance16, "The same of 16-bit images, in steps of 1/65535")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  compare_command
      ->add_option("--allow-pixels", options.allowed_pixels,
                   "This many pixels of an image may differ by more all the same")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  compare_command->add_option("--report", options.report,
                              "HTML report, or none (compare-report.html, when a pair does not pass)");
  compare_command
      ->add_option("--report-pairs", options.report_pairs, "The report holds the images of the worst N")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  compare_command->add_option("--differences", options.differences,
                              "Folder for an amplified difference image of each pair that differs");
  compare_command->add_option("--amplify", options.amplify, "Factor of the difference images")
      ->check(CLI::Range(1, 255))
      ->capture_default_str();
  compare_command->add_flag("--json", options.json, "One JSON object instead of lines");
  compare_command->add_option("--junit", options.junit, "JUnit XML file for a build server");
  compare_command->add_flag("--update", options.update,
                            "Replaces the golden files that do not pass, and adds new ones; deletes none");
  compare_command
      ->add_option("--accept", options.accepted,
                   "Replaces or adds the golden files of these pairs alone (names, comma separated)")
      ->delimiter(',');
  compare_command->add_flag("--undo", options.undo, "Takes the last --update or --accept of GOLDEN back");
  compare_command->add_option(
      "--mask", options.masks,
      "What is not looked at: body:NAME (frames with --states), rect:X,Y,W,H or png:FILE,\n"
      "whose pixels that are not black; may be given several times");
  addTellingOptions(*compare_command, options.telling);
  compare_command->footer(
      "Example: carom compare out tests/golden/sliding --report out/report.html --junit out/report.xml\n"
      "Accept what was rendered: carom compare out tests/golden/sliding --update");
}

void CommandLine::addRegress() {
  RegressOptions& options = regress_options;
  regress_command = app.add_subcommand(
      "regress",
      "Draws and compares all scenes that a suite lists, several at a time; exit 1 when one differs");
  regress_command->add_option("DIR", options.suite, "A folder with suite.json and golden frames, or the file")
      ->required();
  regress_command->add_option("-o,--output", options.output, "Folder for frames, reports and index.html")
      ->capture_default_str();
  regress_command->add_option("--jobs", options.jobs, "Scenes at a time (0: one for each processor)")
      ->check(CLI::Range(0, kMostWorkers))
      ->capture_default_str();
  regress_command->add_flag("--json", options.json, "One JSON object instead of lines");
  regress_command->add_option("--junit", options.junit, "JUnit XML file for a build server");
  regress_command->add_flag("--update", options.update,
                            "Accepts all frames that do not pass, and their records");
  addTellingOptions(*regress_command, options.telling);
  regress_command->footer("Example: carom regress tests/golden -o out --junit out/junit.xml");
}

void CommandLine::addBudget() {
  BudgetOptions& options = budget_options;
  budget_command = app.add_subcommand(
      "budget",
      "Times a scene's frames, phase by phase, against a deadline; exit 1 when over, 7 when there is too\n"
      "much noise to tell");
  addSceneOptions(*budget_command, options.choice);
  budget_command->add_option("--budget", options.budget_ms, "Milliseconds a frame may take")
      ->capture_default_str();
  budget_command->add_option("--percentile", options.percentile, "This share of the frames must keep it")
      ->capture_default_str();
  budget_command
      ->add_option("--replays", options.replays,
                   "Runs of the same scene; a frame counts with the least of its times (--against: 21)")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  budget_command->add_option("--fps", options.fps, "Frames a second of the scene's time")
      ->capture_default_str();
  budget_command->add_option("--size", budget_size, "WIDTHxHEIGHT in pixels (1280x720)");
  addGlOption(*budget_command, options.gl);
  budget_command->add_option("--camera", options.camera, "One of the scene's cameras (main, or its first)");
  addPresetOption(*budget_command, options.preset);
  addLightOption(*budget_command, options.light);
  options.choice.threads = 1;  // what is measured is a frame on one thread
  addThreadsOption(*budget_command, options.choice);
  budget_command->add_option("--json", options.json,
                             "All figures as JSON, to a file or - for standard output");
  budget_command->add_option("--csv", options.csv, "One row a frame, to a file or - for standard output");
  budget_command->add_option("--trace", options.trace,
                             "The quickest replay as trace events, for ui.perfetto.dev");
  budget_command->add_option(
      "--plot", options.plot,
      "The frame times as a picture (.svg, or .html): phases stacked, deadline, percentiles,\n"
      "slowest frames; with --baseline or --against the other run as a line over it");
  budget_command->add_option(
      "--baseline", options.baseline,
      "An earlier --json of the same scene on the same machine: exit 1 when a phase got\n"
      "slower, and which");
  budget_command->add_option("--tolerance", budget_tolerance, "How much slower a phase may be (10%)");
  budget_command->add_option("--work-tolerance", budget_work_tolerance,
                             "How much more exact work than --baseline tells of a frame may do (0%), on any\n"
                             "machine");
  budget_command
      ->add_option("--clock", options.clock,
                   "wall, or cpu: CPU time of all threads, for machines that are shared")
      ->check(CLI::IsMember({"wall", "cpu"}))
      ->capture_default_str();
  budget_command->add_option(
      "--against", options.against,
      "Another carom (\"old/carom --preset fast\"), taking turns frame by frame: exit 1\n"
      "when this one is slower, by exact tests of signs and ranks, and in which phase");
  budget_command->add_flag("--paced", options.paced,
                           "Draws a frame for each line on standard input, and answers with its times: what\n"
                           "--against starts");
  addTellingOptions(*budget_command, options.telling);
  budget_command->footer(
      "Example: carom budget fifty-bodies --size 640x360 --json now.json --trace now.trace.json\n"
      "After a change: carom budget fifty-bodies --size 640x360 --baseline now.json --tolerance 10%\n"
      "Against the program before: carom budget fifty-bodies --size 640x360 --against old/carom");
}

void CommandLine::addFigures() {
  figures_command = app.add_subcommand(
      "figures", "Draws the paper's figures 1 to 10 from the running engine, as PNG files");
  figures_command
      ->add_option("-o,--output", figures_options.output, "Folder for figure_01.png to figure_10.png")
      ->capture_default_str();
  figures_command->add_option("--size", figures_size, "WIDTHxHEIGHT in pixels (1280x720)");
  figures_command->footer("Example: carom figures -o figures --size 1920x1080");
}

void CommandLine::addGallery() {
  GalleryOptions& options = gallery_options;
  gallery_command = app.add_subcommand(
      "gallery",
      "Makes a folder that opens in a browser: moving pictures of scenes, and a page that plays each");
  gallery_command->add_option("SCENES", options.scenes,
                              "Shipped scenes' names or paths to .json files; none: all shipped");
  gallery_command
      ->add_option("-o,--output", options.output, "The folder; what is up to date in it is not made again")
      ->capture_default_str();
  gallery_command->add_option("--size", gallery_size, "WIDTHxHEIGHT of the moving pictures (480x270)");
  gallery_command
      ->add_option("--fps", options.fps, "Frames a second of the moving pictures, where 300 KB allow them")
      ->capture_default_str();
  gallery_command->add_option("-j,--jobs", options.jobs, "Scenes at a time (0: one for each processor)")
      ->check(CLI::Range(0, kMostWorkers))
      ->capture_default_str();
  gallery_command->add_flag(
      "--part", options.part,
      "Makes the files of one scene and prints what they are as JSON: what gallery starts\n"
      "for each");
  addGlOption(*gallery_command, options.gl);
  addTellingOptions(*gallery_command, options.telling);
  gallery_command->footer("Example: carom gallery sliding fifty-bodies my_scene.json -o gallery");
}

std::vector<std::string> optionNames(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// The words of "TEXT:{json,none,auto}", CLI11's name for a value that is one of a few.
std::vector<std::string> choicesIn(const std::string& type) {
  std::vector<std::string> words;
  const std::size_t open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return words;
  std::istringstream in(type.substr(open + 1, close - open - 1));
  for (std::string word; std::getline(in, word, ',');) words.push_back(word);
  return words;
}

OptionDescription described(const CLI::Option& option) {
  OptionDescription description;
  for (const std::string& name : option.get_snames()) description.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) description.names.push_back("--" + name);
  if (description.names.empty()) description.names.push_back(option.get_name(true));
  description.takes_value = !option.get_positional() && option.get_expected_max() > 0;
  description.choices = choicesIn(option.get_type_name());
  description.text = option.get_description();
  return description;
}

CommandDescription described(const CLI::App& command) {
  CommandDescription description{command.get_name(), command.get_description(), {}, {}, command.get_footer()};
  for (const CLI::Option* option : command.get_options())
    (option->get_positional() ? description.arguments : description.options).push_back(described(*option));
  return description;
}

ProgramDescription describedProgram(const CLI::App& app) {
  ProgramDescription program{app.get_name(), programVersion(), app.get_description(), {}, {}};
  for (const CLI::Option* option : app.get_options()) program.options.push_back(described(*option));
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    program.commands.push_back(described(*command));
  return program;
}

/// Words that nothing wanted: a misspelt command or option, or one argument too many.
void refuseExtras(const CommandLine& line) {
  const std::vector<CLI::App*> chosen = line.app.get_subcommands();
  if (chosen.empty()) {
    std::vector<std::string> names;
    for (const CLI::App* command : line.app.get_subcommands([](const CLI::App*) { return true; }))
      names.push_back(command->get_name());
    const std::vector<std::string> extras = line.app.remaining();
    if (extras.empty()) throw UsageError("a command is missing" + acceptedNames("", names));
    if (extras[0][0] == '-')
      throw UsageError("unknown option " + extras[0] + acceptedNames(extras[0], optionNames(line.app)));
    throw UsageError("unknown command \"" + extras[0] + "\"" + acceptedNames(extras[0], names));
  }
  const std::vector<std::string> extras = line.app.remaining(true);
  if (extras.empty()) return;
  const std::string word = extras[0].substr(0, extras[0].find('='));
  const std::string name = chosen[0]->get_name();
  if (word[0] == '-')
    throw UsageError(name + ": unknown option " + word + acceptedNames(word, optionNames(*chosen[0])));
  throw UsageError(name + ": unexpected argument \"" + word + "\"");
}

bool namesANumber(const std::string& output) {
  return std::filesystem::path(output).filename().string().find_first_of("%#") != std::string::npos;
}

/// What `-o` is to become, by its name: a moving picture, or one picture.
void settleOutput(RenderOptions& options) {
  const std::filesystem::path path(options.output);
  if (isMovingPicture(path)) {
    if (!options.sheet.empty())
      throw UsageError("--sheet: -o " + options.output + ": accepted: a name that ends in .png");
    if (options.at_s)
      throw UsageError("--at is one picture; -o " + options.output +
                       " moves; accepted: a name that ends in .png");
    if (options.resume)
      throw UsageError("--resume keeps frames that have files of their own; accepted: without -o " +
                       options.output);
    options.moving = std::exchange(options.output, "");
    return;
  }
  const bool is_one = path.extension() == ".png" && !namesANumber(options.output);
  if (!options.sheet.empty() && !options.output.empty() && !is_one)
    throw UsageError("--sheet: -o " + options.output +
                     ": accepted: a name that ends in .png, without a number");
  const bool is_part = !options.frames.empty() || !options.shard.empty() || !options.from.empty();
  if (is_one && options.sheet.empty() && !options.at_s && !is_part) options.at_s = 0.0;
}

void checkRender(const RenderOptions& options) {
  if (!options.focus.empty() && options.overlays.empty())
    throw UsageError("--focus is of --overlay, which is missing");
  if (options.choice.scene.empty() && options.from.empty())
    throw UsageError("render: SCENE is required, or --from with a recording");
  if (!(options.speed >= kLowestSpeed && options.speed <= kHighestSpeed)) {
    std::ostringstream message;
    message << "--speed " << options.speed << ": accepted: " << kLowestSpeed << " to " << kHighestSpeed;
    throw UsageError(message.str());
  }
  if (options.at_s && !(*options.at_s >= 0.0 && *options.at_s <= kLongest_s)) {
    std::ostringstream message;
    message << "--at " << *options.at_s << ": accepted: 0 to " << kLongest_s << " seconds";
    throw UsageError(message.str());
  }
  if (!options.aov.empty() && (!options.moving.empty() || !options.sheet.empty()))
    throw UsageError("--aov has 16 bits a sample, a moving picture or a sheet 8; accepted: with frames");
  if ((options.output == "-") != !options.stream.empty())
    throw UsageError("-o - and --stream ppm|png|rgb24 are accepted together only");
}

void checkExport(const ExportOptions& options) {
  if (options.output.empty() && options.trajectory.csv.empty() && options.trajectory.npy.empty())
    throw UsageError("export: nothing to write; accepted: a .glb or .html file, --csv FILE or --npy FOLDER");
  if (!options.output.empty() && options.output.extension() != ".glb" &&
      options.output.extension() != ".html")
    throw UsageError("export: " + options.output.string() + ": accepted: a name that ends in .glb or .html");
  if (options.fps) requireWithin("--fps", *options.fps, kHighestFps);
}

void checkBudget(CommandLine& line) {
  BudgetOptions& options = line.budget_options;
  requireWithin("--budget", options.budget_ms, kLongestBudget_ms);
  requireWithin("--percentile", options.percentile, 100.0);
  requireWithin("--fps", options.fps, kHighestFps);
  if (!line.budget_size.empty()) readSize(line.budget_size, options);
  if (!line.budget_tolerance.empty()) {
    options.tolerance_percent = readPercentage("--tolerance", line.budget_tolerance);
    if (options.baseline.empty() && options.against.empty())
      throw UsageError("--tolerance is of --baseline, which is missing");
  }
  if (!options.plot.empty() && options.plot.extension() != ".svg" && options.plot.extension() != ".html")
    throw UsageError("--plot " + options.plot.string() + ": accepted: a name that ends in .svg or .html");
  if (!line.budget_work_tolerance.empty()) {
    options.work_tolerance_percent = readPercentage("--work-tolerance", line.budget_work_tolerance);
    if (options.baseline.empty()) throw UsageError("--work-tolerance is of --baseline, which is missing");
  }
  if (!options.against.empty() && line.budget_command->count("--replays") == 0)
    options.replays = kFewestRounds;
  if (!options.against.empty() &&
      (!options.baseline.empty() || !options.trace.empty() || !options.csv.empty()))
    throw UsageError(
        "--against takes turns with another program: accepted without --baseline, --csv and --trace");
  if (options.json == "-" && options.csv == "-")
    throw UsageError("--json - and --csv -: standard output can take one of them");
}

void checkValues(CommandLine& line) {
  for (const SceneChoice* choice : {&line.render_options.choice, &line.simulate_options.choice,
                                    &line.export_options.choice, &line.budget_options.choice})
    if (choice->duration_s) requireWithin("--duration", *choice->duration_s, kLongest_s);
  requireWithin("--fps", line.render_options.fps, kHighestFps);
  requireWithin("--fps", line.simulate_options.fps, kHighestFps);
  if (line.render_command->parsed()) {
    settleOutput(line.render_options);
    checkRender(line.render_options);
  }
  if (!line.render_options.sheet.empty()) readSize("320x180", line.render_options);
  if (!line.size.empty()) readSize(line.size, line.render_options);
  if (line.export_command->parsed()) checkExport(line.export_options);
  if (!line.figures_size.empty()) readSize(line.figures_size, line.figures_options);
  if (!line.gallery_size.empty()) readSize(line.gallery_size, line.gallery_options);
  requireWithin("--fps", line.gallery_options.fps, kHighestPictureFps);
  if (line.gallery_options.part && line.gallery_options.scenes.size() != 1)
    throw UsageError("gallery --part makes the files of one scene; accepted: with one SCENE");
  checkBudget(line);
  if (!line.simulate_options.expected_hash.empty()) requireHash(line.simulate_options.expected_hash);
}

std::string helpOf(const CommandLine& line, const std::string& name) {
  // Of an application that has parsed a command, help is that command's.
  if (name.empty()) return CommandLine().app.help();
  std::vector<std::string> names;
  for (const CLI::App* command : line.app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_name() == name) return command->help("carom");
    names.push_back(command->get_name());
  }
  throw UsageError("help: unknown command \"" + name + "\"" + acceptedNames(name, names));
}

std::string oneLine(std::string text) {
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text;
}

}  // namespace

ExitCode runCommandLine(int argc, char** argv) {
  CommandLine line;
  try {
    line.app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    const std::vector<CLI::App*> chosen = line.app.get_subcommands();
    std::cout << (chosen.empty() ? line.app.help() : chosen[0]->help("carom"));
    return ExitCode::kOk;
  } catch (const CLI::CallForVersion& version) {
    std::cout << version.what() << '\n';
    return ExitCode::kOk;
  } catch (const CLI::ParseError& error) {
    refuseExtras(line);  // a misspelt word is the better reason when there is one
    throw UsageError(oneLine(error.what()));
  }
  if (line.wants_manual || line.wants_completion || line.wants_zsh || line.wants_fish) {
    const ProgramDescription program = describedProgram(line.app);
    std::cout << (line.wants_manual       ? manualPage(program)
                  : line.wants_completion ? bashCompletion(program)
                  : line.wants_zsh        ? zshCompletion(program)
                                          : fishCompletion(program));
    return ExitCode::kOk;
  }
  refuseExtras(line);
  if (line.help_command->parsed()) {
    std::cout << helpOf(line, line.help_of);
    return ExitCode::kOk;
  }
  if (line.version_command->parsed()) {
    std::cout << line.app.version() << '\n';
    return ExitCode::kOk;
  }
  if (line.render_options.overlays == "help") {
    std::cout << overlayHelp();
    return ExitCode::kOk;
  }
  checkValues(line);
  for (int i = 1; i < argc; ++i) line.budget_options.words.emplace_back(argv[i]);
  const RenderOptions& asked = line.render_options;
  line.render_options.caption =
      line.caption.empty() ? !asked.portable && asked.background == "scene" : line.caption == "on";
  line.render_options.states = line.render_options.states || line.render_options.portable;
  line.render_options.command_line = quotedCommandLine(argc, argv);
  if (line.list_command->parsed()) return list(line.list_options);
  if (line.render_command->parsed()) return render(line.render_options);
  if (line.simulate_command->parsed()) return simulate(line.simulate_options);
  if (line.export_command->parsed()) return exportMotion(line.export_options);
  if (line.check_command->parsed()) return check(line.check_options);
  if (line.distance_command->parsed()) return distance(line.distance_options);
  if (line.compare_command->parsed()) return compare(line.compare_options);
  if (line.regress_command->parsed()) return regress(line.regress_options);
  if (line.budget_command->parsed()) return budget(line.budget_options);
  if (line.figures_command->parsed()) return figures(line.figures_options);
  if (line.gallery_command->parsed()) return gallery(line.gallery_options);
  if (line.new_command->parsed()) return newScene(line.new_options);
  return doctor(line.doctor_options);
}

}  // namespace carom::demos
