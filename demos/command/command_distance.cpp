// `carom distance`: closest features, distance or depth of two meshes; one query, or one a line of a file.
#include "demos/command/command.h"

#include <array>
#include <iostream>
#include <limits>
#include <string_view>

#include "demos/command/distance_query.h"
#include "engine/foundation/contract.h"
#include "engine/foundation/input_file.h"

namespace carom::demos {
namespace {

// Two paths of the longest kind and fourteen numbers fit several times over; what is longer is no query.
constexpr std::size_t kLongestLine = 1 << 16;

/// Reads lines into one buffer, so that a batch may be as long as it likes.
class LineReader {
 public:
  explicit LineReader(std::istream& in) : in_(in) {}

  /// False at the end of the input.
  bool next() {
    in_.getline(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    std::size_t length = static_cast<std::size_t>(in_.gcount());
    too_long_ = in_.fail() && length + 1 == buffer_.size();
    if (too_long_) {
      in_.clear();
      in_.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    } else if (in_.fail()) {
      return false;
    }
    if (!in_.eof() && !too_long_) --length;  // the line break is counted but not stored
    line_ = std::string_view(buffer_.data(), length);
    if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
    ++number_;
    return true;
  }
  std::string_view line() const { return line_; }
  int number() const { return number_; }
  bool tooLong() const { return too_long_; }

 private:
  std::istream& in_;
  std::array<char, kLongestLine> buffer_{};
  std::string_view line_;
  int number_ = 0;
  bool too_long_ = false;
};

Json parsedLine(const LineReader& lines, const std::string& origin) {
  const std::string place = origin + ":" + std::to_string(lines.number()) + ": ";
  if (lines.tooLong())
    throw InputError(place + "the line is too long; accepted: at most " + std::to_string(kLongestLine) +
                     " characters");
  if (lines.line().find_first_not_of(" \t") == std::string_view::npos)
    throw InputError(place + "the line is empty; accepted: one JSON object a line");
  return Json::parse(lines.line(), origin, lines.number());
}

/// Each line leaves at once, so that a program at the other end of a pipe can ask and read in turn.
void printLine(const Json& json) {
  std::cout << json.text() << '\n';
  if (!std::cout.flush()) throw CannotWrite("cannot write to standard output");
}

void answerLines(std::istream& in, const std::string& origin, DistanceAnswers& answers) {
  int unanswered = 0;
  LineReader lines(in);
  while (lines.next()) {
    Json out;
    try {
      out = answers.answer(readDistanceQuery(parsedLine(lines, origin)));
    } catch (const InputError& error) {
      out = Json::object({{"error", error.what()}});
      ++unanswered;
    }
    printLine(out);
  }
  if (in.bad()) throw InputError(origin + ": cannot be read to its end");
  if (unanswered > 0)
    throw InputError(origin + ": " + std::to_string(unanswered) + " of " + std::to_string(lines.number()) +
                     " lines could not be answered; each has its \"error\" in the output");
}

void answerBatch(const std::string& batch, DistanceAnswers& answers) {
  if (batch == "-") return answerLines(std::cin, "stdin", answers);
  InputFile file = tryInputFile(batch);
  if (!file.problem.empty())
    throw InputError(batch + ": cannot be read; accepted: a file of JSON lines, or - for standard input");
  answerLines(file.stream, batch, answers);
}

void checkOptions(const DistanceOptions& options) {
  const bool names_a_pose = !options.pose_a.empty() || !options.pose_b.empty();
  if (options.batch.empty()) {
    if (options.mesh_a.empty() || options.mesh_b.empty())
      throw UsageError("distance: accepted: two mesh files A and B, or --batch FILE");
    if (options.cold) throw UsageError("distance: --cold goes with --batch; one query always starts cold");
  } else if (!options.mesh_a.empty() || names_a_pose) {
    throw UsageError("distance: --batch takes meshes and poses from its lines; accepted: no A, B or pose");
  }
}

}  // namespace

ExitCode distance(const DistanceOptions& options) {
  checkOptions(options);
  using Start = DistanceAnswers::Start;
  DistanceAnswers answers(options.cold ? Start::kCold : Start::kTracked);
  if (!options.batch.empty()) {
    answerBatch(options.batch, answers);
    return ExitCode::kOk;
  }
  DistanceQuery query{options.mesh_a, options.mesh_b, {}, {}};
  if (!options.pose_a.empty()) query.X_WA = poseFromText(options.pose_a, "--pose-a");
  if (!options.pose_b.empty()) query.X_WB = poseFromText(options.pose_b, "--pose-b");
  printLine(answers.answer(query));
  return ExitCode::kOk;
}

}  // namespace carom::demos
