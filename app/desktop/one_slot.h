#pragma once
// A mailbox for one letter between two threads: a newer letter replaces one that was not fetched, so that
// nobody ever works on what is stale.

#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

namespace sandglass::desktop {

template <class T> class OneSlot {
public:
  /// Returns whether the slot was empty, that is, whether the receiver is to be told.
  bool put(T value) {
    const std::lock_guard lock(mutex_);
    const bool wasEmpty = !value_;
    value_ = std::move(value);
    changed_.notify_one();
    return wasEmpty;
  }

  std::optional<T> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(value_, std::nullopt);
  }

  /// Waits for a letter; nothing once closed.
  std::optional<T> wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return value_ || closed_; });
    if (closed_) return std::nullopt;
    return std::exchange(value_, std::nullopt);
  }

  /// Waits `time` (a std::chrono duration), or until closed; false once closed.
  template <class Duration> bool rest(const Duration& time) {
    std::unique_lock lock(mutex_);
    return !changed_.wait_for(lock, time, [&] { return closed_; });
  }

  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }

private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<T> value_;
  bool closed_ = false;
};

} // namespace sandglass::desktop
