#include "sim/base/parallel.h"

#include <immintrin.h>

#include <algorithm>

namespace sandglass {

namespace {

/// Looks that a thread takes before it lets others have the core, and before it sleeps: some 50 microseconds
/// and a millisecond.
constexpr int eagerLooks = 1000, politeLooks = 2000;
/// Bits of the control word that tell what has happened, not how to compute.
constexpr unsigned exceptionsMet = 0x3f;

} // namespace

Parallel::Parallel(int threads)
    : threads_(std::min(
          4096, threads > 0 ? threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency())))),
      shares_(threads_) {
  for (int k = 1; k < threads_; ++k)
    workers_.emplace_back([this, k] { work(k); });
}

Parallel::~Parallel() {
  leave_ = true;
  ++round_;
  round_.notify_all();
  for (std::thread& worker : workers_)
    worker.join();
}

void Parallel::run(std::int64_t count, std::int64_t pieces, Call call, void* body) {
  count_ = count;
  pieces_ = pieces;
  call_ = call;
  body_ = body;
  arithmetic_ = _mm_getcsr() & ~exceptionsMet;
  failure_ = nullptr;
  finished_.store(0, std::memory_order_relaxed);
  const std::uint64_t round = round_.load(std::memory_order_relaxed) + 1;
  for (int t = 0; t < threads_; ++t) {
    const std::uint64_t first = pieces * t / threads_, end = pieces * (t + 1) / threads_;
    shares_[t].word.store(round << 32 | end << 16 | first, std::memory_order_release);
  }
  round_.store(round); // ordered against the sleepers' counting
  if (asleep_.load() > 0) round_.notify_all();
  takePieces(0);
  for (int look = 0; finished_.load(std::memory_order_acquire) != pieces; ++look) {
    if (look < eagerLooks)
      _mm_pause();
    else
      std::this_thread::yield();
  }
  if (failure_) std::rethrow_exception(failure_);
}

void Parallel::takePieces(int first) {
  for (int k = 0; k < threads_; ++k)
    while (takePiece(shares_[(first + k) % threads_].word)) {
    }
}

bool Parallel::takePiece(std::atomic<std::uint64_t>& share) {
  std::uint64_t word = share.load(std::memory_order_acquire);
  std::int64_t k;
  do {
    k = static_cast<std::int64_t>(word & 0xffff);
    if (k >= static_cast<std::int64_t>(word >> 16 & 0xffff)) return false;
  } while (
      !share.compare_exchange_weak(word, word + 1, std::memory_order_acq_rel, std::memory_order_acquire));
  if ((_mm_getcsr() & ~exceptionsMet) != arithmetic_) _mm_setcsr(arithmetic_);
  try {
    call_(body_, count_ * k / pieces_, count_ * (k + 1) / pieces_);
  } catch (...) {
    const std::lock_guard lock(failureGuard_);
    if (!failure_) failure_ = std::current_exception();
  }
  finished_.fetch_add(1, std::memory_order_release);
  return true;
}

void Parallel::work(int index) {
  std::uint64_t seen = 0;
  while (!leave_) {
    for (int look = 0; round_.load(std::memory_order_acquire) == seen; ++look) {
      if (look < eagerLooks) {
        _mm_pause();
      } else if (look < eagerLooks + politeLooks) {
        std::this_thread::yield();
      } else {
        ++asleep_;
        round_.wait(seen);
        --asleep_;
      }
    }
    seen = round_.load(std::memory_order_acquire);
    if (!leave_) takePieces(index);
  }
}

} // namespace sandglass
