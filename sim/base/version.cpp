#include "sim/base/version.h"

#include "sandglass_revision.h"

namespace sandglass {

std::string programVersion() {
  const std::string revision = SANDGLASS_REVISION;
  return SANDGLASS_VERSION + (revision.empty() ? "" : " (" + revision + ")");
}

} // namespace sandglass
