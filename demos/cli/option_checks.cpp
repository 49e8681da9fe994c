#include <sstream>
#include <utility>

#include "demos/against/against_result.h"
#include "demos/cli/command_options.h"
#include "demos/cli/given_values.h"
#include "demos/video/moving_picture.h"

namespace carom::demos {
namespace {

constexpr double kLongest_s = 3600.0;
constexpr double kHighestFps = 1000.0;
constexpr double kHighestPictureFps = 30.0;
constexpr double kLowestSpeed = 0.001, kHighestSpeed = 1000.0;
constexpr double kLongestBudget_ms = 1e6;
constexpr int kSmallestSide = 16;
constexpr int kLargestSide = 8192;

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

bool namesANumber(const std::string& output) {
  return std::filesystem::path(output).filename().string().find_first_of("%#") != std::string::npos;
}

/// One file holds what would have files of their own.
void refuseNumber(const std::string& what, const std::string& file) {
  if (namesANumber(file))
    throw UsageError(what + " is one file: " + file + "; accepted: a name without % and #");
}

/// What is of many frames says nothing of one picture that is drawn of the start.
void requireOfOne(const CLI::App& render, const RenderOptions& options) {
  if (!options.from.empty())
    throw UsageError("-o " + options.output +
                     ": --from has frames; accepted: a name with a number, such as frame_%04d.png, and "
                     "--frames 0 for one of them");
  for (const char* option : {"--fps", "--speed", "--duration"})
    if (render.count(option) > 0)
      throw UsageError(
          std::string(option) + " is of many frames, -o " + options.output +
          " is one picture; accepted: --at SECONDS, or a name with a number, such as frame_%04d.png");
}

/// What `-o` is to become, by its name: a moving picture, or one picture.
void settleOutput(const CLI::App& render, RenderOptions& options) {
  const std::filesystem::path path(options.output);
  if (options.at_s) refuseNumber("--at", options.output);
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
  const bool is_part = !options.frames.empty() || !options.shard.empty();
  if (!is_one || !options.sheet.empty() || options.at_s || is_part) return;
  requireOfOne(render, options);
  options.at_s = 0.0;
}

/// A record is of a run's frames and of nothing less; overlays watch the world themselves.
void requireRecordable(const RenderOptions& options) {
  const char* without = options.at_s                ? "--at, or with a number in the name of -o"
                        : !options.shard.empty()    ? "--shard"
                        : !options.from.empty()     ? "--from"
                        : !options.stream.empty()   ? "--stream"
                        : !options.moving.empty()   ? "a moving picture"
                        : !options.sheet.empty()    ? "--sheet"
                        : !options.overlays.empty() ? "--overlay"
                                                    : nullptr;
  if (without != nullptr)
    throw UsageError(
        std::string("--states is a record beside the frames of a whole run; accepted: without ") + without);
}

void checkRender(const RenderOptions& options) {
  refuseNumber("a moving picture", options.moving.string());
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
}

}  // namespace

void checkValues(CommandLine& line) {
  for (const SceneChoice* choice : {&line.render_options.choice, &line.simulate_options.choice,
                                    &line.export_options.choice, &line.budget_options.choice})
    if (choice->duration_s) requireWithin("--duration", *choice->duration_s, kLongest_s);
  requireWithin("--fps", line.render_options.fps, kHighestFps);
  requireWithin("--fps", line.simulate_options.fps, kHighestFps);
  if (line.render_command->parsed()) {
    settleOutput(*line.render_command, line.render_options);
    checkRender(line.render_options);
    if (line.render_options.states) requireRecordable(line.render_options);
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
  const CLI::App& command = *line.app.get_subcommands().at(0);
  const std::vector<NamedFile> written = writtenFiles(command);
  requireNotRead(written, readFiles(command));
  for (SceneChoice* choice : {&line.render_options.choice, &line.simulate_options.choice,
                              &line.export_options.choice, &line.budget_options.choice})
    choice->written = written;
}

}  // namespace carom::demos
