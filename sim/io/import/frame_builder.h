#pragma once
// From the columns of a file to a Frame: names get their meaning, units become SI, positions come into the
// box, grains are put in the order of their ids, and what makes no sense is refused.

#include "sim/io/import/import_settings.h"
#include "sim/io/import/raw_frame.h"

#include <string>

namespace sandglass {

/// Time of a frame [s]: what the file says, else its step times the settings' time step, else `index` times
/// the settings' interval; where there is neither, steps or indices count as seconds.
double importTime(const std::optional<double>& time, const std::optional<std::int64_t>& step,
                  std::size_t index, const ImportSettings& settings);
/// Whether importTime() has a time to go by.
bool timeIsKnown(const std::optional<double>& time, const std::optional<std::int64_t>& step,
                 const ImportSettings& settings);

/// `file` begins every message. What is taken for granted is added to `remarks` once. Throws InputError:
/// no positions, a position, radius or other quantity of the mechanics that is no finite number, an id that
/// occurs twice, an empty box, or a tilted one that cannot be put upright.
Frame buildFrame(const RawFrame& raw, std::size_t index, const ImportSettings& settings,
                 const std::string& file, std::vector<std::string>& remarks);

} // namespace sandglass
