// Pictures on surfaces, by OpenImageIO.
#pragma once

#include "oiio/oiio_module.h"

namespace illum {

/// `reader`: OpenImageIO's name of the format. `checkSize` gets everything but the samples before
/// memory is asked for, and throws what it does not want. Throws Error naming the picture.
OiioTexture readOiioTexture(std::span<const std::byte> bytes, const std::string& name,
                            const char* reader,
                            const std::function<void(const OiioTexture&)>& checkSize);

}  // namespace illum
