// H.264 in MP4 through the ffmpeg program, fed with raw RGB through a pipe.

#include "sim/base/error.h"
#include "vis/picture_record.h"
#include "vis/renderer.h"

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace sandglass::vis {

namespace {

/// Blocks SIGPIPE in this thread while it writes, and swallows the one that a dead ffmpeg raises: a program
/// must not die because its child did.
class PipeSignalBlocked {
public:
  PipeSignalBlocked() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~PipeSignalBlocked() {
    const timespec now{0, 0};
    while (sigtimedwait(&pipe_, nullptr, &now) == SIGPIPE) {
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

private:
  sigset_t pipe_{}, before_{};
};

int roundedToEven(int n) {
  return n - n % 2;
}

} // namespace

struct Movie::Impl {
  std::filesystem::path file;
  int width = 0, height = 0; ///< as encoded: even, which yuv420p demands
  int pipe = -1;
  pid_t child = -1;
  std::vector<std::uint8_t> row;

  ~Impl() { finish(); }

  void start(double framesPerSecond, const std::map<std::string, std::string>& metadata) {
    const std::string comment = recordText(metadata);
    std::vector<std::string> words{"ffmpeg",
                                   "-nostdin",
                                   "-loglevel",
                                   "error",
                                   "-y",
                                   "-f",
                                   "rawvideo",
                                   "-pix_fmt",
                                   "rgb24",
                                   "-s",
                                   fmt::format("{}x{}", width, height),
                                   "-r",
                                   fmt::format("{:.6g}", framesPerSecond),
                                   "-i",
                                   "-",
                                   "-c:v",
                                   "libx264",
                                   "-preset",
                                   "medium",
                                   "-crf",
                                   "18",
                                   "-pix_fmt",
                                   "yuv420p",
                                   "-movflags",
                                   "+faststart",
                                   "-metadata",
                                   "comment=" + comment,
                                   "-f",
                                   "mp4",
                                   file.string()};
    std::vector<char*> arguments;
    for (auto& word : words)
      arguments.push_back(word.data());
    arguments.push_back(nullptr);

    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
      throw Error(fmt::format("{}: no pipe to ffmpeg: {}.", file.string(), std::strerror(errno)));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    const int failed = posix_spawnp(&child, "ffmpeg", &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[0]);
    pipe = ends[1];
    if (failed != 0) {
      child = -1;
      throw Error(
          fmt::format("{}: the movie needs the program ffmpeg, which cannot be started ({}); install the "
                      "package ffmpeg or write pictures only.",
                      file.string(), std::strerror(failed)));
    }
  }

  void write(const std::uint8_t* data, std::size_t size) {
    while (size > 0) {
      const ssize_t written = ::write(pipe, data, size);
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) {
        finish();
        throw Error(fmt::format("{}: ffmpeg stopped before the movie was complete; its own message is above.",
                                file.string()));
      }
      data += written;
      size -= static_cast<std::size_t>(written);
    }
  }

  /// Exit status of ffmpeg, 0 when it has been waited for already.
  int finish() {
    if (pipe >= 0) ::close(pipe);
    pipe = -1;
    int status = 0;
    if (child > 0)
      while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
      }
    child = -1;
    return status;
  }
};

Movie::Movie(const std::filesystem::path& file, int width, int height, double framesPerSecond,
             const std::map<std::string, std::string>& metadata)
    : impl_(std::make_unique<Impl>()) {
  if (width < 2 || height < 2 || !(framesPerSecond > 0))
    throw InputError(fmt::format(
        "{}: a movie of {} x {} pixels at {:g} frames a second is not possible; give at least 2 x 2 "
        "and a positive rate",
        file.string(), width, height, framesPerSecond));
  impl_->file = file;
  impl_->width = roundedToEven(width);
  impl_->height = roundedToEven(height);
  impl_->start(framesPerSecond, metadata);
}

Movie::~Movie() = default;

void Movie::add(const Image& image) {
  Impl& d = *impl_;
  if (d.pipe < 0)
    throw Error(fmt::format("{}: the movie is closed, no picture can be added.", d.file.string()));
  if (roundedToEven(image.width) != d.width || roundedToEven(image.height) != d.height)
    throw Error(fmt::format("{}: a picture of {} x {} pixels does not fit into a movie of {} x {}.",
                            d.file.string(), image.width, image.height, d.width, d.height));
  const PipeSignalBlocked blocked;
  d.row.resize(static_cast<std::size_t>(d.width) * 3);
  for (int y = 0; y < d.height; ++y) {
    const std::uint8_t* pixel =
        image.rgba.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) * 4;
    for (int x = 0; x < d.width; ++x, pixel += 4)
      for (int k = 0; k < 3; ++k) // what is transparent lies on white
        d.row[static_cast<std::size_t>(3 * x + k)] =
            static_cast<std::uint8_t>((pixel[k] * pixel[3] + 255 * (255 - pixel[3])) / 255);
    d.write(d.row.data(), d.row.size());
  }
}

void Movie::close() {
  if (impl_->child <= 0) return;
  const int status = impl_->finish();
  if (status != 0)
    throw Error(fmt::format("{}: ffmpeg could not complete the movie; its own message is above.",
                            impl_->file.string()));
}

} // namespace sandglass::vis
