#include "app/cli/render_work.h"

#include "app/cli/console.h"
#include "app/cli/render_sources.h"
#include "sim/base/error.h"
#include "vis/coarse_fields.h"
#include "vis/difference_picture.h"
#include "vis/fit.h"
#include "vis/readers/vti_field.h"
#include "vis/survey.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <utility>

namespace sandglass::cli {

namespace {

namespace fs = std::filesystem;

/// One picture to draw; of a pair `right` is the other half.
struct Task {
  const RenderSource* source = nullptr;
  std::size_t frame = 0;
  const RenderSource* right = nullptr;
  std::size_t rightFrame = 0;
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

/// frame_00012.png; with several sources their names stand in front.
std::vector<Task> tasksFor(const RenderOptions& options, const std::vector<RenderSource>& sources) {
  std::vector<Task> tasks;
  const bool pair = !options.sideBySide.empty();
  for (const RenderSource& source : sources) {
    std::vector<double> times(source.frames->size());
    for (std::size_t k = 0; k < times.size(); ++k)
      times[k] = source.frames->time(k);
    const std::vector<std::size_t> chosen =
        source.only ? std::vector{*source.only} : chosenFrames(options, times, source.frames->name());
    for (const std::size_t k : chosen) {
      Task task{&source, k, nullptr, 0, {}};
      if (pair) {
        task.right = &sources[1];
        task.rightFrame = nearestFrame(*sources[1].frames, times[k]);
      }
      if (!options.folder.empty())
        task.file = fs::path(options.folder) / fmt::format("{}_{:05}.png", pair ? "pair" : source.stem, k);
      tasks.push_back(task);
    }
    if (pair) break; // the second run follows the first
  }
  return tasks;
}

std::map<std::string, std::string> textOf(const Frame& frame, const vis::View& view, const Task& task) {
  std::map<std::string, std::string> text = frame.provenance;
  text["Software"] = "Sandglass";
  text["view"] = vis::writeView(view);
  text["source"] = task.source->frames->name();
  text["frame"] = fmt::format("{}", task.frame);
  text["time"] = fmt::format("{:.17g}", frame.time);
  if (task.right) {
    text["right_source"] = task.right->frames->name();
    text["right_frame"] = fmt::format("{}", task.rightFrame);
  }
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

/// The view of the options; of a picture that is drawn again its own, with the options laid over it.
vis::View commonView(const RenderOptions& options, const std::vector<RenderSource>& sources,
                     const std::vector<Task>& tasks) {
  const bool own = options.viewFile.empty() && sources.front().view;
  vis::View view = own ? viewOf(options, *sources.front().view) : viewOf(options);
  if (options.colour.empty() && options.viewFile.empty() && !own) { // the default quantity need not be there
    const FramePtr first = tasks.front().source->frames->load(tasks.front().frame);
    if (first->size() > 0 && !first->has(quantity::velocity)) view.colouring.quantity.clear();
  }
  return view;
}

/// What pictures of several frames share: the colours and the camera of a film must mean the same from one
/// picture to the next.
void shareRangeAndCamera(const RenderOptions& options, const std::vector<RenderSource>& sources,
                         const std::vector<Task>& tasks, vis::View& view) {
  const bool pair = !options.sideBySide.empty();
  const bool given = !options.range.empty() || !options.viewFile.empty() || sources.front().view;
  const bool filmRange = !given && (!options.movie.empty() || pair);
  if (filmRange) view.colouring.range = vis::ColourRange::run;
  const auto original = vis::originalAxis(view.colouring.quantity);
  const bool wantsRange = view.colouring.range == vis::ColourRange::run && !view.colouring.quantity.empty() &&
                          !sources.front().view;
  const bool wantsCamera = !view.camera.preset.empty() && (tasks.size() > 1 || pair);
  if (wantsRange && original) { // known from the one frame that they are the originals of
    const auto [low, high] = sources.front().history->originalRange(*original);
    view.colouring.low = low;
    view.colouring.high = high;
  }
  const bool reads = wantsRange && !original;
  if (!reads && !wantsCamera) return;
  std::vector<const FrameSource*> all;
  std::size_t frames = 0;
  for (const auto& source : sources)
    all.push_back(source.frames.get()), frames += source.frames->size();
  Countdown scan("reading", frames);
  const vis::Survey found = vis::survey(all, reads ? view.colouring.quantity : "", [&] { scan.step(); });
  if (reads) {
    const auto [low, high] = filmRange ? found.lastStage : found.run;
    view.colouring.low = low;
    view.colouring.high = high;
  }
  if (!wantsCamera) return;
  vis::View fitted = view;
  if (pair) fitted.width = view.width / 2;
  view.camera = vis::fitCamera(*tasks.back().source->frames->load(tasks.back().frame), fitted, found.grains);
}

/// Loads frames and draws them with what all pictures share.
class Draughtsman {
public:
  Draughtsman(const RenderOptions& options, vis::View view)
      : renderer_(backendOf(options.backend)), view_(std::move(view)), turn_(options.turn) {
    if (!options.field.empty()) field_ = vis::readVtiField(options.field);
    throughMiddle_ = options.viewFile.empty() && (field_ || !options.slice.empty());
  }

  struct Drawn {
    vis::Image image;
    std::map<std::string, std::string> text;
  };
  Drawn draw(const Task& task) {
    const FramePtr frame = load(*task.source, task.frame);
    if (std::exchange(throughMiddle_, false) && !frame->fields.empty())
      showThroughMiddle(frame->fields.front());
    vis::View view = view_;
    if (turn_ != 0 && count_ > 0) {
      if (!view.camera.preset.empty()) view.camera = firstCamera_;
      view.camera = vis::orbit(view.camera, turn_ * count_, 0);
    }
    Drawn drawn;
    if (task.right) {
      drawn.image = renderer_.drawPair(*frame, *load(*task.right, task.rightFrame), view, view,
                                       task.source->history, task.right->history);
    } else {
      renderer_.setHistory(task.source->history);
      drawn.image = renderer_.draw(*frame, view);
    }
    if (count_++ == 0) firstCamera_ = renderer_.resolvedCamera();
    drawn.text = textOf(*frame, view, task);
    return drawn;
  }

private:
  /// The slice across the field's shortest side, and no grains in front of it.
  void showThroughMiddle(const FrameField& field) {
    const Vec3 size =
        field.spacing.cwiseProduct(Vec3(field.points[0] - 1, field.points[1] - 1, field.points[2] - 1));
    Eigen::Index shortest = 0;
    size.minCoeff(&shortest);
    view_.slice.point = field.origin + size / 2;
    view_.slice.normal = Vec3::Unit(shortest);
    view_.grains = false;
  }

  FramePtr load(const RenderSource& source, std::size_t index) const {
    FramePtr frame = source.frames->load(index);
    if (!field_) return view_.slice.shown ? vis::withFields(frame) : frame;
    auto with = std::make_shared<Frame>(*frame);
    with->fields.push_back(*field_);
    return with;
  }

  vis::Renderer renderer_;
  vis::View view_;
  bool throughMiddle_ = false; ///< the first picture places the slice
  double turn_ = 0;            ///< [deg] a picture
  int count_ = 0;
  vis::Camera firstCamera_;
  std::optional<FrameField> field_;
};

/// Sources as the options name them, with what their pictures need to know of other frames.
std::vector<RenderSource> sourcesOf(const RenderOptions& options) {
  if (options.folder.empty() && options.movie.empty() && options.reference.empty())
    throw InputError(
        "nothing to write: give a folder with -o, a film with --movie or a picture with --reference");
  if (options.sources.empty() == options.sideBySide.empty())
    throw InputError("nothing to draw: name runs or files, or two of them with --side-by-side");
  return openSources(options.sideBySide.empty() ? options.sources : options.sideBySide, options.import);
}

} // namespace

int render(const RenderOptions& options) {
  viewOf(options); // faults of the options before files are opened
  std::vector<RenderSource> sources = sourcesOf(options);
  const std::vector<Task> tasks = tasksFor(options, sources);
  if (!options.reference.empty() && tasks.size() != 1)
    throw InputError(
        fmt::format("--reference compares one picture and {} are asked for; choose one with --at or --frames",
                    tasks.size()));
  if (!options.folder.empty()) fs::create_directories(options.folder);
  vis::View view = commonView(options, sources, tasks);
  if (vis::needsHistory(view))
    for (RenderSource& source : sources)
      source.history = std::make_shared<const vis::History>(vis::historyOf(*source.frames, view));
  shareRangeAndCamera(options, sources, tasks, view);

  Draughtsman draughtsman(options, view);
  std::unique_ptr<vis::Movie> movie;
  Countdown countdown("rendering", tasks.size());
  int result = 0;
  for (const Task& task : tasks) {
    const auto [image, text] = draughtsman.draw(task);
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

} // namespace sandglass::cli
