// `carom budget` from outside: the verdicts with their exit codes, what is refused and how, the files.
#include <algorithm>
#include <fstream>
#include <map>
#include <thread>

#include <gtest/gtest.h>

#include "demos/asset/asset_path.h"
#include "demos/format/json.h"
#include "demos/system/exit_code.h"
#include "tests/demos/support/program_run.h"

namespace carom::demos {
namespace {
namespace fs = std::filesystem;

/// 20 frames of a small scene in a small size: quick, and enough for a median.
std::vector<std::string> quick(const std::vector<std::string>& options) {
  std::vector<std::string> words = {"budget", "bouncing-ball", "-q",    "--size",    "64x48", "--percentile",
                                    "50",     "--duration",    "0.334", "--replays", "2"};
  words.insert(words.end(), options.begin(), options.end());
  return words;
}

void expectOnlyOneLine(const ProgramEnd& end, const std::string& part) {
  EXPECT_EQ(end.out, "");
  expectOneLine(end, part);
}

/// Processes that keep every core busy several times over.
class Burners {
 public:
  Burners() {
    for (unsigned i = 0; i < 3 * std::max(std::thread::hardware_concurrency(), 1u); ++i) {
      const pid_t child = fork();
      if (child == 0)
        for (volatile unsigned count = 0;;) count = count + 1;
      if (child > 0) children_.push_back(child);
    }
  }
  ~Burners() {
    for (const pid_t child : children_) {
      kill(child, SIGKILL);
      waitpid(child, nullptr, 0);
    }
  }
  Burners(const Burners&) = delete;
  Burners& operator=(const Burners&) = delete;

 private:
  std::vector<pid_t> children_;
};

bool isInconclusive(const ProgramEnd& end) {
  return end.code == static_cast<int>(ExitCode::kInconclusive);
}

/// The end of the first run that could judge, or of the last of some: on a busy machine none may.
ProgramEnd judged(const std::vector<std::string>& arguments) {
  ProgramEnd end = runCarom(arguments);
  for (int run = 1; run < 10 && isInconclusive(end); ++run) end = runCarom(arguments);
  return end;
}

double measured_ms(const ProgramEnd& end) {
  return Json::parse(end.out, "stdout").at("frame_ms").at("atPercentile").asNumber();
}

TEST(Budget, AGenerousBudgetEndsWith0AndTheReportEndsWithTheVerdict) {
  const ProgramEnd end = runCarom(quick({"--budget", "100000"}));
  EXPECT_EQ(end.code, 0) << end.err;
  EXPECT_EQ(end.err, "");
  EXPECT_NE(end.out.find("\nwithin: p50 "), std::string::npos) << end.out;
  EXPECT_EQ(end.out.rfind("bouncing-ball: 20 frames at 60 fps, 64x48, realtime, 2 replays", 0), 0u)
      << end.out;
}

TEST(Budget, ABudgetThatNothingCouldKeepEndsWith1) {
  const ProgramEnd end = runCarom(quick({"--budget", "0.0001"}));
  EXPECT_EQ(end.code, 1) << end.err;
  EXPECT_NE(end.out.find("\nover: p50 "), std::string::npos) << end.out;
  EXPECT_NE(end.out.find("over 0.0001 ms: 20 of 20 frames"), std::string::npos) << end.out;
}

// Budgets below what the burdened machine reaches: a no would be false, a yes is luck, and there is not luck
// enough for all of them.
TEST(Budget, LoadFromOutsideEndsWith7AndNeverWithAFalseNo) {
  const Burners burners;
  const ProgramEnd first = runCarom(quick({"--budget", "100000", "--json", "-"}));
  ASSERT_EQ(first.code, 0) << first.err;
  for (const double part : {1.5, 3.0, 8.0, 15.0}) {
    const ProgramEnd end = runCarom(quick({"--budget", std::to_string(measured_ms(first) / part)}));
    if (end.code == 0) continue;
    EXPECT_EQ(end.code, 7) << end.out;
    EXPECT_NE(end.out.find("\ninconclusive: p50 "), std::string::npos) << end.out;
    return;
  }
  FAIL() << "never inconclusive";
}

TEST(Budget, APercentileThatTheFramesCannotSupportIsRefusedWithTheNumberNeeded) {
  const ProgramEnd end = runCarom({"budget", "bouncing-ball", "--duration", "1", "-q"});
  EXPECT_EQ(end.code, 2);
  expectOnlyOneLine(
      end,
      "budget: p99 needs 100 frames, and this run has 60; accepted: --duration 1.66667 or longer at "
      "60 fps, or --percentile 98.3 or lower");
  const ProgramEnd lower = runCarom({"budget", "bouncing-ball", "--duration", "1", "-q", "--percentile",
                                     "98.3", "--size", "32x32", "--replays", "2", "--budget", "100000"});
  EXPECT_EQ(lower.code, 0) << lower.err;
}

TEST(Budget, WrongValuesEndWith2InOneLine) {
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"--budget", "0"},
                                             {"--budget", "-3"},
                                             {"--percentile", "0"},
                                             {"--percentile", "100.5"},
                                             {"--replays", "1"},
                                             {"--fps", "nan"},
                                             {"--tolerance", "10%"},
                                             {"--tolerance", "ten", "--baseline", "x.json"},
                                             {"--json", "-", "--csv", "-"}}) {
    std::vector<std::string> words = {"budget", "bouncing-ball"};
    words.insert(words.end(), options.begin(), options.end());
    const ProgramEnd end = runCarom(words);
    EXPECT_EQ(end.code, 2) << options[0] << ' ' << options[1];
    expectOnlyOneLine(end, options[0]);
  }
}

TEST(Budget, JsonCsvAndTraceAreWholeAndSayTheSame) {
  const Program program(quick(
      {"--budget", "100000", "--preset", "fast", "--json", "-", "--csv", "f.csv", "--trace", "t.json"}));
  const ProgramEnd end = program.wait();
  ASSERT_EQ(end.code, 0) << end.err;
  const Json json = Json::parse(end.out, "stdout");
  EXPECT_EQ(json.at("verdict").asString(), "within");
  EXPECT_EQ(json.at("subject").at("frames").asNumber(), 20.0);
  EXPECT_EQ(json.at("subject").at("preset").asString(), "fast");
  const std::string csv = readTextFile(program.folder() / "f.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 21);
  EXPECT_NE(csv.find("," + json.at("finalState").asString() + "\n"), std::string::npos);
  int frames = 0;
  const Json trace = Json::parse(readTextFile(program.folder() / "t.json"), "t.json");
  for (const Json& event : trace.at("traceEvents").items())
    frames += event.at("ph").asString() == "X" && event.at("cat").asString() == "frame";
  EXPECT_EQ(frames, 20);
}

/// Complete events of one thread lie within one another or apart: what Perfetto draws as slices.
void expectNested(std::vector<Json> spans) {
  const auto begin = [](const Json& e) { return e.at("ts").asNumber(); };
  const auto end = [&](const Json& e) { return begin(e) + e.at("dur").asNumber(); };
  std::stable_sort(spans.begin(), spans.end(), [&](const Json& a, const Json& b) {
    return begin(a) != begin(b) ? begin(a) < begin(b) : end(a) > end(b);
  });
  constexpr double kRounding_us = 1e-3;  // of doubles that hold hours in microseconds, with room
  std::vector<const Json*> open;
  for (const Json& span : spans) {
    while (!open.empty() && end(*open.back()) <= begin(span) + kRounding_us) open.pop_back();
    const bool is_frame = span.at("cat").asString() == "frame";
    ASSERT_EQ(open.empty(), is_frame) << span.text();
    if (!open.empty()) {
      ASSERT_LE(end(span), end(*open.back()) + kRounding_us) << span.text();
    }
    open.push_back(&span);
  }
}

// The Trace Event Format's JSON object form: every event with ph, name, pid, tid and a number ts; complete
// events (X) with dur, counters (C) with numbers in args, metadata (M) with a name in args.
TEST(Budget, TheTraceOfARunIsWhatTheTraceEventFormatAsksFor) {
  const Program program({"budget", "fifty-bodies", "-q", "--size", "64x48", "--percentile", "50",
                         "--duration", "0.5", "--replays", "2", "--budget", "100000", "--trace", "t.json"});
  ASSERT_EQ(program.wait().code, 0);
  const Json trace = Json::parse(readTextFile(program.folder() / "t.json"), "t.json");
  EXPECT_EQ(trace.at("displayTimeUnit").asString(), "ms");
  std::vector<Json> spans;
  std::map<std::string, int> counts;
  for (const Json& event : trace.at("traceEvents").items()) {
    const std::string kind = event.at("ph").asString();
    ++counts[kind];
    EXPECT_FALSE(event.at("name").asString().empty());
    EXPECT_EQ(event.at("pid").asNumber(), 1.0);
    EXPECT_EQ(event.at("tid").asNumber(), 1.0);
    EXPECT_GE(event.at("ts").asNumber(), 0.0);
    if (kind == "X") {
      EXPECT_GE(event.at("dur").asNumber(), 0.0);
      spans.push_back(event);
    } else if (kind == "C") {
      for (const auto& [name, value] : event.at("args").members()) EXPECT_GE(value.asNumber(), 0.0) << name;
    } else {
      ASSERT_EQ(kind, "M");
      EXPECT_FALSE(event.at("args").at("name").asString().empty());
    }
  }
  EXPECT_EQ(counts["M"], 2);
  EXPECT_EQ(counts["C"], 3 * 30);
  EXPECT_GT(counts["X"], 30 * 5);
  expectNested(std::move(spans));
}

TEST(Budget, ThePhasesOfEveryFrameAddUpToNoMoreThanTheFrame) {
  const ProgramEnd end = runCarom(quick({"--budget", "100000", "--csv", "-"}));
  std::istringstream lines(end.out);
  std::string line;
  std::getline(lines, line);
  int rows = 0;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::vector<double> values;
    for (std::string cell; values.size() < 13 && std::getline(cells, cell, ',');)
      values.push_back(std::stod(cell));
    double sum = 0.0;
    for (std::size_t p = 3; p < 13; ++p) sum += values[p];
    EXPECT_LE(sum, values[2] * (1.0 + 1e-9));
    EXPECT_GT(values[9], 0.0) << "draw takes time";
    ++rows;
  }
  EXPECT_EQ(rows, 20);
}

TEST(Budget, AnotherSubjectEndsWith3AndASlowedPhaseWith1AndIsNamed) {
  const TemporaryFolder folder;
  const std::string old = (folder.path() / "old.json").string();
  ASSERT_EQ(runCarom(quick({"--budget", "100000", "--json", old})).code, 0);
  const ProgramEnd seed = runCarom(quick({"--seed", "99", "--baseline", old}));
  EXPECT_EQ(seed.code, 3);
  expectOnlyOneLine(seed, old + ": is of another content of the scene");

  // The past is made faster by far more than noise: what is measured now has become slower.
  std::string text = readTextFile(old);
  const std::size_t draw = text.find("\"name\": \"draw\"");
  const std::size_t mean = text.find("\"mean\": ", draw);
  text.replace(mean, text.find_first_of(",\n", mean) - mean, "\"mean\": 0.001");
  const std::string faster = folder.file("faster.json", text).string();

  const ProgramEnd slow = judged(quick({"--budget", "100000", "--baseline", faster, "--tolerance", "900%"}));
  const bool told = !isInconclusive(slow);  // else it says of which phase, and what hides it
  if (told) {
    EXPECT_EQ(slow.code, 1) << slow.err;
  }
  EXPECT_NE(slow.out.find(told ? "\nslower: draw, mean " : "\ninconclusive: draw, mean "), std::string::npos)
      << slow.out;
  EXPECT_EQ(slow.out.find("slower: encode"), std::string::npos) << slow.out;

  const ProgramEnd same = judged(quick({"--budget", "100000", "--baseline", old, "--tolerance", "900%"}));
  EXPECT_EQ(same.out.find("\nslower: "), std::string::npos) << same.out;
  if (!isInconclusive(same)) {
    EXPECT_EQ(same.code, 0) << same.out;
    EXPECT_NE(same.out.find("\nno phase is slower than in "), std::string::npos) << same.out;
  }
}

TEST(Budget, BadScenesAndPlacesEndAsEverywhere) {
  EXPECT_EQ(runCarom({"budget", "no-such-scene"}).code, 3);
  EXPECT_EQ(runCarom(quick({"--baseline", "/nonexistent/old.json"})).code, 3);
  const ProgramEnd end = runCarom(quick({"--budget", "100000", "--trace", "/dev/null/t.json"}));
  EXPECT_EQ(end.code, 4);
}

}  // namespace
}  // namespace carom::demos
