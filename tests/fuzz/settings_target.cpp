// The file of --columns: any text; what is read is written and read to the same settings.

#include "sim/base/error.h"
#include "sim/io/import/import_settings.h"

#include <cstdint>
#include <cstdlib>
#include <string>

/// udunits2 forgets the word it has read when what follows makes no unit ("1mm5-0s"): a few bytes for each unit
/// that is refused, inside the library.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:utlex\n";
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sandglass;
  try {
    const ImportSettings settings = parseImportSettings({reinterpret_cast<const char*>(data), size}, "input");
    if (!settings.walls.empty()) return 0; // become absolute
    if (parseImportSettings(writeImportSettings(settings), "again") != settings) std::abort();
  } catch (const InputError&) {
  }
  return 0;
}
