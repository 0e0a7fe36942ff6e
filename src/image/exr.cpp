#include <Imath/ImathBox.h>
#include <Imath/ImathMatrix.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>

#include "illum/error.h"
#include "image/exr_header.h"
#include "image/formats.h"

namespace illum {
namespace {

class MemoryInput : public Imf::IStream {
 public:
  MemoryInput(std::span<const std::byte> bytes, const std::string& name)
      : Imf::IStream(name.c_str()), bytes_(bytes) {}

  bool read(char* out, int count) override {
    const auto wanted = static_cast<std::size_t>(count);
    if (count < 0 || position_ > bytes_.size() || wanted > bytes_.size() - position_)
      throw std::runtime_error("the file ends early");
    std::memcpy(out, bytes_.data() + position_, wanted);
    position_ += wanted;
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  std::span<const std::byte> bytes_;
  std::uint64_t position_ = 0;
};

class MemoryOutput : public Imf::OStream {
 public:
  MemoryOutput() : Imf::OStream("OpenEXR picture") {}

  void write(const char* data, int count) override {
    const auto length = static_cast<std::size_t>(count);
    if (bytes_.size() < position_ + length) bytes_.resize(position_ + length);
    std::memcpy(bytes_.data() + position_, data, length);
    position_ += length;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
  std::uint64_t position_ = 0;
};

/// The names of a picture's channels in our order: Y, or R G B, and A.
std::vector<const char*> channelNames(bool grey, bool alpha) {
  std::vector<const char*> names =
      grey ? std::vector<const char*>{"Y"} : std::vector<const char*>{"R", "G", "B"};
  if (alpha) names.push_back("A");
  return names;
}

std::vector<const char*> channelsOf(const Imf::Header& header,
                                    const std::filesystem::path& source) {
  const Imf::ChannelList& channels = header.channels();
  const auto has = [&](const char* name) { return channels.findChannel(name) != nullptr; };
  const bool colour = has("R") && has("G") && has("B");
  if (!colour && (!has("Y") || has("RY") || has("BY")))
    throw inputError(source, "channels R, G, B or Y", "others");
  const auto names = channelNames(!colour, has("A"));
  for (const char* name : names)
    if (channels[name].xSampling != 1 || channels[name].ySampling != 1)
      throw inputError(source, "channels at full resolution", std::string(name) + " subsampled");
  return names;
}

/// A frame buffer that spreads named channels over the samples of a picture whose first pixel is
/// `origin`.
template <typename Sample>
Imf::FrameBuffer frameBuffer(PictureOf<Sample>& picture, const std::vector<const char*>& names,
                             Imath::V2i origin) {
  constexpr Imf::PixelType kType = sizeof(Sample) == sizeof(float) ? Imf::FLOAT : Imf::HALF;
  const std::size_t pixelBytes = static_cast<std::size_t>(picture.channels()) * sizeof(Sample);
  const std::size_t rowBytes = pixelBytes * static_cast<std::size_t>(picture.width());
  const Imath::Box2i window(origin, origin + Imath::V2i(picture.width() - 1, picture.height() - 1));
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < names.size(); ++c)
    buffer.insert(names[c], Imf::Slice::Make(kType, picture.samples().data() + c, window,
                                             pixelBytes, rowBytes));
  return buffer;
}

/// Grey with alpha has no form of its own among pictures; it becomes RGB with alpha.
Picture withGreyAsRgb(const Picture& greyAlpha) {
  Picture picture(greyAlpha.size(), 4);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x)
      for (int c = 0; c < 4; ++c) picture.at(x, y, c) = greyAlpha.at(x, y, c == 3 ? 1 : 0);
  return picture;
}

/// Colorimetric: the white of the file keeps its colour. Imath's vectors are rows.
void convertToRec709(Picture& picture, const Imf::Chromaticities& from) {
  const Imath::M44f matrix = Imf::RGBtoXYZ(from, 1) * Imf::XYZtoRGB(Imf::Chromaticities(), 1);
  const auto channels = static_cast<std::size_t>(picture.channels());
  const std::span<float> samples = picture.samples();
  for (std::size_t i = 0; i < samples.size(); i += channels) {
    const Imath::V3f converted = Imath::V3f(samples[i], samples[i + 1], samples[i + 2]) * matrix;
    for (int c = 0; c < 3; ++c) samples[i + static_cast<std::size_t>(c)] = converted[c];
  }
}

bool isRec709(const Imf::Chromaticities& colours) {
  const Imf::Chromaticities rec709;  // the default of the library
  const auto near = [](Imath::V2f a, Imath::V2f b) { return a.equalWithAbsError(b, 1e-4F); };
  return near(colours.red, rec709.red) && near(colours.green, rec709.green) &&
         near(colours.blue, rec709.blue) && near(colours.white, rec709.white);
}

Picture readWhole(std::span<const std::byte> bytes, const std::filesystem::path& source) {
  checkExrHeader(bytes, source);
  MemoryInput stream(bytes, source.string());
  Imf::InputFile file(stream, 0);
  const Imf::Header& header = file.header();
  const auto names = channelsOf(header, source);
  const Imath::Box2i window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  checkPictureSize(source, width, height, static_cast<int>(names.size()), bytes.size(),
                   kExrSamplesPerByte);

  Picture picture({static_cast<int>(width), static_cast<int>(height)},
                  static_cast<int>(names.size()));
  file.setFrameBuffer(frameBuffer(picture, names, window.min));
  file.readPixels(window.min.y, window.max.y);
  if (names.size() == 2) return withGreyAsRgb(picture);
  if (names.size() >= 3 && Imf::hasChromaticities(header) && !isRec709(Imf::chromaticities(header)))
    convertToRec709(picture, Imf::chromaticities(header));
  return picture;
}

PictureOf<half> halvesOf(const Picture& picture) {
  PictureOf<half> halves(picture.size(), picture.channels());
  std::transform(picture.samples().begin(), picture.samples().end(), halves.samples().begin(),
                 [](float value) {
                   if (std::isfinite(value) && std::abs(value) > HALF_MAX)
                     throw Error(Fault::Input,
                                 fmt::format("half precision: expected values to {}, found {}",
                                             HALF_MAX, value));
                   return half(value);
                 });
  return halves;
}

template <typename Sample>
std::vector<std::byte> encodeSamples(const PictureOf<Sample>& picture, Imf::PixelType type) {
  const auto names = channelNames(picture.channels() == 1, picture.channels() == 4);
  Imf::Header header(picture.width(), picture.height());
  header.compression() = Imf::ZIP_COMPRESSION;
  Imf::addChromaticities(header, Imf::Chromaticities());
  for (const char* name : names) header.channels().insert(name, Imf::Channel(type));

  MemoryOutput stream;
  {
    Imf::OutputFile file(stream, header, 0);
    // Only read from: the library has one kind of frame buffer for both ways.
    file.setFrameBuffer(
        frameBuffer(const_cast<PictureOf<Sample>&>(picture), names, Imath::V2i(0, 0)));
    file.writePixels(picture.height());
  }
  return stream.take();
}

}  // namespace

Picture decodeExr(std::span<const std::byte> bytes, const std::filesystem::path& source) {
  try {
    return readWhole(bytes, source);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    std::string reason = error.what();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw inputError(source, "a sound OpenEXR picture", reason);
  }
}

std::vector<std::byte> encodeExr(const Picture& linear, ExrSamples samples) {
  return samples == ExrSamples::Float ? encodeSamples(linear, Imf::FLOAT)
                                      : encodeSamples(halvesOf(linear), Imf::HALF);
}

}  // namespace illum
