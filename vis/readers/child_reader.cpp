#include "vis/readers/child_reader.h"

#include "sim/base/error.h"
#include "vis/readers/vti_field.h"
#include "vis/readers/vtk_frame.h"
#include "vis/readers/vtp_mesh.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace sandglass::vis {

namespace {

namespace fs = std::filesystem;

constexpr const char *meshWord = "--read-vtp-for-parent", *frameWord = "--read-vtk-frame-for-parent",
                     *flowWord = "--read-vti-for-parent";
constexpr char meshMark = 'M', frameMark = 'G', flowMark = 'W', faultMark = 'F';

void sendAll(const void* data, std::size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t sent = ::write(STDOUT_FILENO, at, size);
    if (sent <= 0) ::_exit(3); // the parent has gone or has had enough
    at += sent;
    size -= static_cast<std::size_t>(sent);
  }
}

/// 'M', number of points and of triangles, then both; or 'F' and a sentence.
void answer(const TriangleMesh& mesh) {
  const std::uint64_t counts[] = {mesh.points.size(), mesh.triangles.size()};
  sendAll(&meshMark, 1);
  sendAll(counts, sizeof counts);
  sendAll(mesh.points.data(), mesh.points.size() * sizeof(Vec3));
  sendAll(mesh.triangles.data(), mesh.triangles.size() * sizeof(mesh.triangles[0]));
}

/// 'G', time (NaN: none), number of columns and of rows; for each column the length of its name, the name and
/// the numbers.
void answer(const RawFrame& frame) {
  const double time = frame.time.value_or(std::numeric_limits<double>::quiet_NaN());
  const std::uint64_t counts[] = {frame.columns.size(), frame.rows};
  sendAll(&frameMark, 1);
  sendAll(&time, sizeof time);
  sendAll(counts, sizeof counts);
  for (const auto& column : frame.columns) {
    const std::uint64_t length = column.name.size();
    sendAll(&length, sizeof length);
    sendAll(column.name.data(), length);
    sendAll(column.numbers.data(), column.numbers.size() * sizeof(double));
  }
}

/// 'W', points, origin, spacing, number of arrays; for each the length of its name, the name and the vectors.
void answer(const FrameField& field) {
  const std::uint64_t arrays = field.vectors.size();
  sendAll(&flowMark, 1);
  sendAll(field.points.data(), sizeof field.points);
  sendAll(field.origin.data(), sizeof field.origin);
  sendAll(field.spacing.data(), sizeof field.spacing);
  sendAll(&arrays, sizeof arrays);
  for (const auto& [name, vectors] : field.vectors) {
    const std::uint64_t length = name.size();
    sendAll(&length, sizeof length);
    sendAll(name.data(), length);
    sendAll(vectors.data(), vectors.size() * sizeof(Vec3));
  }
}

class Child {
public:
  Child(const fs::path& program, const std::vector<std::string>& arguments) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw RunError("no pipe can be made for the reader of a file");
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    std::vector<char*> argv;
    for (const std::string& a : arguments)
      argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);
    const int failed = ::posix_spawn(&pid_, program.c_str(), &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    from_ = ends[0];
    if (failed == 0) return;
    ::close(from_);
    throw RunError(fmt::format("the reader '{}' cannot be started", program.string()));
  }
  ~Child() {
    ::close(from_);
    if (!ended_) {
      ::kill(pid_, SIGKILL);
      ::waitpid(pid_, nullptr, 0);
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// All that it says; stops at the limits, and `complete` tells whether it did not.
  std::string listen(const ReaderLimits& limits, bool& complete) {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::seconds(limits.wallSeconds);
    std::string said;
    std::vector<char> buffer(std::size_t{1} << 16);
    for (complete = false; said.size() <= limits.answer;) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
      pollfd waiting{from_, POLLIN, 0};
      if (left <= 0 || ::poll(&waiting, 1, static_cast<int>(left)) == 0) return said;
      const ssize_t got = ::read(from_, buffer.data(), buffer.size());
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) {
        complete = true;
        return said;
      }
      said.append(buffer.data(), static_cast<std::size_t>(got));
    }
    return said;
  }
  int wait() {
    int status = 0;
    ::waitpid(pid_, &status, 0);
    ended_ = true;
    return status;
  }

private:
  pid_t pid_ = -1;
  int from_ = -1;
  bool ended_ = false;
};

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
  throw InputError(fmt::format("{}: {}", file.string(), why));
}

TriangleMesh checkedMesh(const fs::path& file, const std::string& said) {
  TriangleMesh mesh;
  std::uint64_t counts[2] = {};
  const std::size_t head = 1 + sizeof counts;
  if (said.size() >= head) std::memcpy(counts, said.data() + 1, sizeof counts);
  constexpr std::size_t onePoint = sizeof(Vec3), oneTriangle = sizeof(mesh.triangles[0]);
  if (said.size() < head || counts[0] > said.size() / onePoint || counts[1] > said.size() / oneTriangle ||
      said.size() != head + counts[0] * onePoint + counts[1] * oneTriangle)
    refuse(file, "what its reader sent back is no mesh; check the file");
  mesh.points.resize(counts[0]);
  mesh.triangles.resize(counts[1]);
  std::memcpy(static_cast<void*>(mesh.points.data()), said.data() + head, counts[0] * onePoint);
  std::memcpy(mesh.triangles.data(), said.data() + head + counts[0] * onePoint, counts[1] * oneTriangle);
  for (const Vec3& p : mesh.points)
    if (!p.allFinite()) refuse(file, "a point of it is not a number; check the file");
  for (const auto& triangle : mesh.triangles)
    for (const int corner : triangle)
      if (corner < 0 || static_cast<std::uint64_t>(corner) >= counts[0])
        refuse(file, fmt::format("a triangle of it names point {} of {}; check the file", corner, counts[0]));
  return mesh;
}

/// Cuts values from what a child said; everything beyond the end is a fault.
class Answer {
public:
  Answer(const fs::path& file, std::string_view rest) : file_(file), rest_(rest) {}
  void copy(void* to, std::uint64_t size) {
    if (size > rest_.size()) refuse(file_, "what its reader sent back is no frame; check the file");
    if (size > 0) std::memcpy(to, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  template <class T> T take() {
    T value;
    copy(&value, sizeof value);
    return value;
  }
  std::size_t left() const { return rest_.size(); }

private:
  const fs::path& file_;
  std::string_view rest_;
};

RawFrame checkedFrame(const fs::path& file, const std::string& said) {
  Answer answer(file, std::string_view(said).substr(1));
  RawFrame frame;
  if (const double time = answer.take<double>(); std::isfinite(time)) frame.time = time;
  const auto columns = answer.take<std::uint64_t>(), rows = answer.take<std::uint64_t>();
  if (rows > answer.left() / sizeof(double) || columns > answer.left() / sizeof(std::uint64_t))
    refuse(file, "what its reader sent back is no frame; check the file");
  frame.rows = rows;
  for (std::uint64_t c = 0; c < columns; ++c) {
    const auto length = answer.take<std::uint64_t>();
    if (length > answer.left()) refuse(file, "what its reader sent back is no frame; check the file");
    RawColumn column{std::string(length, '\0'), std::vector<double>(rows), {}};
    answer.copy(column.name.data(), length);
    answer.copy(column.numbers.data(), rows * sizeof(double));
    frame.columns.push_back(std::move(column));
  }
  if (answer.left() > 0) refuse(file, "what its reader sent back is no frame; check the file");
  return frame;
}

FrameField checkedFlow(const fs::path& file, const std::string& said) {
  Answer answer(file, std::string_view(said).substr(1));
  const auto wrong = [&] { refuse(file, "what its reader sent back is no grid; check the file"); };
  FrameField field;
  field.points = answer.take<std::array<int, 3>>();
  field.origin = answer.take<Vec3>();
  field.spacing = answer.take<Vec3>();
  double size = 1;
  for (const int count : field.points) {
    if (count < 1) wrong();
    size *= count;
  }
  const auto arrays = answer.take<std::uint64_t>();
  for (std::uint64_t a = 0; a < arrays; ++a) {
    const auto length = answer.take<std::uint64_t>();
    if (length > answer.left()) wrong();
    std::string name(length, '\0');
    answer.copy(name.data(), length);
    if (size > static_cast<double>(answer.left() / sizeof(Vec3))) wrong();
    std::vector<Vec3>& vectors = field.vectors[name];
    vectors.resize(field.size());
    answer.copy(vectors.data(), field.size() * sizeof(Vec3));
  }
  if (answer.left() > 0) wrong();
  return field;
}

/// Starts a child with that word and hands back what it says after `mark`.
std::string saidApart(const fs::path& file, const ReaderLimits& limits, const fs::path& program,
                      const char* word, char mark) {
  if (!fs::is_regular_file(file)) refuse(file, "the file cannot be opened; check its name");
  Child child(
      program.empty() ? "/proc/self/exe" : program,
      {"sandglass", word, file.string(), std::to_string(limits.memory), std::to_string(limits.cpuSeconds)});
  bool complete = false;
  std::string said = child.listen(limits, complete);
  if (!complete)
    refuse(file,
           fmt::format("its reader took longer than {} s or sent more than {:.3g} MB and was stopped; check "
                       "the file",
                       limits.wallSeconds, static_cast<double>(limits.answer) / 1e6));
  const int status = child.wait();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && !said.empty()) {
    if (said[0] == faultMark) throw InputError(said.substr(1));
    if (said[0] == mark) return said;
  }
  refuse(file, fmt::format(
                   "its reader gave up: the file is damaged, or needs more than {:.1f} GB of memory or {} s",
                   static_cast<double>(limits.memory) / 1e9, limits.cpuSeconds));
}

} // namespace

bool serveAsReader(int argc, char** argv, int& code) {
  const bool mesh = argc == 5 && std::strcmp(argv[1], meshWord) == 0,
             frame = argc == 5 && std::strcmp(argv[1], frameWord) == 0,
             flow = argc == 5 && std::strcmp(argv[1], flowWord) == 0;
  if (!mesh && !frame && !flow) return false;
  const auto limit = [](auto resource, const char* text) {
    const rlim_t value = std::strtoull(text, nullptr, 10);
    const rlimit both{value, value};
    ::setrlimit(resource, &both);
  };
  limit(RLIMIT_AS, argv[3]);
  limit(RLIMIT_CPU, argv[4]);
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  code = 0;
  try {
    if (mesh)
      answer(readVtpMesh(argv[2]));
    else if (flow)
      answer(readVtiField(argv[2]));
    else
      answer(readVtkFrame(argv[2]));
  } catch (const std::bad_alloc&) {
    code = 4;
  } catch (const std::exception& fault) {
    sendAll(&faultMark, 1);
    sendAll(fault.what(), std::strlen(fault.what()));
  }
  return true;
}

TriangleMesh readVtpApart(const fs::path& file, const ReaderLimits& limits, const fs::path& program) {
  return checkedMesh(file, saidApart(file, limits, program, meshWord, meshMark));
}

FrameField readVtiApart(const fs::path& file, const ReaderLimits& limits, const fs::path& program) {
  return checkedFlow(file, saidApart(file, limits, program, flowWord, flowMark));
}

RawFrame readVtkApart(const fs::path& file, const ReaderLimits& limits, const fs::path& program) {
  return checkedFrame(file, saidApart(file, limits, program, frameWord, frameMark));
}

} // namespace sandglass::vis
