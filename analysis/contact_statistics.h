#pragma once
// How deep grains overlap and how strongly they press, as distributions, between grains and at walls.

#include "analysis/result.h"
#include "sim/frame/frame.h"

#include <string>
#include <vector>

namespace sandglass::analysis {

struct ContactStatisticsOptions {
  int bins = 100;
  double diameter = 0; ///< [m]; 0: twice the mean radius of each Frame
};

/// Add Frames with contacts, then ask for the results. Gaps across which a law acts are left out.
class ContactStatistics {
public:
  explicit ContactStatistics(ContactStatisticsOptions options) : options_(options) {}

  /// Throws InputError for a Frame with grains and without any contact: the scene has to ask for them.
  void add(const Frame& frame);

  /// Density of overlap / diameter; numbers: means, greatest, counts, and the share above 1 %. Throws
  /// InputError when nothing was added.
  Curve overlaps() const;
  /// Density of |force| / mean |force|, each kind by its own mean; numbers: means [N], counts.
  Curve forces() const;

private:
  struct Kind {
    std::vector<double> overlap, force; ///< shares of the diameter; [N]
  };
  void needData() const;
  ContactStatisticsOptions options_;
  Kind grains_, walls_;
  std::size_t frames_ = 0;
};

} // namespace sandglass::analysis
