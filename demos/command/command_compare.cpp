// `carom compare`: rendered images against golden ones. Compares all, writes what was asked for (report,
// difference images, JUnit), replaces golden files last, so that the report still shows what they were.
#include "demos/command/command.h"

#include <algorithm>
#include <exception>
#include <iostream>
#include <map>
#include <optional>
#include <set>

#include "demos/cause/cause_json.h"
#include "demos/compare/cause.h"
#include "demos/compare/comparison_run.h"
#include "demos/compare/golden_undo.h"
#include "demos/compare/picture_mask.h"
#include "demos/format/nearest_name.h"
#include "demos/format/printable.h"
#include "demos/format/progress.h"
#include "demos/report/comparison_json.h"
#include "demos/report/comparison_report.h"
#include "demos/report/junit.h"
#include "demos/scene/written_files.h"
#include "demos/system/atomic_file.h"
#include "demos/system/interrupt.h"
#include "engine/foundation/contract.h"
#include "renderer/image/png.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

/// Whether `path` is `folder` or lies below it.
bool isWithin(const fs::path& path, const fs::path& folder) {
  std::error_code failed;
  const fs::path relative =
      fs::weakly_canonical(path, failed).lexically_relative(fs::weakly_canonical(folder, failed));
  return !failed && !relative.empty() && *relative.begin() != "..";
}

void checkOptions(const CompareOptions& options) {
  if (options.differences.empty()) return;
  std::error_code ignored;
  for (const fs::path& folder : {options.actual, options.golden})
    if (fs::is_directory(folder, ignored) && isWithin(options.differences, folder))
      throw UsageError("compare: --differences " + options.differences.string() + " lies in " +
                       folder.string() +
                       ", and would be compared the next time; accepted: a folder elsewhere");
}

bool isUpdate(const CompareOptions& options) {
  return options.update || !options.accepted.empty();
}

/// Reports and difference images are none of the files that are compared.
void requireApart(const CompareOptions& options, const std::vector<ImagePair>& pairs) {
  std::vector<NamedFile> written, read;
  if (!options.report.empty() && options.report != "none") written.push_back({"--report", options.report});
  if (!options.junit.empty()) written.push_back({"--junit", options.junit});
  for (const ImagePair& pair : pairs) {
    read.insert(read.end(), {{"ACTUAL", pair.actual}, {"GOLDEN", pair.golden}});
    for (const fs::path& variant : goldenVariants(pair.golden)) read.push_back({"GOLDEN", variant});
    if (!options.differences.empty()) written.push_back({"--differences", options.differences / pair.name});
  }
  for (const auto& [name, folder] : {std::pair("ACTUAL", options.actual), {"GOLDEN", options.golden}})
    read.push_back({name, folder / kRecordName});
  for (const std::string& mask : options.masks)
    if (mask.starts_with("png:")) read.push_back({"--mask", mask.substr(4)});
  requireNotRead(written, read);
}

std::vector<Comparison> compareAll(const CompareOptions& options, const Gate& gate) {
  const std::vector<ImagePair> pairs = imagePairs({options.actual, options.golden, isUpdate(options)});
  requireApart(options, pairs);
  const ProgressStyle style = progressStyle(options.telling.progress, options.telling.quiet);
  Progress progress({"pair", static_cast<int>(pairs.size())}, style, std::cerr, steadySeconds);
  return comparedPairs(pairs, gate, [&progress](int count) { progress.done(count); });
}

/// Gives every difference its cause, from the records beside the frames.
void explain(std::vector<Comparison>& comparisons, const Gate& gate, RecordShelf& shelf) {
  for (Comparison& c : comparisons) {
    if (c.verdict != Verdict::kBeyond) continue;
    throwIfInterrupted();
    c.cause = causeOfDifference(c, gate, shelf);
  }
}

/// What the frames of a folder pass without showing it.
void noteUnseen(const std::vector<Comparison>& comparisons, RecordShelf& shelf) {
  std::set<fs::path> told;
  for (const Comparison& c : comparisons)
    if (!c.passes()) told.insert(c.pair.golden.parent_path());
  std::map<fs::path, std::vector<RecordedPictures>> folders;
  for (const Comparison& c : comparisons) {
    const fs::path folder = c.pair.golden.parent_path();
    if (told.contains(folder)) continue;
    const std::optional<RecordedPicture> actual = shelf.ofActual(c.pair), golden = shelf.ofGolden(c.pair);
    if (actual && golden) folders[folder].push_back({*actual, *golden});
  }
  for (const auto& [folder, frames] : folders) {
    const Cause cause = causeInRecords(frames);
    if (cause.known())
      std::cerr << "note: " << printable(folder.string() + " passes, but " + cause.headline) << '\n';
  }
}

void writeDifferences(const CompareOptions& options, const std::vector<Comparison>& comparisons,
                      const Gate& gate) {
  for (const Comparison& c : comparisons) {
    if (c.verdict != Verdict::kBeyond) continue;
    throwIfInterrupted();
    renderer::Raster actual = renderer::readPngRaster(c.pair.actual).raster;
    const renderer::Raster golden = renderer::readPngRaster(c.pair.golden).raster;
    if (gate.mask != nullptr) gate.mask->apply(c.pair, actual, golden);
    const int tolerance = gate.toleranceOf(actual.fullScale());
    AtomicFile file(options.differences / c.pair.name);
    file.write(renderer::encodePng(renderer::differenceImage(actual, golden, {tolerance, options.amplify})));
    file.commit();
  }
}

void writeJunit(const CompareOptions& options, const std::vector<Comparison>& comparisons, const Gate& gate) {
  AtomicFile file(options.junit);
  file.write(junitText(options.golden.string(), comparisons, gate));
  file.commit();
}

/// The folder that the golden files lie in, below which an update can be taken back.
fs::path goldenRoot(const CompareOptions& options) {
  std::error_code ignored;
  return fs::is_regular_file(options.golden, ignored) ? options.golden.parent_path() : options.golden;
}

bool isChosen(const CompareOptions& options, const Comparison& c) {
  return options.accepted.empty() ||
         std::find(options.accepted.begin(), options.accepted.end(), c.pair.name) != options.accepted.end();
}

void requireKnown(const CompareOptions& options, const std::vector<Comparison>& comparisons) {
  std::vector<std::string> names;
  for (const Comparison& c : comparisons) names.push_back(c.pair.name);
  for (const std::string& name : options.accepted)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw UsageError("--accept " + name + ": there is no such pair" + acceptedNames(name, names));
}

/// The golden folders, each with a pair, whose record is to be replaced by that of the frames. A record that
/// an earlier run left beside them is not accepted.
std::map<fs::path, ImagePair> newRecords(const CompareOptions& options,
                                         const std::vector<Comparison>& comparisons, RecordShelf& shelf) {
  std::map<fs::path, ImagePair> folders;
  for (const Comparison& c : comparisons)
    if (isChosen(options, c) && shelf.ofActual(c.pair))
      folders.try_emplace(c.pair.golden.parent_path(), c.pair);
  std::erase_if(folders, [](const auto& folder) { return !hasOtherRecord(folder.second); });
  return folders;
}

/// Whether a golden image, though it passes, shows another state or scene than the new record tells of.
bool isOfOtherRecord(const Comparison& c, RecordShelf& shelf) {
  const std::optional<RecordedPicture> actual = shelf.ofActual(c.pair);
  return c.passes() && actual && !actual->shot.isOf(renderer::readPngText(c.pair.golden));
}

std::vector<Update> updateAll(const CompareOptions& options, const std::vector<Comparison>& comparisons,
                              RecordShelf& shelf) {
  const std::map<fs::path, ImagePair> records = newRecords(options, comparisons, shelf);
  std::vector<Update> updates;
  GoldenUndo undo(goldenRoot(options));
  for (const Comparison& c : comparisons) {
    Update update = isChosen(options, c) ? plannedUpdate(c) : Update::kNone;
    if (isChosen(options, c) && records.contains(c.pair.golden.parent_path()) && isOfOtherRecord(c, shelf))
      update = Update::kReplaced;
    if (writesGolden(update)) undo.keep(c.pair.golden);
    updates.push_back(update);
  }
  for (const auto& [folder, pair] : records) undo.keep(folder / kRecordName);
  undo.commit();
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    throwIfInterrupted();
    if (writesGolden(updates[i])) replaceGolden(comparisons[i].pair);
  }
  for (const auto& [folder, pair] : records) updateRecord(pair);
  return updates;
}

/// The pairs that do not pass, worst first, and the counts.
void printLines(const ComparisonOutcome& outcome) {
  for (const std::size_t i : bySeverity(outcome.comparisons)) {
    const Comparison& c = outcome.comparisons[i];
    if (c.passes()) continue;
    const std::string update =
        outcome.updates.empty() ? "" : std::string(updateName(outcome.updates[i])) + "  ";
    std::cout << update << printable(c.pair.name + "  " + comparisonLine(c, outcome.gate)) << '\n';
    for (const std::string& line : causeLines(c.cause)) std::cout << "    " << printable(line) << '\n';
  }
  std::cout << tallyText(tallyOf(outcome.comparisons)) << '\n';
}

/// A word for a shell, quoted where it must be.
std::string shellWord(const std::string& word) {
  if (!word.empty() && word.find_first_of(" \t\n\"'\\$&|;<>()*?#~`![]{}") == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// The command that would accept what was rendered, with the gate of this one; ends in `how`.
std::string updateCommand(const CompareOptions& options, const std::string& how = " --update") {
  std::string command =
      "carom compare " + shellWord(options.actual.string()) + " " + shellWord(options.golden.string());
  const CompareOptions plain;
  if (options.tolerance != plain.tolerance) command += " --tolerance " + std::to_string(options.tolerance);
  if (options.tolerance16 != plain.tolerance16)
    command += " --tolerance16 " + std::to_string(options.tolerance16);
  if (options.allowed_pixels != plain.allowed_pixels)
    command += " --allow-pixels " + std::to_string(options.allowed_pixels);
  for (const std::string& mask : options.masks) command += " --mask " + shellWord(mask);
  return command + how;
}

std::string undoCommand(const CompareOptions& options) {
  return "carom compare " + shellWord(options.actual.string()) + " " + shellWord(options.golden.string()) +
         " --undo";
}

/// The report's path, or nothing when none is wanted.
fs::path reportPath(const CompareOptions& options, bool passes) {
  if (options.report == "none") return {};
  if (options.report.empty()) return passes ? "" : "compare-report.html";
  return options.report;
}

/// Where it was written. Nobody asked for the usual one: where it cannot be written, that is only noted.
fs::path writeReport(const CompareOptions& options, const std::vector<Comparison>& comparisons,
                     const Gate& gate) {
  const Tally tally = tallyOf(comparisons);
  const fs::path path = reportPath(options, tally.passed == tally.total);
  if (path.empty()) return {};
  try {
    writeComparisonReport(path, comparisons,
                          {options.actual.string(),
                           options.golden.string(),
                           gate,
                           options.report_pairs,
                           options.amplify,
                           isUpdate(options),
                           {options.accepted.begin(), options.accepted.end()},
                           updateCommand(options, " --accept "),
                           undoCommand(options)});
  } catch (const CannotWrite& error) {
    if (!options.report.empty()) throw;
    if (!options.telling.quiet)
      std::cerr << "note: " << printable(error.what()) << "; accepted: --report FILE, or none\n";
    return {};
  }
  return path;
}

const Comparison* firstUnreadable(const std::vector<Comparison>& comparisons) {
  for (const Comparison& c : comparisons)
    if (c.verdict == Verdict::kUnreadable) return &c;
  return nullptr;
}

/// What is left unsettled after an update: golden files that nothing replaces.
ExitCode afterUpdate(const ComparisonOutcome& outcome) {
  const Comparison* first = nullptr;
  int kept = 0;
  for (std::size_t i = 0; i < outcome.updates.size(); ++i) {
    if (outcome.updates[i] != Update::kRefused) continue;
    if (kept++ == 0) first = &outcome.comparisons[i];
    if (outcome.comparisons[i].verdict == Verdict::kUnreadable)
      throw InputError(outcome.comparisons[i].problem);
  }
  if (first == nullptr) return ExitCode::kOk;
  const std::string path = printable(first->pair.golden.string());
  if (kept == 1) {
    std::cerr << "carom: 1 golden file has no counterpart and stays: " << path
              << "; delete it if it is meant to go\n";
  } else {
    std::cerr << "carom: " << kept << " golden files have no counterpart and stay, the first " << path
              << "; delete those that are meant to go\n";
  }
  return ExitCode::kNo;
}

ExitCode afterComparison(const CompareOptions& options, const ComparisonOutcome& outcome) {
  const Tally tally = tallyOf(outcome.comparisons);
  const std::string report = outcome.report.empty() ? "" : "; report: " + outcome.report;
  if (const Comparison* c = firstUnreadable(outcome.comparisons)) {
    const int others = tally.total - tally.passed - 1;
    throw InputError(c->problem +
                     (others > 0 ? "; " + std::to_string(others) + " more of " + std::to_string(tally.total) +
                                       " pairs do not pass"
                                 : "") +
                     report);
  }
  if (tally.passed == tally.total) return ExitCode::kOk;
  std::cerr << "carom: " << printable(tallyText(tally) + report + "; accept with: " + updateCommand(options))
            << '\n';
  return ExitCode::kNo;
}

}  // namespace

ExitCode compare(const CompareOptions& options) {
  checkOptions(options);
  if (options.undo) {
    const int count = undoUpdate(goldenRoot(options));
    std::cout << count << (count == 1 ? " file" : " files") << " of " << printable(options.golden.string())
              << " as before the last update\n";
    return ExitCode::kOk;
  }
  catchInterrupts();
  RecordShelf shelf;
  const PictureMask mask(options.masks, shelf);
  Gate gate{options.tolerance, options.tolerance16, options.allowed_pixels, nullptr};
  if (mask.any()) gate.mask = &mask;
  std::vector<Comparison> comparisons = compareAll(options, gate);
  requireKnown(options, comparisons);
  explain(comparisons, gate, shelf);
  ComparisonOutcome outcome{comparisons, gate, "", {}};
  // What cannot be written does not keep the verdict from being told.
  std::exception_ptr unwritten;
  try {
    outcome.report = writeReport(options, comparisons, gate).string();
    if (!options.differences.empty()) writeDifferences(options, comparisons, gate);
    if (!options.junit.empty()) writeJunit(options, comparisons, gate);
    if (isUpdate(options)) outcome.updates = updateAll(options, comparisons, shelf);
  } catch (const CannotWrite&) {
    unwritten = std::current_exception();
  }
  if (options.json) {
    std::cout << comparisonJson(outcome).text(2) << '\n';
  } else {
    printLines(outcome);
  }
  if (unwritten) std::rethrow_exception(unwritten);
  if (!options.telling.quiet) {
    noteUnseen(comparisons, shelf);
    for (const std::string& problem : shelf.problems()) std::cerr << "note: " << printable(problem) << '\n';
  }
  if (!options.accepted.empty()) return ExitCode::kOk;
  return options.update ? afterUpdate(outcome) : afterComparison(options, outcome);
}

}  // namespace carom::demos
