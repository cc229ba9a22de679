// PNG by libpng. Text chunks are iTXt (UTF-8, ISO/IEC 15948 section 11.3.4.5), compressed when long.

#include "sim/base/error.h"
#include "vis/renderer.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace sandglass::vis {

namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// libpng reports through callbacks that must not return; the message becomes our exception.
void onError(png_structp png, png_const_charp message) {
  const auto* file = static_cast<const std::filesystem::path*>(png_get_error_ptr(png));
  throw Error(fmt::format("{}: this PNG file cannot be written or read: {}.", file->string(), message));
}
void onWarning(png_structp, png_const_charp) {}

constexpr std::size_t longestKey = 79; // of the PNG standard

} // namespace

void writePng(const Image& image, const std::filesystem::path& file,
              const std::map<std::string, std::string>& text) {
  if (image.width < 1 || image.height < 1)
    throw Error(fmt::format("{}: an empty picture cannot be written.", file.string()));
  // Under another name first: nobody finds half a picture.
  const std::filesystem::path partial = file.string() + ".part";
  File out(std::fopen(partial.c_str(), "wb"), &std::fclose);
  if (!out)
    throw InputError(
        fmt::format("{}: the picture cannot be written: {}; choose a folder that exists and is writable",
                    file.string(), std::strerror(errno)));
  struct Writer {
    png_structp png;
    png_infop info;
    explicit Writer(const std::filesystem::path& f)
        : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, const_cast<std::filesystem::path*>(&f), onError,
                                      onWarning)),
          info(png_create_info_struct(png)) {}
    ~Writer() { png_destroy_write_struct(&png, &info); }
  } writer(file);

  png_init_io(writer.png, out.get());
  png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(image.width),
               static_cast<png_uint_32>(image.height), 8, PNG_COLOR_TYPE_RGBA, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(writer.png, 6);
  std::vector<std::string> keys, values;
  for (const auto& [key, value] : text) {
    keys.push_back(key.substr(0, longestKey));
    values.push_back(value);
  }
  std::vector<png_text> chunks(keys.size());
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    chunks[i].compression = values[i].size() > 1000 ? PNG_ITXT_COMPRESSION_zTXt : PNG_ITXT_COMPRESSION_NONE;
    chunks[i].key = keys[i].data();
    chunks[i].text = values[i].data();
    chunks[i].itxt_length = values[i].size();
    static char none[] = "";
    chunks[i].lang = none;
    chunks[i].lang_key = none;
  }
  png_set_text(writer.png, writer.info, chunks.data(), static_cast<int>(chunks.size()));
  png_write_info(writer.png, writer.info);
  for (int y = 0; y < image.height; ++y)
    png_write_row(writer.png, image.rgba.data() +
                                  static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) * 4);
  png_write_end(writer.png, writer.info);
  const bool flushed = std::fflush(out.get()) == 0;
  out.reset();
  if (!flushed)
    throw Error(fmt::format("{}: the picture could not be written in full: {}.", file.string(),
                            std::strerror(errno)));
  std::filesystem::rename(partial, file);
}

Image readPng(const std::filesystem::path& file, std::map<std::string, std::string>* text) {
  File in(std::fopen(file.c_str(), "rb"), &std::fclose);
  if (!in)
    throw InputError(fmt::format("{}: the picture cannot be read: {}", file.string(), std::strerror(errno)));
  png_byte signature[8]{};
  if (std::fread(signature, 1, 8, in.get()) != 8 || png_sig_cmp(signature, 0, 8) != 0)
    throw InputError(fmt::format(
        "{}: this is not a PNG file; give a picture that `sandglass render` has written", file.string()));
  struct Reader {
    png_structp png;
    png_infop info;
    explicit Reader(const std::filesystem::path& f)
        : png(png_create_read_struct(PNG_LIBPNG_VER_STRING, const_cast<std::filesystem::path*>(&f), onError,
                                     onWarning)),
          info(png_create_info_struct(png)) {}
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  } reader(file);

  png_init_io(reader.png, in.get());
  png_set_sig_bytes(reader.png, 8);
  png_set_user_limits(reader.png, 32768, 32768);
  png_read_info(reader.png, reader.info);
  png_set_expand(reader.png);
  png_set_strip_16(reader.png);
  png_set_gray_to_rgb(reader.png);
  png_set_add_alpha(reader.png, 255, PNG_FILLER_AFTER);
  const int passes = png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  Image image;
  image.width = static_cast<int>(png_get_image_width(reader.png, reader.info));
  image.height = static_cast<int>(png_get_image_height(reader.png, reader.info));
  const std::size_t row = static_cast<std::size_t>(image.width) * 4;
  image.rgba.resize(row * static_cast<std::size_t>(image.height));
  for (int pass = 0; pass < passes; ++pass)
    for (int y = 0; y < image.height; ++y)
      png_read_row(reader.png, image.rgba.data() + row * static_cast<std::size_t>(y), nullptr);
  png_read_end(reader.png, reader.info);
  if (text) {
    png_textp chunks = nullptr;
    const int count = png_get_text(reader.png, reader.info, &chunks, nullptr);
    for (int i = 0; i < count; ++i)
      (*text)[chunks[i].key] = chunks[i].text;
  }
  return image;
}

} // namespace sandglass::vis
