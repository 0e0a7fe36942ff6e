#include "capture/oiio_picture.h"

#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <exception>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include "illum/error.h"

namespace illum {
namespace {

// A TIFF strip up to this size is decoded as a whole beside the others; a larger one holds up too
// much.
constexpr std::uint64_t kLargestStripBytes = std::uint64_t{4} << 20;

// Our tasks are the threads; OpenImageIO and OpenEXR shall not start their own inside them.
void keepToCallingThread() {
  static std::once_flag once;
  std::call_once(once, [] {
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
  });
}

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
OiioChannels chooseNamedChannels(const OIIO::ImageSpec& spec, const std::filesystem::path& path) {
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

}  // namespace

// A file of the pool as OpenImageIO wants to see it. Faults are kept, for no exception may pass
// through the C libraries below.
class OiioPicture::Proxy final : public OIIO::Filesystem::IOProxy {
 public:
  Proxy(FilePool& pool, std::size_t file)
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

OiioPicture::OiioPicture(FilePool& pool, std::size_t file, PhotographFormat format)
    : path_(pool.path(file)), format_(format), proxy_(std::make_unique<Proxy>(pool, file)) {
  keepToCallingThread();
  input_ = OIIO::ImageInput::create(std::string(readerNameOf(format)));
  if (!input_) {
    OIIO::geterror();
    throw Error(Fault::Machine, path_.string() + ": this machine's OpenImageIO reads no " +
                                    std::string(titleOf(format)) + " pictures");
  }
  if (input_->supports("ioproxy")) input_->set_ioproxy(proxy_.get());
  const OIIO::ImageSpec hints = readingHints();
  check(input_->open(path_.string(), spec_, hints));
}

OiioPicture::~OiioPicture() = default;

void OiioPicture::check(bool succeeded) {
  proxy_->rethrowFault();
  // Its TIFF reader says that it succeeded where only the last strip did, but keeps the fault.
  if (succeeded && !input_->has_error()) return;
  std::string found = input_->geterror();
  if (found.empty()) found = OIIO::geterror();
  // What follows in further lines are consequences.
  throw inputError(path_, "an undamaged " + std::string(titleOf(format_)) + " picture",
                   oneLine(found.substr(0, found.find('\n'))));
}

OiioChannels chooseChannels(const OIIO::ImageSpec& spec, PhotographFormat format,
                            const std::filesystem::path& path) {
  if (format == PhotographFormat::OpenExr) return chooseNamedChannels(spec, path);
  const bool alpha = spec.alpha_channel >= 0 && spec.nchannels > 1;
  const int colours = spec.nchannels - (alpha ? 1 : 0) >= 3 ? 3 : 1;
  OiioChannels choice{{}, colours, alpha};
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

}  // namespace illum
