#pragma once
// Loops over many threads. Results never depend on how the range was split: bodies write to places of their
// own, and the only reductions are maxima.

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cstdint>

namespace sandglass {

class Parallel {
public:
  /// threads = 0: all cores.
  explicit Parallel(int threads)
      : threads_(threads > 0 ? threads : tbb::info::default_concurrency()), arena_(threads_) {
    // One limit for the whole program, above any sensible request: the smallest limit alive would win.
    static const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 256);
  }

  int threads() const { return threads_; }

  /// Calls body(begin, end) on pieces of [0, count) of about `grain` items.
  template <class Body> void forRange(std::int64_t count, std::int64_t grain, Body&& body) {
    if (count <= 0) return;
    if (threads_ == 1 || count <= grain) {
      body(std::int64_t{0}, count);
      return;
    }
    arena_.execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<std::int64_t>(0, count, grain), [&](const auto& r) { body(r.begin(), r.end()); },
          tbb::static_partitioner());
    });
  }

private:
  int threads_;
  tbb::task_arena arena_;
};

} // namespace sandglass
