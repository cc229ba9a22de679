#pragma once
// What a picture needs to know of other frames: where each grain was at first (colours of dyed layers), and
// where chosen grains have been (tracks).

#include "sim/io/run_folder.h"
#include "vis/view.h"

#include <array>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

namespace sandglass::vis {

class History {
public:
  struct Track {
    std::vector<double> time; ///< [s], ascending
    std::vector<Vec3> position;
  };

  /// Positions of this frame are the original ones of the grains that have none yet.
  void addOriginals(const Frame& frame);
  /// Appends the positions of the chosen grains; frames in order of time.
  void addTracks(const Frame& frame, const std::vector<std::int64_t>& grains);

  bool hasOriginals() const { return !originals_.empty(); }
  /// x, y or z of the original position of each grain of the frame; NaN where it is not known.
  std::vector<double> original(const Frame& frame, int axis) const;
  /// Lowest and highest of all originals along an axis; 0 and 1 when there are none.
  std::array<double, 2> originalRange(int axis) const;
  const std::map<std::int64_t, Track>& tracks() const { return tracks_; }

private:
  std::unordered_map<std::int64_t, Vec3> originals_;
  std::map<std::int64_t, Track> tracks_;
};

/// Axis of "original.x", "original.y" or "original.z"; nothing for other quantities.
std::optional<int> originalAxis(const std::string& quantity);

/// Whether a picture with this view needs a History.
bool needsHistory(const View& view);

/// What `view` needs of a source. Originals are the positions in the first frame of the last stage: the
/// layers that a discharge sets out from, not the rain that filled the vessel. Tracks read every frame;
/// `onFrame` is called after each. Throws InputError when the ids of the source do not persist.
History historyOf(const FrameSource& source, const View& view, const std::function<void()>& onFrame = {});

/// Values of a quantity for colours and selections: grainScalar(), and "original.z" with a history. Throws
/// InputError when it is not there.
std::vector<double> quantityValues(const Frame& frame, const std::string& quantity, const History* history);

/// Its SI unit as text.
std::string quantityUnit(const std::string& quantity);

} // namespace sandglass::vis
