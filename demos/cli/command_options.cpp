#include "demos/cli/command_options.h"

#include <vector>

#include "demos/cli/help_formatter.h"
#include "demos/cli/shared_options.h"
#include "demos/system/build_info.h"
#include "renderer/image/png.h"

namespace carom::demos {

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
  app.formatter(helpFormatter());  // which commands inherit when they are added
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
  headOtherOptions(app);
  for (CLI::App* command : app.get_subcommands({})) command->allow_extras();
  app.allow_extras();
  app.require_subcommand(0, 1);
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
                               "One row a step: energy, momentum, gap, counters; or -");
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
      ->check(CLI::Range(std::int64_t{0}, renderer::kMaxPngPixels))
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
                             "The quickest replay as trace events, for ui.perfetto.dev; or -");
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

}  // namespace carom::demos
