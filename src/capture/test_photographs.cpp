#include "capture/test_photographs.h"

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <gtest/gtest.h>
#include <lcms2.h>
#include <png.h>
#include <unistd.h>
#include <webp/encode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <numbers>
#include <numeric>
#include <span>
#include <stdexcept>

#include "core/files.h"

namespace illum::test {
namespace {

OIIO::TypeDesc typeDescOf(SampleType type) {
  if (type == SampleType::Byte) return OIIO::TypeUInt8;
  return type == SampleType::Word ? OIIO::TypeUInt16 : OIIO::TypeFloat;
}

void setAttribute(OIIO::ImageSpec& spec, const std::string& name, const Attribute& attribute) {
  if (const auto* number = std::get_if<int>(&attribute)) spec.attribute(name, *number);
  if (const auto* number = std::get_if<float>(&attribute)) spec.attribute(name, *number);
  if (const auto* text = std::get_if<std::string>(&attribute)) spec.attribute(name, *text);
  if (const auto* bytes = std::get_if<std::vector<std::byte>>(&attribute)) {
    spec.attribute(name, OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(bytes->size())),
                   bytes->data());
  }
}

std::vector<double> valuesOf(const Sketch& sketch) {
  std::vector<double> values;
  for (int y = 0; y < sketch.size.height; ++y) {
    for (int x = 0; x < sketch.size.width; ++x) {
      for (int c = 0; c < sketch.channels; ++c) values.push_back(sketch.value(x, y, c));
    }
  }
  return values;
}

// In the type itself, so that no library's rounding comes in.
std::vector<std::byte> samplesOf(const Sketch& sketch) {
  std::vector<std::byte> samples;
  const auto put = [&](auto sample) {
    for (const std::byte byte : std::as_bytes(std::span(&sample, 1))) samples.push_back(byte);
  };
  for (const double value : valuesOf(sketch)) {
    if (sketch.type == SampleType::Byte) put(static_cast<std::uint8_t>(std::lround(255 * value)));
    if (sketch.type == SampleType::Word) {
      put(static_cast<std::uint16_t>(std::lround(65535 * value)));
    }
    if (sketch.type == SampleType::Float) put(static_cast<float>(value));
  }
  return samples;
}

void append(std::vector<std::byte>& bytes, std::string_view text) {
  for (const char c : text) bytes.push_back(static_cast<std::byte>(c));
}

void append(std::vector<std::byte>& bytes, std::span<const std::byte> more) {
  std::ranges::copy(more, std::back_inserter(bytes));
}

void appendNumber(std::vector<std::byte>& bytes, std::uint32_t number, int count, bool bigEndian) {
  for (int i = 0; i < count; ++i) {
    bytes.push_back(static_cast<std::byte>(number >> 8 * (bigEndian ? count - 1 - i : i)));
  }
}

// A TIFF structure with one entry: Orientation, SHORT, 1 value.
std::vector<std::byte> exifBlock(int orientation) {
  std::vector<std::byte> bytes;
  append(bytes, std::string_view("MM\0*\0\0\0\x08\0\x01", 10));
  append(bytes, std::string_view("\x01\x12\0\x03\0\0\0\x01\0", 9));
  bytes.push_back(static_cast<std::byte>(orientation));
  append(bytes, std::string_view("\0\0\0\0\0\0", 6));
  return bytes;
}

void appendRiffChunk(std::vector<std::byte>& bytes, std::string_view name,
                     const std::vector<std::byte>& content) {
  append(bytes, name);
  appendNumber(bytes, static_cast<std::uint32_t>(content.size()), 4, false);
  append(bytes, content);
  if (content.size() % 2 != 0) bytes.push_back(std::byte{});
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& why) {
  throw std::runtime_error("test picture " + file.string() + ": " + why);
}

}  // namespace

Folder::Folder() {
  std::string name = (std::filesystem::temp_directory_path() / "illum-capture-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void Folder::writeText(const std::string& name, std::string_view text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
}

double pattern(int seed, int x, int y, int channel) {
  const double wave = std::sin(0.31 * x + 0.17 * y * (1 + 0.1 * seed) + channel + seed);
  return std::clamp(0.5 + 0.4 * wave + (x > y ? 0.08 : -0.08), 0.0, 1.0);
}

Sketch sketch(int seed, Size size, int channels, SampleType type) {
  Sketch result;
  result.size = size;
  result.channels = channels;
  result.type = type;
  result.value = [seed](int x, int y, int c) { return pattern(seed, x, y, c); };
  return result;
}

void write(const std::filesystem::path& file, const Sketch& sketch) {
  OIIO::ImageSpec spec(sketch.size.width, sketch.size.height, sketch.channels,
                       typeDescOf(sketch.type));
  for (const auto& [name, attribute] : sketch.attributes) setAttribute(spec, name, attribute);
  const auto names = sketch.attributes.find("channelnames");
  if (names != sketch.attributes.end()) {
    spec.channelnames = OIIO::Strutil::splits(std::get<std::string>(names->second), ",");
  }
  if (sketch.attributes.contains("oiio:half")) spec.format = OIIO::TypeHalf;
  const auto tile = sketch.attributes.find("tile");
  if (tile != sketch.attributes.end()) {
    spec.tile_width = spec.tile_height = std::get<int>(tile->second);
  }
  const auto output = OIIO::ImageOutput::create(file.string());
  if (!output) fail(file, OIIO::geterror());
  const std::vector<std::byte> samples = samplesOf(sketch);
  if (!output->open(file.string(), spec) ||
      !output->write_image(typeDescOf(sketch.type), samples.data()) || !output->close()) {
    fail(file, output->geterror());
  }
}

void writeInterlacedPng(const std::filesystem::path& file, const Sketch& sketch) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> out(std::fopen(file.c_str(), "wb"),
                                                            std::fclose);
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_init_io(png, out.get());
  constexpr std::array<int, 5> kTypes{0, PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA,
                                      PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGBA};
  png_set_IHDR(png, info, static_cast<png_uint_32>(sketch.size.width),
               static_cast<png_uint_32>(sketch.size.height), 8,
               kTypes[static_cast<std::size_t>(sketch.channels)], PNG_INTERLACE_ADAM7,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  std::vector<std::byte> samples = samplesOf(sketch);
  std::vector<png_bytep> rows;
  const std::size_t rowBytes =
      static_cast<std::size_t>(sketch.size.width) * static_cast<std::size_t>(sketch.channels);
  for (int y = 0; y < sketch.size.height; ++y) {
    rows.push_back(reinterpret_cast<png_bytep>(samples.data()) +
                   static_cast<std::size_t>(y) * rowBytes);
  }
  png_write_image(png, rows.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
}

void writeLosslessWebp(const std::filesystem::path& file, const Sketch& sketch) {
  const std::vector<std::byte> samples = samplesOf(sketch);
  const auto* pixels = reinterpret_cast<const std::uint8_t*>(samples.data());
  std::uint8_t* out = nullptr;
  const auto encode = sketch.channels == 4 ? WebPEncodeLosslessRGBA : WebPEncodeLosslessRGB;
  const std::size_t bytes = encode(pixels, sketch.size.width, sketch.size.height,
                                   sketch.size.width * sketch.channels, &out);
  std::vector<std::byte> encoded;
  append(encoded, std::as_bytes(std::span(out, bytes)));
  WebPFree(out);
  writeBytes(file, encoded);
}

void writeWordPnm(const std::filesystem::path& file, const Sketch& sketch) {
  std::vector<std::byte> bytes;
  append(bytes, (sketch.channels == 1 ? "P5 " : "P6 ") + std::to_string(sketch.size.width) + " " +
                    std::to_string(sketch.size.height) + " 65535\n");
  for (const double value : valuesOf(sketch)) {
    appendNumber(bytes, static_cast<std::uint32_t>(std::lround(65535 * value)), 2, true);
  }
  writeBytes(file, bytes);
}

void addPngExif(const std::filesystem::path& file, int orientation) {
  constexpr std::size_t kAfterHeader = 33;
  const std::vector<std::byte> png = bytesOf(file), exif = exifBlock(orientation);
  std::vector<std::byte> chunk;
  append(chunk, "eXIf");
  append(chunk, exif);
  std::vector<std::byte> out;
  append(out, std::span(png).first(kAfterHeader));
  appendNumber(out, static_cast<std::uint32_t>(exif.size()), 4, true);
  append(out, chunk);
  appendNumber(out, crc32Of(chunk), 4, true);
  append(out, std::span(png).subspan(kAfterHeader));
  writeBytes(file, out);
}

void addWebpChunks(const std::filesystem::path& file, Size size, int orientation,
                   const std::vector<std::byte>& profile) {
  constexpr std::size_t kRiffHead = 12;
  const std::vector<std::byte> webp = bytesOf(file);
  std::vector<std::byte> canvas, body;
  appendNumber(canvas, 0x08u | (profile.empty() ? 0u : 0x20u), 4, false);  // Exif, ICC
  appendNumber(canvas, static_cast<std::uint32_t>(size.width - 1), 3, false);
  appendNumber(canvas, static_cast<std::uint32_t>(size.height - 1), 3, false);
  append(body, "WEBP");
  appendRiffChunk(body, "VP8X", canvas);
  if (!profile.empty()) appendRiffChunk(body, "ICCP", profile);
  append(body, std::span(webp).subspan(kRiffHead));
  appendRiffChunk(body, "EXIF", exifBlock(orientation));
  std::vector<std::byte> out;
  appendRiffChunk(out, "RIFF", body);
  writeBytes(file, out);
}

namespace {

std::vector<std::byte> savedProfile(cmsHPROFILE profile) {
  cmsUInt32Number size = 0;
  cmsSaveProfileToMem(profile, nullptr, &size);
  std::vector<std::byte> bytes(size);
  cmsSaveProfileToMem(profile, bytes.data(), &size);
  cmsCloseProfile(profile);
  return bytes;
}

}  // namespace

std::vector<std::byte> powerProfile(double gamma, bool adobePrimaries) {
  const cmsCIExyY white{0.3127, 0.3290, 1};
  cmsCIExyYTRIPLE primaries{{0.64, 0.33, 1}, {0.30, 0.60, 1}, {0.15, 0.06, 1}};
  if (adobePrimaries) primaries.Green = {0.21, 0.71, 1};
  cmsToneCurve* curve = cmsBuildGamma(nullptr, gamma);
  std::array<cmsToneCurve*, 3> curves{curve, curve, curve};
  const cmsHPROFILE profile = cmsCreateRGBProfile(&white, &primaries, curves.data());
  cmsFreeToneCurve(curve);
  return savedProfile(profile);
}

std::vector<std::byte> displayProfile() {
  return savedProfile(cmsCreate_sRGBProfile());
}

std::string lightFileText(int count, const std::function<std::string(int)>& name) {
  std::string text = std::to_string(count) + "\n";
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (i + 0.5) / count;
    const double phi = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double r = std::sqrt(1 - z * z);
    text += name(i) + " " + std::to_string(r * std::cos(phi)) + " " +
            std::to_string(r * std::sin(phi)) + " " + std::to_string(z) + "\n";
  }
  return text;
}

std::vector<float> readAll(const Capture& capture, const Rectangle& rectangle) {
  std::vector<int> lights(capture.lights().size());
  std::iota(lights.begin(), lights.end(), 0);
  std::vector<float> samples(3 * lights.size() * rectangle.pixels(), -1000.0f);
  capture.read(0, rectangle, lights, samples);
  if (capture.bytes() == nullptr) return samples;
  std::vector<std::uint8_t> bytes(samples.size());
  capture.bytes()->readBytes(0, rectangle, lights, bytes);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    EXPECT_EQ(static_cast<float>(bytes[i]) / 255, samples[i]) << "sample " << i;
  return samples;
}

std::vector<float> readAll(const Capture& capture) {
  return readAll(capture, {0, 0, capture.size().width, capture.size().height});
}

void Listener::begin(std::string_view what, std::uint64_t total) {
  const std::lock_guard lock(mutex_);
  stages.emplace_back(what);
  expected += total;
  ++open;
}

void Listener::advance(std::uint64_t steps) {
  const std::lock_guard lock(mutex_);
  advanced += steps;
}

void Listener::end() {
  const std::lock_guard lock(mutex_);
  --open;
}

void Listener::remark(std::string_view sentence) {
  const std::lock_guard lock(mutex_);
  remarks.emplace_back(sentence);
}

std::vector<std::byte> bytesOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::vector<std::byte> bytes(std::filesystem::file_size(file));
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  return bytes;
}

void writeBytes(const std::filesystem::path& file, const std::vector<std::byte>& bytes) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

}  // namespace illum::test
