// sandglass render: frames to pictures and films, no display.

#include "app/cli/commands.h"
#include "app/cli/console.h"
#include "app/cli/render_options.h"
#include "sim/base/error.h"
#include "sim/io/run_folder.h"
#include "vis/difference_picture.h"
#include "vis/fit.h"
#include "vis/survey.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

namespace sandglass::cli {

namespace {

namespace fs = std::filesystem;

/// One picture to draw.
struct Task {
  const FrameSource* source = nullptr;
  std::size_t frame = 0;
  fs::path file; ///< empty: for the movie alone
};

/// Time left from what the work has taken so far.
class Countdown {
public:
  Countdown(const std::string& what, std::size_t total) : bar_(what), total_(total) {}
  void step(const std::string& detail = "") {
    ++done_;
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
    const auto left = static_cast<double>(total_ - done_) / static_cast<double>(done_) * spent.count();
    bar_.update(static_cast<double>(done_) / static_cast<double>(total_), left, detail);
  }

private:
  ProgressBar bar_;
  std::size_t total_, done_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::vector<std::unique_ptr<FrameSource>> openAll(const std::vector<std::string>& paths) {
  std::vector<std::unique_ptr<FrameSource>> sources;
  std::vector<std::string> faults;
  for (const auto& path : paths)
    try {
      sources.push_back(openFrames(path));
    } catch (const InputError& e) {
      faults.insert(faults.end(), e.sentences().begin(), e.sentences().end());
    }
  if (!faults.empty()) throw InputError(std::move(faults));
  return sources;
}

/// frame_00012.png; with several sources their names stand in front.
std::vector<Task> tasksFor(const RenderOptions& options,
                           const std::vector<std::unique_ptr<FrameSource>>& sources) {
  std::vector<Task> tasks;
  for (const auto& source : sources) {
    std::vector<double> times(source->size());
    for (std::size_t k = 0; k < times.size(); ++k)
      times[k] = source->time(k);
    fs::path given = source->name();
    if (!given.has_filename()) given = given.parent_path(); // "run/"
    const std::string stem = sources.size() > 1 ? given.stem().string() : "frame";
    for (const std::size_t k : chosenFrames(options, times, source->name()))
      tasks.push_back({source.get(), k,
                       options.folder.empty()
                           ? fs::path()
                           : fs::path(options.folder) / fmt::format("{}_{:05}.png", stem, k)});
  }
  return tasks;
}

std::map<std::string, std::string> textOf(const Frame& frame, const vis::View& view, const Task& task) {
  std::map<std::string, std::string> text = frame.provenance;
  text["Software"] = "Sandglass";
  text["view"] = vis::writeView(view);
  text["source"] = task.source->name();
  text["frame"] = fmt::format("{}", task.frame);
  text["time"] = fmt::format("{:.17g}", frame.time);
  return text;
}

/// 0 when the picture is like the reference, else 1 with a picture of the difference.
int compare(const vis::Image& image, const RenderOptions& options) {
  const vis::Image reference = vis::readPng(options.reference);
  const double share = vis::difference(image, reference);
  if (share <= options.threshold) {
    fmt::print("{}: {:.4f} % of the pixels differ, the threshold is {:.4f} %.\n", options.reference,
               100 * share, 100 * options.threshold);
    return 0;
  }
  const fs::path file = fs::path(options.folder.empty() ? "." : options.folder) / "difference.png";
  vis::writePng(vis::differencePicture(image, reference), file, {{"reference", options.reference}});
  fmt::print(stderr, "{}: {:.4f} % of the pixels differ, the threshold is {:.4f} %; see {}.\n",
             options.reference, 100 * share, 100 * options.threshold, file.string());
  return 1;
}

int render(const RenderOptions& options) {
  if (options.folder.empty() && options.movie.empty() && options.reference.empty())
    throw InputError(
        "nothing to write: give a folder with -o, a film with --movie or a picture with --reference");
  vis::View view = viewOf(options);
  const auto sources = openAll(options.sources);
  const std::vector<Task> tasks = tasksFor(options, sources);
  if (!options.reference.empty() && tasks.size() != 1)
    throw InputError(
        fmt::format("--reference compares one picture and {} are asked for; choose one with --at or --frames",
                    tasks.size()));
  if (!options.folder.empty()) fs::create_directories(options.folder);
  if (options.colour.empty() && options.viewFile.empty()) { // the default quantity need not be there
    const FramePtr first = tasks.front().source->load(tasks.front().frame);
    if (first->size() > 0 && !first->has(quantity::velocity)) view.colouring.quantity.clear();
  }

  // The colours of a film must mean the same from one picture to the next.
  const bool filmRange = options.range.empty() && options.viewFile.empty() && !options.movie.empty();
  if (filmRange) view.colouring.range = vis::ColourRange::run;
  const bool wantsRange = view.colouring.range == vis::ColourRange::run && !view.colouring.quantity.empty();
  const bool wantsCamera = !view.camera.preset.empty() && tasks.size() > 1;
  if (wantsRange || wantsCamera) {
    std::vector<const FrameSource*> all;
    std::size_t frames = 0;
    for (const auto& source : sources)
      all.push_back(source.get()), frames += source->size();
    Countdown scan("reading", frames);
    const vis::Survey found =
        vis::survey(all, wantsRange ? view.colouring.quantity : "", [&] { scan.step(); });
    if (wantsRange) {
      const auto [low, high] = filmRange ? found.lastStage : found.run;
      view.colouring.low = low;
      view.colouring.high = high;
    }
    if (wantsCamera)
      view.camera = vis::fitCamera(*tasks.back().source->load(tasks.back().frame), view, found.grains);
  }

  vis::Renderer renderer(backendOf(options.backend));
  std::unique_ptr<vis::Movie> movie;
  Countdown countdown("rendering", tasks.size());
  int result = 0;
  for (const Task& task : tasks) {
    const FramePtr frame = task.source->load(task.frame);
    const vis::Image image = renderer.draw(*frame, view);
    const auto text = textOf(*frame, view, task);
    if (!task.file.empty()) vis::writePng(image, task.file, text);
    if (!options.movie.empty()) {
      if (!movie)
        movie = std::make_unique<vis::Movie>(options.movie, image.width, image.height,
                                             options.framesPerSecond, text);
      movie->add(image);
    }
    if (!options.reference.empty()) result = compare(image, options);
    countdown.step(fmt::format("frame {}", task.frame));
  }
  if (movie) movie->close();
  if (!options.folder.empty())
    fmt::print("{} picture{} in {}\n", tasks.size(), tasks.size() == 1 ? "" : "s", options.folder);
  if (movie) fmt::print("film of {} frames in {}\n", tasks.size(), options.movie);
  return result;
}

} // namespace

void addRender(CLI::App& app, Action& action) {
  auto options = std::make_shared<RenderOptions>();
  RenderOptions& o = *options;
  CLI::App* command =
      app.add_subcommand("render", "draw frames of runs or files as pictures or a film; needs no display");
  command->add_option("source", o.sources, "run folders or frame files")->required()->type_name("RUN|FILE");
  command->add_option("-o,--output", o.folder, "folder for the pictures, frame_00012.png")->type_name("DIR");
  command->add_option("--movie", o.movie, "H.264 film of the frames")->type_name("FILE.mp4");
  command->add_option("--fps", o.framesPerSecond, "pictures a second in the film")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  command->add_option("--view", o.viewFile, "view file (TOML); the options below go before it")
      ->type_name("FILE");
  command->add_option("--camera", o.camera, "fit, front, back, left, right, top, bottom or iso")
      ->type_name("PRESET");
  command->add_flag("--orthographic", o.orthographic, "no perspective");
  command
      ->add_option("--colour,--color", o.colour,
                   "quantity: speed, radius, z, |spin|, velocity.z, species, ..., none")
      ->type_name("QUANTITY");
  command->add_option("--map", o.map, fmt::format("colour map: {}", fmt::join(vis::colourMaps(), ", ")))
      ->type_name("NAME");
  command
      ->add_option("--range", o.range,
                   "colour range: frame, run or LOW:HIGH (default: the last stage's for a film, else frame)")
      ->type_name("RANGE");
  command->add_option("--clip", o.clips, "side to keep, such as y<0; may be repeated")
      ->type_name("PLANE")
      ->allow_extra_args(false);
  command->add_option("--size", o.size, "pixels (default 1280x720)")->type_name("WxH");
  command->add_flag("--transparent", o.transparent, "transparent ground");
  command->add_option("--frames", o.frames, "indices, both ends drawn: 10:20, 10:, :20 or 10")
      ->type_name("A:B");
  command->add_option("--every", o.every, "only each N-th frame")->check(CLI::PositiveNumber)->type_name("N");
  command->add_option("--at", o.at, "the one frame nearest to this time [s]")->type_name("TIME");
  command->add_option("--gl", o.backend, "who draws")
      ->check(CLI::IsMember({"osmesa", "egl", "auto"}))
      ->capture_default_str();
  command
      ->add_option("--reference", o.reference,
                   "picture to compare with; returns 1 and writes difference.png when unlike")
      ->type_name("PNG");
  command->add_option("--threshold", o.threshold, "share of pixels that may differ by more than 8 of 255")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command->callback([options, &action] { action = [options] { return render(*options); }; });
}

} // namespace sandglass::cli
