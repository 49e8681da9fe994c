// The options of `render`, of which there are as many as of all other commands.
#include "demos/cli/command_options.h"
#include "demos/cli/shared_options.h"
#include "demos/overlay/overlay_choice.h"

namespace carom::demos {

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

}  // namespace carom::demos
