// One fuzz target for all readers of frames: the bytes of a file, whatever they are. A reader may refuse with
// an InputError; anything else (another exception, a sanitizer's finding, too much memory or time) is a
// fault. The first byte of the input chooses the settings, so that columns, boxes and shapes take part.

#include "sim/base/error.h"
#include "sim/io/import/reader_table.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

using namespace sandglass;

ImportSettings settingsFor(unsigned choice) {
  ImportSettings settings;
  if (choice & 1) {
    settings.lower = Vec3(0, 0, 0);
    settings.upper = Vec3(1, 2, 3);
    settings.periodic = std::array<bool, 3>{true, true, false};
  }
  if (choice & 2) settings.radius = 0.5;
  if (choice & 4) settings.columns = {{"x", "column 1"}, {"y", "column 2"}, {"z", "column 3"}};
  if (choice & 8) settings.timeStep = 1e-3;
  if (choice & 16) settings.shape = "diameters";
  return settings;
}

/// What every frame that is handed out promises.
void check(const Frame& frame) {
  const std::size_t n = frame.size();
  bool good = frame.id.size() == n && (frame.orientation.empty() || frame.orientation.size() == n);
  for (const auto& x : frame.position)
    good = good && x.allFinite();
  for (const auto& [name, values] : frame.scalars)
    good = good && values.size() == n;
  for (const auto& [name, values] : frame.vectors)
    good = good && values.size() == n;
  for (std::size_t k = 1; k < n; ++k)
    good = good && frame.id[k - 1] < frame.id[k];
  if (frame.scalars.contains(quantity::species))
    for (const double s : frame.scalar(quantity::species))
      good = good && s >= 0 && s < static_cast<double>(frame.speciesNames.size());
  if (frame.scalars.contains(quantity::radius))
    for (const double r : frame.scalar(quantity::radius))
      good = good && r > 0;
  for (int k = 0; k < 3; ++k)
    if (frame.domain.periodic[static_cast<std::size_t>(k)])
      for (const auto& x : frame.position)
        good = good && x[k] >= frame.domain.lower[k] && x[k] < frame.domain.upper[k];
  if (!good) std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  constexpr std::uint64_t unpacked = 1 << 18;
  try {
    const auto source =
        openForeign(std::make_shared<const ImportFile>("input", bytes, unpacked), settingsFor(data[0]));
    while (!source->complete())
      source->refresh();
    constexpr std::size_t looked = 8; // frames
    for (std::size_t k = 0; k < source->size() && k < looked; ++k)
      try {
        source->time(k);
        check(*source->load(k));
      } catch (const InputError&) {
      }
    source->remarks();
  } catch (const InputError&) {
  }
  return 0;
}
