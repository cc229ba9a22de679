// The thread that writes frames: the run goes on while it writes, but no more than two frames wait.

#include "sim/base/error.h"
#include "sim/run/frame_queue.h"

#include <catch2/catch.hpp>

#include <future>

using namespace sandglass;

namespace {

/// A disk that stands still until it is let go, and fails at a step if wanted.
struct Disk {
  std::mutex mutex;
  std::condition_variable changed;
  bool open = false;
  std::int64_t failsAt = -1;
  std::vector<std::int64_t> written;
  int closed = 0;

  void letGo() {
    const std::lock_guard lock(mutex);
    open = true;
    changed.notify_all();
  }
};

class SlowWriter final : public FrameWriter {
public:
  explicit SlowWriter(Disk& disk) : disk_(disk) {}
  void write(const Frame& frame) override {
    std::unique_lock lock(disk_.mutex);
    disk_.changed.wait(lock, [this] { return disk_.open; });
    if (frame.step == disk_.failsAt) throw RunError("the disk is full");
    disk_.written.push_back(frame.step);
  }
  void closeSegment() override {
    const std::lock_guard lock(disk_.mutex);
    ++disk_.closed;
  }
  void closeIfOld() override {}

private:
  Disk& disk_;
};

FramePtr frameOf(std::int64_t step) {
  auto frame = std::make_shared<Frame>();
  frame->step = step;
  return frame;
}

} // namespace

TEST_CASE("a run goes on while a frame is written, and waits when two more are waiting", "[run]") {
  Disk disk;
  FrameQueue queue(std::make_unique<SlowWriter>(disk));
  for (int step = 0; step < 3; ++step) // one is being written, two wait: returns with the disk standing still
    queue.push(frameOf(step));
  auto fourth = std::async(std::launch::async, [&] { queue.push(frameOf(3)); });
  CHECK(fourth.wait_for(std::chrono::milliseconds(100)) == std::future_status::timeout);
  CHECK(disk.written.empty());
  disk.letGo();
  fourth.get();
  queue.closeSegment();
  CHECK(disk.written == std::vector<std::int64_t>{0, 1, 2, 3});
  CHECK(disk.closed == 1);
}

TEST_CASE("what goes wrong while frames are written reaches the run", "[run]") {
  Disk disk;
  disk.failsAt = 1;
  FrameQueue queue(std::make_unique<SlowWriter>(disk));
  queue.push(frameOf(0));
  queue.push(frameOf(1));
  disk.letGo();
  CHECK_THROWS_WITH(queue.closeSegment(), "the disk is full");
  CHECK_THROWS_WITH(queue.push(frameOf(2)), "the disk is full");
  CHECK(disk.written == std::vector<std::int64_t>{0});
}

TEST_CASE("frames that wait are written before the thread ends", "[run]") {
  Disk disk;
  {
    FrameQueue queue(std::make_unique<SlowWriter>(disk));
    queue.push(frameOf(0));
    queue.push(frameOf(1));
    disk.letGo();
  }
  CHECK(disk.written == std::vector<std::int64_t>{0, 1});
}
