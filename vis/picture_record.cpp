#include "vis/picture_record.h"

#include "sim/base/error.h"
#include "vis/renderer.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <array>
#include <charconv>
#include <cstdio>
#include <fcntl.h>
#include <memory>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace sandglass::vis {

namespace fs = std::filesystem;

namespace {

/// What a program prints; nothing when it cannot be started or fails. No shell: names may hold anything.
std::string outputOf(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (auto& word : words)
    arguments.push_back(word.data());
  arguments.push_back(nullptr);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return "";
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  pid_t child = -1;
  const int failed =
      posix_spawnp(&child, words.front().c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  std::string output;
  std::array<char, 4096> buffer{};
  for (ssize_t n = 0; failed == 0 && (n = ::read(ends[0], buffer.data(), buffer.size())) != 0;) {
    if (n < 0 && errno != EINTR) break;
    if (n > 0) output.append(buffer.data(), static_cast<std::size_t>(n));
  }
  ::close(ends[0]);
  int status = 1;
  if (failed == 0)
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
  return status == 0 ? output : "";
}

std::map<std::string, std::string> textOfFilm(const fs::path& file) {
  const std::string comment =
      outputOf({"ffprobe", "-v", "error", "-show_entries", "format_tags=comment", "-of",
                "default=noprint_wrappers=1:nokey=1", fs::absolute(file).string()});
  if (comment.empty())
    throw InputError(
        fmt::format("{}: no record can be read from this film; that takes a film of this program "
                    "and the program ffprobe (package ffmpeg)",
                    file.string()));
  return parseRecordText(comment);
}

fs::path located(const fs::path& source, const PictureRecord& record, const fs::path& picture) {
  std::vector<fs::path> places{source};
  const fs::path folder = fs::absolute(picture).parent_path();
  for (const fs::path& base : {folder, folder.parent_path()}) {
    if (source.is_relative()) places.push_back(base / source);
    fs::path last = source; // "run/" has its name before the slash
    if (!last.has_filename()) last = last.parent_path();
    places.push_back(base / last.filename());
  }
  for (const fs::path& place : places)
    if (fs::exists(place)) return place;
  const auto scene = record.text.find("scene");
  throw InputError(fmt::format(
      "{}: the run that it shows, {}, is missing: neither there nor beside the picture{}; put it back or "
      "give "
      "the run itself",
      picture.string(), source.string(),
      scene == record.text.end() ? "" : fmt::format(" (its scene has the hash {})", scene->second)));
}

} // namespace

bool isPicture(const fs::path& file) {
  return file.extension() == ".png" || file.extension() == ".mp4";
}

std::string recordText(const std::map<std::string, std::string>& text) {
  toml::table table;
  for (const auto& [key, value] : text)
    table.insert(key, value);
  std::ostringstream out;
  out << table << "\n";
  return out.str();
}

std::map<std::string, std::string> parseRecordText(const std::string& text) {
  std::map<std::string, std::string> result;
  try {
    for (const auto& [key, value] : toml::parse(text))
      if (const auto string = value.value<std::string>()) result[std::string(key.str())] = *string;
  } catch (const toml::parse_error&) { // somebody else's comment: no record
  }
  return result;
}

PictureRecord readRecord(const fs::path& file) {
  if (!fs::exists(file)) throw InputError(fmt::format("{}: there is no such file", file.string()));
  PictureRecord record;
  if (file.extension() == ".mp4")
    record.text = textOfFilm(file);
  else
    readPng(file, &record.text);
  for (const char* key : {"source", "view"})
    if (!record.text.contains(key))
      throw InputError(fmt::format("{}: it does not say which {} it shows; only pictures and films that this "
                                   "program has written do",
                                   file.string(), key == std::string("source") ? "run" : "view"));
  record.view = parseView(record.text["view"], file.string() + " (view inside)");
  record.source = record.text["source"];
  if (const auto right = record.text.find("right_source"); right != record.text.end())
    record.rightSource = right->second;
  const std::string& frame = record.text["frame"];
  std::from_chars(frame.data(), frame.data() + frame.size(), record.frame);
  const std::string& time = record.text["time"];
  std::from_chars(time.data(), time.data() + time.size(), record.time);
  return record;
}

View viewFromPicture(const fs::path& file) {
  return readRecord(file).view;
}

fs::path locateSource(const PictureRecord& record, const fs::path& picture) {
  return located(record.source, record, picture);
}

std::optional<fs::path> locateRightSource(const PictureRecord& record, const fs::path& picture) {
  if (record.rightSource.empty()) return std::nullopt;
  return located(record.rightSource, record, picture);
}

} // namespace sandglass::vis
