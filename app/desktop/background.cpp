#include "app/desktop/background.h"

#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>

namespace sandglass::desktop {

void lowerPriority(int nice) {
  // On Linux a thread id in place of a process id means this thread alone.
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), nice);
}

double threadSeconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void limitRasteriserThreads() {
  constexpr int keepWhatTheUserSet = 0;
  setenv("LP_NUM_THREADS", "0", keepWhatTheUserSet); // 0: in the thread that draws
}

} // namespace sandglass::desktop
