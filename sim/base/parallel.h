#pragma once
// Loops over many threads, for loops that last some ten microseconds and follow each other closely. Results
// never depend on how the range was split: bodies write to places of their own, and reductions are maxima.
//
// Why not a task library here: between two loops of a step its workers fall asleep, and waking one takes as
// long as the loop itself (measured: two threads no faster than one at 10,000 grains). These workers look out
// for the next loop for a while before they sleep.

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <type_traits>
#include <vector>

namespace sandglass {

class Parallel {
public:
  /// threads = 0: all cores. More threads than cores is allowed, and slow.
  explicit Parallel(int threads);
  ~Parallel();
  Parallel(const Parallel&) = delete;
  Parallel& operator=(const Parallel&) = delete;

  int threads() const { return threads_; }

  /// Calls body(begin, end) on pieces of [0, count), none shorter than `grain` items unless count is. Who
  /// takes which piece is left to chance, so that a thread whose core is busy elsewhere holds nobody up. Not
  /// to be nested; called from one thread at a time. The first exception of a body is rethrown.
  template <class Body> void forRange(std::int64_t count, std::int64_t grain, Body&& body) {
    if (count <= 0) return;
    const std::int64_t pieces =
        std::min<std::int64_t>(piecesPerThread * threads_, std::max<std::int64_t>(1, count / grain));
    if (pieces == 1 || threads_ == 1) {
      body(std::int64_t{0}, count);
      return;
    }
    using Plain = std::remove_reference_t<Body>;
    run(
        count, pieces,
        [](void* self, std::int64_t first, std::int64_t last) { (*static_cast<Plain*>(self))(first, last); },
        const_cast<void*>(static_cast<const void*>(&body)));
  }

private:
  static constexpr int piecesPerThread = 4;
  using Call = void (*)(void*, std::int64_t, std::int64_t);
  void run(std::int64_t count, std::int64_t pieces, Call call, void* body);
  void takePieces(int first);
  bool takePiece(std::atomic<std::uint64_t>& share);
  void work(int index);

  int threads_;
  std::vector<std::thread> workers_;
  // The loop in progress. Read only by who holds one of its pieces, and it cannot end before they are done.
  std::int64_t count_ = 0;
  Call call_ = nullptr;
  void* body_ = nullptr;
  unsigned arithmetic_ = 0; ///< control word of the calling thread: all round as it does
  std::exception_ptr failure_;
  std::mutex failureGuard_;
  /// A thread's share: number of the loop (32 bits), its end (16) and the next free piece (16) in one word,
  /// so that nobody can take a piece of a loop that is over.
  struct alignas(64) Share {
    std::atomic<std::uint64_t> word{0};
  };
  std::vector<Share> shares_;
  std::int64_t pieces_ = 1;
  alignas(64) std::atomic<std::uint64_t> round_{0};
  alignas(64) std::atomic<std::int64_t> finished_{0};
  alignas(64) std::atomic<int> asleep_{0};
  std::atomic<bool> leave_{false};
};

} // namespace sandglass
