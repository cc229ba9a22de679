#include "sim/io/import/unpacking.h"

#include "sim/base/error.h"

#include <fmt/format.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <vector>

namespace sandglass {

namespace {

constexpr std::size_t packedBlock = std::size_t{1} << 17;

/// What both have in common: packed bytes come in blocks, a seek unpacks what lies between.
class Packed : public ByteStream {
public:
  Packed(OpenRaw raw, const std::string& name, std::uint64_t limit)
      : open_(std::move(raw)), name_(name), limit_(limit), packed_(packedBlock), raw_(open_()) {}

  std::size_t read(char* to, std::size_t most) final {
    most = static_cast<std::size_t>(std::min<std::uint64_t>(most, limit_ - at_));
    const std::size_t got = most > 0 ? unpack(to, most) : 0;
    at_ += got;
    return got;
  }

  void seek(std::uint64_t offset) final {
    if (offset < at_) {
      raw_ = open_();
      used_ = have_ = packedAt_ = at_ = 0;
      restart();
    }
    std::vector<char> skipped(packedBlock);
    while (at_ < offset)
      if (read(skipped.data(), std::min<std::uint64_t>(skipped.size(), offset - at_)) == 0) return;
  }

protected:
  virtual std::size_t unpack(char* to, std::size_t most) = 0; ///< 0 at the end alone
  virtual void restart() = 0;

  /// More packed bytes when those at hand are used up; false at the end of the file.
  bool fill() {
    if (used_ < have_) return true;
    packedAt_ += have_;
    have_ = raw_->read(packed_.data(), packed_.size());
    used_ = 0;
    return have_ > 0;
  }
  [[noreturn]] void fail(const char* form, const std::string& why) const {
    throw InputError(
        fmt::format("{}: byte {} of the packed file: {}, so this {} is damaged or was cut off; pack it again",
                    name_, packedAt_ + used_, why, form));
  }

  OpenRaw open_;
  std::string name_;
  std::uint64_t limit_, at_ = 0, packedAt_ = 0;
  std::vector<char> packed_;
  std::size_t used_ = 0, have_ = 0;
  std::unique_ptr<ByteStream> raw_;
};

class Gzip final : public Packed {
public:
  Gzip(OpenRaw raw, const std::string& name, std::uint64_t limit) : Packed(std::move(raw), name, limit) {
    if (::inflateInit2(&state_, 15 + 32) != Z_OK) throw RunError("zlib cannot be started"); // gzip or zlib
  }
  ~Gzip() override { ::inflateEnd(&state_); }

private:
  void restart() override {
    ::inflateReset(&state_);
    ended_ = false;
  }
  std::size_t unpack(char* to, std::size_t most) override {
    most = std::min<std::size_t>(most, 1u << 30);
    state_.next_out = reinterpret_cast<Bytef*>(to);
    state_.avail_out = static_cast<uInt>(most);
    while (state_.avail_out == most) {
      if (!fill()) {
        if (ended_) return 0;
        fail("gzip file", "the file ends in the middle of a member");
      }
      if (ended_) { // another member follows
        ::inflateReset(&state_);
        ended_ = false;
      }
      state_.next_in = reinterpret_cast<Bytef*>(packed_.data() + used_);
      state_.avail_in = static_cast<uInt>(have_ - used_);
      const int result = ::inflate(&state_, Z_NO_FLUSH);
      used_ = have_ - state_.avail_in;
      if (result == Z_STREAM_END)
        ended_ = true;
      else if (result != Z_OK && result != Z_BUF_ERROR)
        fail("gzip file", state_.msg ? fmt::format("zlib says '{}'", state_.msg) : "zlib gives up");
    }
    return most - state_.avail_out;
  }
  z_stream state_{};
  bool ended_ = false;
};

class Zstd final : public Packed {
public:
  Zstd(OpenRaw raw, const std::string& name, std::uint64_t limit)
      : Packed(std::move(raw), name, limit), state_(::ZSTD_createDStream(), ::ZSTD_freeDStream) {
    if (!state_) throw RunError("zstd cannot be started");
  }

private:
  void restart() override {
    ::ZSTD_DCtx_reset(state_.get(), ZSTD_reset_session_only);
    ended_ = false;
  }
  std::size_t unpack(char* to, std::size_t most) override {
    ZSTD_outBuffer out{to, most, 0};
    bool starved = false;
    while (out.pos == 0) {
      if (!fill()) {
        if (ended_) return 0;
        if (starved) fail("zstd file", "the file ends in the middle of a frame");
        starved = true; // what the library still holds may yet come out
      }
      ZSTD_inBuffer in{packed_.data(), have_, used_};
      const std::size_t result = ::ZSTD_decompressStream(state_.get(), &out, &in);
      used_ = in.pos;
      if (::ZSTD_isError(result))
        fail("zstd file", fmt::format("zstd says '{}'", ::ZSTD_getErrorName(result)));
      ended_ = result == 0;
    }
    return out.pos;
  }
  std::unique_ptr<ZSTD_DStream, std::size_t (*)(ZSTD_DStream*)> state_;
  bool ended_ = false;
};

} // namespace

std::unique_ptr<ByteStream> openGzip(OpenRaw raw, const std::string& name, std::uint64_t limit) {
  return std::make_unique<Gzip>(std::move(raw), name, limit);
}

std::unique_ptr<ByteStream> openZstd(OpenRaw raw, const std::string& name, std::uint64_t limit) {
  return std::make_unique<Zstd>(std::move(raw), name, limit);
}

} // namespace sandglass
