#include "sim/io/import/frame_format.h"

namespace sandglass {

TextFormat::TextFormat(const ImportFile& file, const ImportSettings& settings)
    : settings_(settings), size_(file.size()), walker_(file.open(), file.name()),
      jumper_(file.open(), file.name()) {}

std::optional<std::uint64_t> TextFormat::bytesLeft(const LineReader& in) const {
  if (!size_) return std::nullopt;
  return *size_ > in.offset() ? *size_ - in.offset() : 0;
}

void TextFormat::nameColumns(RawFrame& frame, const std::vector<std::string>& names) {
  for (const auto& name : names)
    frame.columns.push_back({name, {}, {}});
}

LineReader& TextFormat::jumper(const FrameMark& mark) {
  jumper_.seek(mark.offset, mark.line);
  return jumper_;
}

} // namespace sandglass
