#include "capture/oiio_reader.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <exception>
#include <mutex>
#include <string>

#include "illum/error.h"

namespace illum {
namespace {

constexpr std::uint64_t kKibibyte = 1024;
// A TIFF strip up to this size is decoded as a whole beside the others; a larger one holds up too
// much.
constexpr std::uint64_t kLargestStripBytes = 4 * 1024 * kKibibyte;
constexpr int kRowsPerCall = 16;

// Our tasks are the threads; OpenImageIO and OpenEXR shall not start their own inside them.
void keepToCallingThread() {
  static std::once_flag once;
  std::call_once(once, [] {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
  });
}

// A file of the pool as OpenImageIO wants to see it. Faults are kept, for no exception may pass
// through the C libraries below.
class PooledProxy final : public OIIO::Filesystem::IOProxy {
 public:
  PooledProxy(FilePool& pool, std::size_t file)
      : IOProxy(pool.path(file).string(), Read), pool_(pool), file_(file) {}

  const char* proxytype() const override { return "pooled"; }
  std::size_t size() const override { return pool_.bytes(file_); }
  std::size_t read(void* buffer, std::size_t bytes) override {
    const std::size_t got = pread(buffer, bytes, m_pos);
    m_pos += static_cast<std::int64_t>(got);
    return got;
  }
  std::size_t pread(void* buffer, std::size_t bytes, std::int64_t offset) override {
    try {
      if (offset < 0) return 0;
      return pool_.read(file_, static_cast<std::uint64_t>(offset),
                        {static_cast<std::byte*>(buffer), bytes});
    } catch (...) {
      fault_ = std::current_exception();
      return 0;
    }
  }
  void rethrowFault() {
    if (fault_) std::rethrow_exception(std::exchange(fault_, nullptr));
  }

 private:
  FilePool& pool_;
  std::size_t file_;
  std::exception_ptr fault_;
};

// OpenImageIO's sentence on one line, without the full stop.
std::string oneLine(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text.empty() ? "something that cannot be decoded" : text;
}

OIIO::ImageSpec readingHints() {
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  // One exposure means one value in every photograph of the stack: nothing adapts to the picture.
  hints.attribute("raw:ColorSpace", "linear");
  hints.attribute("raw:auto_bright", 0);
  hints.attribute("raw:adjust_maximum_thr", 0.0f);
  hints.attribute("raw:use_camera_wb", 1);
  return hints;
}

// An opened picture, and the proxy that it reads through.
class OpenPicture {
 public:
  OpenPicture(FilePool& pool, std::size_t file, PhotographFormat format)
      : path_(pool.path(file)), format_(format), proxy_(pool, file) {
    keepToCallingThread();
    input_ = OIIO::ImageInput::create(std::string(readerNameOf(format)));
    if (!input_) {
      OIIO::geterror();
      throw Error(Fault::Machine, path_.string() + ": this machine's OpenImageIO reads no " +
                                      std::string(titleOf(format)) + " pictures");
    }
    if (input_->supports("ioproxy")) input_->set_ioproxy(&proxy_);
    const OIIO::ImageSpec hints = readingHints();
    check(input_->open(path_.string(), spec_, hints));
  }

  const OIIO::ImageSpec& spec() const { return spec_; }
  OIIO::ImageInput& input() { return *input_; }

  void check(bool succeeded) {
    proxy_.rethrowFault();
    // Its TIFF reader says that it succeeded where only the last strip did, but keeps the fault.
    if (succeeded && !input_->has_error()) return;
    std::string found = input_->geterror();
    if (found.empty()) found = OIIO::geterror();
    throw inputError(path_, "an undamaged " + std::string(titleOf(format_)) + " picture",
                     oneLine(found));
  }

 private:
  std::filesystem::path path_;
  PhotographFormat format_;
  PooledProxy proxy_;
  std::unique_ptr<OIIO::ImageInput> input_;
  OIIO::ImageSpec spec_;
};

// Which of the file's channels are read, in the order of our samples.
struct ChannelChoice {
  std::vector<int> channels;
  int colours = 3;
  bool alpha = false;
};

std::string_view lastPart(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string_view::npos ? name : name.substr(dot + 1);
}

int channelNamed(const OIIO::ImageSpec& spec, std::string_view name) {
  const auto found = std::ranges::find(spec.channelnames, name);
  return found == spec.channelnames.end() ? -1
                                          : static_cast<int>(found - spec.channelnames.begin());
}

// EXR files may have layers ("beauty.R"): the first one that has all three colours is read.
ChannelChoice chooseNamedChannels(const OIIO::ImageSpec& spec, const std::filesystem::path& path) {
  for (const std::string& name : spec.channelnames) {
    if (lastPart(name) != "R") continue;
    const std::string layer = name.substr(0, name.size() - 1);
    const int r = channelNamed(spec, name), g = channelNamed(spec, layer + "G"),
              b = channelNamed(spec, layer + "B"), a = channelNamed(spec, layer + "A");
    if (g < 0 || b < 0) continue;
    if (a < 0) return {{r, g, b}, 3, false};
    return {{r, g, b, a}, 3, true};
  }
  const int grey = spec.nchannels == 1 ? 0 : channelNamed(spec, "Y");
  if (grey >= 0 && channelNamed(spec, "RY") < 0) {
    const int a = channelNamed(spec, "A");
    if (a < 0) return {{grey}, 1, false};
    return {{grey, a}, 1, true};
  }
  throw inputError(path, "channels R, G, B or Y",
                   spec.channelnames.empty() ? "none" : spec.channelnames.front());
}

ChannelChoice chooseChannels(const OIIO::ImageSpec& spec, PhotographFormat format,
                             const std::filesystem::path& path) {
  if (format == PhotographFormat::OpenExr) return chooseNamedChannels(spec, path);
  const bool alpha = spec.alpha_channel >= 0 && spec.nchannels > 1;
  const int colours = spec.nchannels - (alpha ? 1 : 0) >= 3 ? 3 : 1;
  ChannelChoice choice{{}, colours, alpha};
  for (int c = 0; c < colours; ++c) choice.channels.push_back(c);
  if (alpha) choice.channels.push_back(spec.alpha_channel);
  return choice;
}

SampleType sampleTypeOf(const OIIO::ImageSpec& spec) {
  if (spec.format == OIIO::TypeUInt8) return SampleType::Byte;
  if (spec.format == OIIO::TypeUInt16) return SampleType::Word;
  return SampleType::Float;
}

OIIO::TypeDesc typeDescOf(SampleType type) {
  if (type == SampleType::Byte) return OIIO::TypeUInt8;
  if (type == SampleType::Word) return OIIO::TypeUInt16;
  return OIIO::TypeFloat;
}

// Rows that a file can only be decoded in together.
int rowsTogether(const OIIO::ImageSpec& spec, PhotographFormat format) {
  if (spec.tile_width > 0) return spec.tile_height;
  if (format == PhotographFormat::Tiff) {
    const auto rows = static_cast<std::uint64_t>(
        std::clamp(spec.get_int_attribute("tiff:RowsPerStrip", 1), 1, spec.height));
    return rows * spec.scanline_bytes(true) <= kLargestStripBytes ? static_cast<int>(rows) : 0;
  }
  if (format != PhotographFormat::OpenExr) return 1;
  // Lines of a chunk, by compression ("OpenEXR File Layout").
  const std::string compression = spec.get_string_attribute("compression");
  if (compression == "zip" || compression == "pxr24") return 16;
  if (compression == "piz" || compression == "b44" || compression == "b44a" ||
      compression.starts_with("dwaa")) {
    return 32;
  }
  return compression.starts_with("dwab") ? 256 : 1;
}

struct Cost {
  bool sequential = true;
  std::uint64_t bytes = 0;
};

// What OpenImageIO 2.4 holds while a picture is open; oiio_reader's tests hold it to what is
// measured.
Cost costOf(const OIIO::ImageSpec& spec, PhotographFormat format, std::uint64_t fileBytes,
            bool packedBmp) {
  const std::uint64_t row = spec.scanline_bytes(true) + 4u * static_cast<unsigned>(spec.width);
  const auto height = static_cast<std::uint64_t>(spec.height);
  const std::uint64_t pixels = height * static_cast<unsigned>(spec.width);
  const auto together = static_cast<unsigned>(rowsTogether(spec, format));
  switch (format) {
    case PhotographFormat::Tiff:
      if (together == 0) return {false, fileBytes + 256 * kKibibyte + (kRowsPerCall + 4) * row};
      return {spec.get_string_attribute("planarconfig") != "separate",
              256 * kKibibyte + 4 * together * row};
    case PhotographFormat::OpenExr:
      return {true, 640 * kKibibyte + 5 * together * row};
    case PhotographFormat::Bmp:
      return {!packedBmp, 64 * kKibibyte + 4 * row + (packedBmp ? row * height + fileBytes : 0)};
    case PhotographFormat::Hdr:
    case PhotographFormat::Dpx:
      return {true, 128 * kKibibyte + 4 * row};
    case PhotographFormat::Sgi:
      return {true, 128 * kKibibyte + 4 * row + 32 * height};
    case PhotographFormat::Targa:
      return {false, 64 * kKibibyte + row * (height + kRowsPerCall)};
    case PhotographFormat::Pnm:
      return {false, fileBytes + 64 * kKibibyte + kRowsPerCall * row};
    default:
      return {false, fileBytes + 24 * pixels};
  }
}

// What relates the samples to light, as far as the format itself tells.
void readTransfer(const OIIO::ImageSpec& spec, const std::filesystem::path& path,
                  PhotographHeader& header) {
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  std::string lower = space;
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (lower == "kodaklog") throw inputError(path, "linear or sRGB values", "logarithmic ones");
  if (lower == "linear" || header.format == PhotographFormat::Raw ||
      header.type == SampleType::Float) {
    header.transfer = Transfer::Linear;
    return;
  }
  const double gamma = spec.get_float_attribute("oiio:Gamma", 0.0f);
  const bool told = lower.starts_with("gamma") && std::isfinite(gamma) && gamma > 0.1 && gamma < 10;
  // 1/0.45455, as most programs write it, means sRGB.
  if (!told || std::abs(gamma - 2.2) < 0.05) return;
  if (std::abs(gamma - 1) < 0.01) {
    header.transfer = Transfer::Linear;
  } else {
    header.gamma = gamma;
  }
}

std::vector<std::byte> profileOf(const OIIO::ImageSpec& spec) {
  const OIIO::ParamValue* profile = spec.find_attribute("ICCProfile");
  if (profile == nullptr || profile->type().basesize() != 1) return {};
  const auto* bytes = static_cast<const std::byte*>(profile->data());
  return {bytes, bytes + profile->datasize()};
}

void refuseWhatIsNoPhotograph(const OIIO::ImageSpec& spec, const std::filesystem::path& path) {
  if (spec.width < 1 || spec.height < 1) throw inputError(path, "a picture", "an empty one");
  if (spec.deep || spec.depth > 1) throw inputError(path, "a flat picture", "a deep one");
  if (spec.nchannels < 1) throw inputError(path, "a picture with channels", "none");
  if (spec.get_int_attribute("tiff:PhotometricInterpretation", 0) == 5 ||
      spec.get_string_attribute("tiff:ColorSpace") == "CMYK") {
    throw inputError(path, "a grey or RGB picture", "one for print (CMYK)");
  }
  const bool cropped =
      spec.full_width > 0 && (spec.x != spec.full_x || spec.y != spec.full_y ||
                              spec.width != spec.full_width || spec.height != spec.full_height);
  if (cropped) {
    throw inputError(path, "a data window equal to the display window", "a cropped picture");
  }
}

bool isPackedBmp(std::span<const std::byte> head) {
  constexpr std::size_t kCompressionAt = 30;
  if (head.size() <= kCompressionAt) return false;
  const auto compression = std::to_integer<int>(head[kCompressionAt]);
  return compression == 1 || compression == 2;
}

class OiioReader final : public PhotographReader {
 public:
  OiioReader(FilePool& pool, std::size_t file, const PhotographHeader& header)
      : header_(header), path_(pool.path(file)), picture_(pool, file, header.format) {
    const OIIO::ImageSpec& spec = picture_.spec();
    choice_ = chooseChannels(spec, header.format, path_);
    if (spec.width != header.stored.width || spec.height != header.stored.height ||
        sampleTypeOf(spec) != header.type || choice_.colours != header.colours ||
        choice_.alpha != header.alpha) {
      throw inputError(path_, "the photograph that was there at the beginning", "another");
    }
    const auto [low, high] = std::ranges::minmax(choice_.channels);
    firstChannel_ = low;
    channelsRead_ = high + 1 - low;
    const bool premultiplies =
        header.format == PhotographFormat::OpenExr || header.format == PhotographFormat::Tiff;
    premultiplied_ =
        header.alpha && premultiplies && spec.get_int_attribute("oiio:UnassociatedAlpha", 0) == 0;
    rowsPerChunk_ = std::max(rowsTogether(spec, header.format), 1);
    if (rowsPerChunk_ == 1) rowsPerChunk_ = kRowsPerCall;
  }

  void read(int rows, std::byte* samples) override {
    const std::size_t rowBytes = header_.rowBytes();
    for (int done = 0; done < rows;) {
      if (row_ == chunkEnd_) readChunk();
      const int count = std::min(rows - done, chunkEnd_ - row_);
      for (int i = 0; i < count; ++i) {
        takeRow(row_ + i, samples + static_cast<std::size_t>(done + i) * rowBytes);
      }
      row_ += count;
      done += count;
    }
  }

 private:
  std::size_t chunkRowBytes() const {
    return static_cast<std::size_t>(header_.stored.width) *
           static_cast<std::size_t>(channelsRead_) * bytesOf(header_.type);
  }

  void readChunk() {
    const OIIO::ImageSpec& spec = picture_.spec();
    chunkBegin_ = chunkEnd_;
    chunkEnd_ = std::min(chunkBegin_ + rowsPerChunk_, header_.stored.height);
    chunk_.resize(chunkRowBytes() * static_cast<std::size_t>(chunkEnd_ - chunkBegin_));
    const int top = spec.y + chunkBegin_, bottom = spec.y + chunkEnd_;
    const int channelsEnd = firstChannel_ + channelsRead_;
    const OIIO::TypeDesc type = typeDescOf(header_.type);
    OIIO::ImageInput& input = picture_.input();
    picture_.check(spec.tile_width > 0
                       ? input.read_tiles(0, 0, spec.x, spec.x + spec.width, top, bottom, spec.z,
                                          spec.z + 1, firstChannel_, channelsEnd, type,
                                          chunk_.data())
                       : input.read_scanlines(0, 0, top, bottom, spec.z, firstChannel_, channelsEnd,
                                              type, chunk_.data()));
  }

  void takeRow(int row, std::byte* samples) const {
    const std::byte* stored =
        chunk_.data() + static_cast<std::size_t>(row - chunkBegin_) * chunkRowBytes();
    switch (header_.type) {
      case SampleType::Byte:
        return takeSamples<std::uint8_t>(stored, samples);
      case SampleType::Word:
        return takeSamples<std::uint16_t>(stored, samples);
      case SampleType::Float:
        return takeSamples<float>(stored, samples);
    }
  }

  template <typename T>
  void takeSamples(const std::byte* storedBytes, std::byte* sampleBytes) const {
    const int channels = header_.channels();
    if (channels == channelsRead_ && std::ranges::is_sorted(choice_.channels)) {
      std::memcpy(sampleBytes, storedBytes, header_.rowBytes());
    } else {
      for (int x = 0; x < header_.stored.width; ++x) {
        for (int c = 0; c < channels; ++c) {
          const int from =
              x * channelsRead_ + choice_.channels[static_cast<std::size_t>(c)] - firstChannel_;
          std::memcpy(sampleBytes + static_cast<std::size_t>(x * channels + c) * sizeof(T),
                      storedBytes + static_cast<std::size_t>(from) * sizeof(T), sizeof(T));
        }
      }
    }
    if (premultiplied_) divideByAlpha<T>(sampleBytes);
  }

  template <typename T>
  void divideByAlpha(std::byte* sampleBytes) const {
    T* samples = reinterpret_cast<T*>(sampleBytes);
    const int channels = header_.channels();
    constexpr float kWhite = std::is_integral_v<T> ? static_cast<float>(static_cast<T>(~0u)) : 1.0f;
    for (int x = 0; x < header_.stored.width; ++x, samples += channels) {
      const auto alpha = static_cast<float>(samples[channels - 1]);
      if (!(alpha > 0)) continue;
      for (int c = 0; c + 1 < channels; ++c) {
        const float straight = static_cast<float>(samples[c]) * (kWhite / alpha);
        if constexpr (std::is_integral_v<T>) {
          samples[c] = static_cast<T>(std::min(straight, kWhite) + 0.5f);
        } else {
          samples[c] = straight;
        }
      }
    }
  }

  PhotographHeader header_;
  std::filesystem::path path_;
  OpenPicture picture_;
  ChannelChoice choice_;
  int firstChannel_ = 0, channelsRead_ = 0, rowsPerChunk_ = 1;
  bool premultiplied_ = false;
  std::vector<std::byte> chunk_;
  int row_ = 0, chunkBegin_ = 0, chunkEnd_ = 0;
};

}  // namespace

PhotographHeader readOiioHeader(FilePool& pool, std::size_t file, PhotographFormat format,
                                std::span<const std::byte> head) {
  const std::filesystem::path path = pool.path(file);
  OpenPicture picture(pool, file, format);
  const OIIO::ImageSpec& spec = picture.spec();
  refuseWhatIsNoPhotograph(spec, path);

  PhotographHeader header;
  header.format = format;
  header.stored = {spec.width, spec.height};
  const int orientation = spec.get_int_attribute("Orientation", 1);
  header.orientation = {orientation >= 1 && orientation <= 8 ? orientation : 1};
  const ChannelChoice choice = chooseChannels(spec, format, path);
  header.colours = choice.colours;
  header.alpha = choice.alpha;
  header.type = sampleTypeOf(spec);
  header.profile = profileOf(spec);
  readTransfer(spec, path, header);
  const Cost cost =
      costOf(spec, format, pool.bytes(file), format == PhotographFormat::Bmp && isPackedBmp(head));
  header.sequential = cost.sequential;
  // Our own chunk of rows comes on top, as does the header's copy.
  header.decoderBytes =
      cost.bytes + header.profile.size() +
      header.rowBytes() * static_cast<unsigned>(std::max(rowsTogether(spec, format), kRowsPerCall));
  return header;
}

std::unique_ptr<PhotographReader> openOiioReader(FilePool& pool, std::size_t file,
                                                 const PhotographHeader& header) {
  return std::make_unique<OiioReader>(pool, file, header);
}

}  // namespace illum
