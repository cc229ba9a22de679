#include "sim/run/frame_queue.h"

namespace sandglass {

FrameQueue::FrameQueue(std::unique_ptr<FrameWriter> writer)
    : writer_(std::move(writer)), thread_([this] { work(); }) {}

FrameQueue::~FrameQueue() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void FrameQueue::push(FramePtr frame) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return waiting_.size() < 2 || fault_; });
  rethrow();
  waiting_.push_back(std::move(frame));
  changed_.notify_all();
}

void FrameQueue::closeSegment() {
  std::unique_lock lock(mutex_);
  waiting_.push_back(nullptr);
  changed_.notify_all();
  changed_.wait(lock, [&] { return (waiting_.empty() && !busy_) || fault_; });
  rethrow();
}

void FrameQueue::rethrow() {
  if (fault_) std::rethrow_exception(fault_);
}

void FrameQueue::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    const bool idle =
        !changed_.wait_for(lock, std::chrono::seconds(5), [&] { return !waiting_.empty() || done_; });
    if (!idle && waiting_.empty()) return;
    FramePtr frame;
    if (!idle) {
      frame = std::move(waiting_.front());
      waiting_.pop_front();
      changed_.notify_all(); // there is room now, not only when this one is written
    }
    busy_ = true;
    lock.unlock();
    std::exception_ptr fault;
    try {
      if (idle)
        writer_->closeIfOld();
      else if (frame)
        writer_->write(*frame);
      else
        writer_->closeSegment();
    } catch (...) {
      fault = std::current_exception();
    }
    lock.lock();
    busy_ = false;
    if (fault) {
      fault_ = fault;
      waiting_.clear();
    }
    changed_.notify_all();
  }
}

} // namespace sandglass
