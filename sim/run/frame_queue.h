#pragma once
// Compresses and writes frames in a thread of its own, so that the run does not wait for the disk.

#include "sim/io/run_folder.h"

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>

namespace sandglass {

class FrameQueue {
public:
  explicit FrameQueue(std::unique_ptr<FrameWriter> writer);
  ~FrameQueue(); ///< writes what waits, then closes the segment
  /// Waits while two frames are waiting already. Rethrows what went wrong in the writer.
  void push(FramePtr frame);
  /// Waits until all frames are in closed segments. Rethrows what went wrong in the writer.
  void closeSegment();

private:
  void work();
  void rethrow();
  std::unique_ptr<FrameWriter> writer_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<FramePtr> waiting_; ///< a null asks for the segment to be closed
  bool busy_ = false, done_ = false;
  std::exception_ptr fault_;
  std::thread thread_;
};

} // namespace sandglass
