#include "scene/oiio_texture.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>

#include "illum/error.h"

namespace illum {
namespace {

Error damaged(const std::string& name, std::string found) {
  std::ranges::replace_if(
      found, [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
  return inputError(name, "a picture", found.empty() ? "something that cannot be decoded" : found);
}

}  // namespace

OiioTexture readOiioTexture(std::span<const std::byte> bytes, const std::string& name,
                            const char* reader,
                            const std::function<void(const OiioTexture&)>& checkSize) {
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(reader);
  if (!input) throw damaged(name, OIIO::geterror());
  // The proxy only reads, whatever its interface says.
  OIIO::Filesystem::IOMemReader proxy(const_cast<std::byte*>(bytes.data()), bytes.size());
  if (!input->supports("ioproxy") || !input->set_ioproxy(&proxy))
    throw damaged(name, fmt::format("a {} picture, which this machine's OpenImageIO reads only "
                                    "from files",
                                    reader));
  OIIO::ImageSpec spec, hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  if (!input->open(name, spec, hints)) throw damaged(name, input->geterror());
  OiioTexture texture{spec.width,
                      spec.depth <= 1 ? spec.height : 0,
                      spec.nchannels,
                      spec.format.is_floating_point(),
                      {}};
  checkSize(texture);
  texture.samples.resize(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, texture.samples.data()) ||
      input->has_error())
    throw damaged(name, input->geterror());
  return texture;
}

}  // namespace illum
