#pragma once
// The columns of one frame by the quantities that they stand for.

#include "sim/io/import/import_settings.h"
#include "sim/io/import/raw_frame.h"

#include <map>
#include <string>
#include <vector>

namespace sandglass {

/// Which frame of which file a message is about.
struct FramePlace {
  std::string file;
  std::size_t index = 0;       ///< of the frame
  std::uint64_t firstLine = 0; ///< of its rows; 0: they do not follow each other line by line
  [[noreturn]] void fail(const std::string& sentence) const;
  [[noreturn]] void failAt(std::size_t row, const std::string& sentence) const;
};

/// What each column of a frame stands for, in the frame's order; "" for those that are left out. Where two
/// stand for the same (x and xu, type and element) the first counts and the other keeps its own name.
std::vector<std::string> quantitiesOf(const RawFrame& raw, const ImportSettings& settings);

class ColumnSet {
public:
  /// `raw` and `place` must outlive this. Throws InputError when the settings name a column that is not
  /// there.
  ColumnSet(const RawFrame& raw, const ImportSettings& settings, const FramePlace& place);

  bool has(const std::string& quantity) const { return named_.contains(quantity); }
  /// Whether base.x, base.y and base.z are there.
  bool hasTriple(const std::string& base) const;
  /// One that may hold words; null when there is none.
  const RawColumn* find(const std::string& quantity) const;
  /// Numbers, and the quantity counts as used; null when there is none. Throws InputError where it holds
  /// words, or, with `finite`, where a number is not.
  const std::vector<double>* take(const std::string& quantity, bool finite = true);
  /// base.x, base.y, base.z times `unit`.
  std::vector<Vec3> takeTriple(const std::string& base, double unit, bool finite = true);
  void drop(const std::string& quantity) { named_.erase(quantity); }
  /// What has not been taken yet.
  const std::map<std::string, const RawColumn*>& rest() const { return named_; }
  /// "id, x, y, z", for messages.
  std::string names() const;

private:
  const RawFrame& raw_;
  const FramePlace& place_;
  std::map<std::string, const RawColumn*> named_;
};

} // namespace sandglass
