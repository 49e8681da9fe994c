#include "demos/video/ffmpeg_video.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "demos/format/json.h"
#include "demos/system/exit_code.h"

namespace carom::demos {
namespace fs = std::filesystem;
namespace {

constexpr const char* kProgram = "ffmpeg";

bool onPath(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "/usr/bin:/bin" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((fs::path(folder) / program).c_str(), X_OK) == 0) return true;
  return false;
}

/// How the frames become what the name's ending says. A GIF has a palette of its own frames' colours and
/// loops, as does WebP; players of video want colour at half the size, and so even sides.
std::vector<std::string> codingWords(const std::string& ending) {
  if (ending == ".gif")
    return {"-filter_complex", "split[a][b];[a]palettegen=stats_mode=diff[p];[b][p]paletteuse=dither=bayer",
            "-loop", "0"};
  if (ending == ".webp") return {"-lossless", "0", "-quality", "80", "-loop", "0"};
  return {"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"};
}

}  // namespace

FfmpegVideo::FfmpegVideo(const fs::path& path, const VideoShape& shape) : path_(path) {
  if (!onPath(kProgram))
    fail(
        "this needs the program ffmpeg, which is not installed (apt-get install ffmpeg); a name that ends in "
        ".apng "
        "needs none");
  if (!path.has_extension()) fail("accepted: a name with the ending of a video, such as out.mp4");
  std::error_code failed;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), failed);
  if (failed) fail(failed.message());
  // ffmpeg chooses the format by the ending.
  temporary_.emplace(path, TemporaryFile::Ending::kOfTarget);
  if (temporary_->descriptor() < 0) fail(std::strerror(errno));
  complaints_.reset(std::tmpfile());
  std::array<int, 2> pipe{};
  if (!complaints_ || ::pipe2(pipe.data(), O_CLOEXEC) != 0) fail(std::strerror(errno));
  input_ = pipe[1];
  child_ = ::fork();
  if (child_ == 0) runFfmpeg(shape, pipe[0]);
  const int reason = errno;
  ::close(pipe[0]);
  if (child_ < 0) fail(std::strerror(reason));
  pipe_.emplace(input_, kProgram);
}

void FfmpegVideo::runFfmpeg(const VideoShape& shape, int input) const {
  const std::string size = std::to_string(shape.width) + "x" + std::to_string(shape.height);
  const std::string rate = Json(shape.fps).text();  // the same bits when read back
  std::vector<std::string> words{kProgram,     "-nostdin", "-xerror",  "-loglevel", "error", "-y",
                                 "-f",         "rawvideo", "-pix_fmt", "rgb24",     "-s",    size,
                                 "-framerate", rate,       "-i",       "pipe:0"};
  const std::vector<std::string> coding = codingWords(path_.extension().string());
  words.insert(words.end(), coding.begin(), coding.end());
  words.push_back(fs::absolute(temporary_->path()).string());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  // A group of its own: an interrupt at the terminal is for this program, which then ends ffmpeg.
  ::setpgid(0, 0);
  std::signal(SIGPIPE, SIG_DFL);
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  const int said = ::fileno(complaints_.get());
  if (::dup2(input, 0) == 0 && ::dup2(said, 1) == 1 && ::dup2(said, 2) == 2) ::execvp(argv[0], argv.data());
  ::_exit(127);
}

FfmpegVideo::~FfmpegVideo() {
  if (child_ > 0) {
    ::kill(child_, SIGKILL);
    endInput();
  }
  if (input_ >= 0) ::close(input_);
}

/// Closes its input and waits; its exit code, or 128 + the signal that ended it.
int FfmpegVideo::endInput() {
  ::close(input_);
  input_ = -1;
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string FfmpegVideo::lastComplaint() const {
  std::string last, line;
  std::rewind(complaints_.get());
  for (int c = std::fgetc(complaints_.get()); c != EOF; c = std::fgetc(complaints_.get())) {
    if (c == '\n' && !line.empty()) last = line;
    if (c == '\n')
      line.clear();
    else if (c >= ' ')
      line.push_back(static_cast<char>(c));
  }
  return line.empty() ? last : line;
}

void FfmpegVideo::write(std::span<const std::uint8_t> rgb) {
  try {
    pipe_->write(rgb);
  } catch (const PipeClosed&) {
    const int code = endInput();
    failAfter(code);
  }
}

void FfmpegVideo::commit() {
  const int code = endInput();
  // Of a disk that is full, ffmpeg may only complain.
  if (code != 0 || !lastComplaint().empty()) failAfter(code);
  const std::error_code failed = temporary_->renameTo(path_);
  if (failed) fail(failed.message());
}

void FfmpegVideo::failAfter(int code) const {
  const std::string said = lastComplaint();
  fail("ffmpeg ended with code " + std::to_string(code) + (said.empty() ? "" : ": " + said));
}

void FfmpegVideo::fail(const std::string& reason) const {
  throw CannotWrite("cannot write " + path_.string() + ": " + reason);
}

}  // namespace carom::demos
