// sandglass render: its options.

#include "app/cli/commands.h"
#include "app/cli/render_options.h"
#include "app/cli/render_work.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

namespace sandglass::cli {

void addRender(CLI::App& app, Action& action) {
  auto options = std::make_shared<RenderOptions>();
  RenderOptions& o = *options;
  CLI::App* command =
      app.add_subcommand("render", "draw frames of runs or files as pictures or a film; needs no display");
  command
      ->add_option("source", o.sources,
                   "run folders, frame files, patterns such as 'runs/*', or pictures to draw again")
      ->type_name("RUN|FILE");
  command
      ->add_option("--side-by-side", o.sideBySide,
                   "two runs in one picture through one camera, frames of like time together")
      ->expected(2)
      ->type_name("RUN RUN");
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
  command
      ->add_option("--select", o.select,
                   "only grains for which this holds, such as \"z > 0.05 && speed < 0.1\"")
      ->type_name("EXPRESSION");
  command->add_flag("--force-chains", o.forceChains, "contacts as tubes, grains small");
  command->add_option("--arrows", o.arrows, "a vector of each grain as an arrow: velocity, spin, force")
      ->type_name("VECTOR");
  command->add_option("--field", o.field, "coarse-grained field (VTI) to lay a slice through")
      ->type_name("FILE.vti");
  command
      ->add_option(
          "--slice", o.slice,
          "slice through a field, coloured by this array of it (default: the first); without --field "
          "each frame is coarse-grained: packing_fraction, velocity.z, ...")
      ->type_name("QUANTITY");
  command->add_option("--tracks", o.tracks, "where these grains have been since the first frame, as lines")
      ->delimiter(',')
      ->type_name("ID,...");
  command->add_option("--track-duration", o.trackDuration, "only so long back from each picture [s]")
      ->check(CLI::NonNegativeNumber)
      ->type_name("TIME");
  command->add_option("--turn", o.turn, "degrees that the camera goes round from one picture to the next")
      ->type_name("ANGLE");
  command->add_option("--size", o.size, "pixels: WxH, 720p, 1080p, 4k (default 1280x720)")->type_name("SIZE");
  command->add_option("--supersample", o.supersample, "pixels drawn for each pixel, in each direction")
      ->check(CLI::Range(1, 4))
      ->type_name("N");
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
  addImportOptions(*command, o.import);
  command->callback([options, &action] { action = [options] { return render(*options); }; });
}

} // namespace sandglass::cli
