#include "sim/io/import/line_reader.h"

#include "sim/base/error.h"

#include <fmt/format.h>

#include <cstring>

namespace sandglass {

namespace {

constexpr std::size_t blockSize = std::size_t{1} << 17;

} // namespace

LineReader::LineReader(std::unique_ptr<ByteStream> stream, std::string name)
    : stream_(std::move(stream)), name_(std::move(name)), block_(blockSize) {
  if (std::size_t end = 0; find(end) && have_ >= 3 && std::memcmp(block_.data(), "\xef\xbb\xbf", 3) == 0)
    at_ = 3;
}

bool LineReader::more() {
  if (over_) return false;
  if (at_ > 0) {
    std::memmove(block_.data(), block_.data() + at_, have_ - at_);
    blockAt_ += at_;
    have_ -= at_;
    at_ = 0;
  }
  if (have_ == block_.size()) {
    if (have_ >= longestLine) {
      ++line_;
      fail(fmt::format("the line is longer than {} bytes, so this is no table of grains as text",
                       longestLine));
    }
    block_.resize(2 * block_.size());
  }
  const std::size_t got = stream_->read(block_.data() + have_, block_.size() - have_);
  have_ += got;
  over_ = got == 0;
  return got > 0;
}

bool LineReader::find(std::size_t& end) {
  std::size_t from = at_;
  for (;;) {
    if (from < have_)
      if (const void* found = std::memchr(block_.data() + from, '\n', have_ - from)) {
        end = static_cast<std::size_t>(static_cast<const char*>(found) - block_.data());
        return true;
      }
    const std::size_t known = have_ - at_;
    if (!more()) {
      end = have_;
      return have_ > at_;
    }
    from = at_ + known;
  }
}

bool LineReader::peek(std::string_view& line) {
  std::size_t end = 0;
  if (!find(end)) return false;
  line = {block_.data() + at_, end - at_};
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return true;
}

bool LineReader::next(std::string_view& line) {
  std::size_t end = 0;
  if (!find(end)) return false;
  line = {block_.data() + at_, end - at_};
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  ended_ = end < have_;
  at_ = ended_ ? end + 1 : end;
  ++line_;
  return true;
}

std::uint64_t LineReader::skip(std::uint64_t count) {
  std::uint64_t done = 0;
  for (std::size_t end = 0; done < count && find(end); ++done) {
    ended_ = end < have_;
    at_ = ended_ ? end + 1 : end;
  }
  line_ += done;
  return done;
}

void LineReader::seek(std::uint64_t offset, std::uint64_t line) {
  if (offset >= blockAt_ && offset <= blockAt_ + have_) {
    at_ = static_cast<std::size_t>(offset - blockAt_);
  } else {
    stream_->seek(offset);
    blockAt_ = offset;
    at_ = have_ = 0;
    over_ = false;
  }
  line_ = line;
  ended_ = true;
}

void LineReader::fail(const std::string& sentence) const {
  throw InputError(fmt::format("{}:{}: {}", name_, line_, sentence));
}

std::string shownText(std::string_view found) {
  if (found.empty()) return "an empty line";
  std::string text;
  for (const char c : found.substr(0, 32))
    text += c >= 0x20 && c < 0x7f ? c : '?';
  return "'" + text + (found.size() > 32 ? "…'" : "'");
}

} // namespace sandglass
