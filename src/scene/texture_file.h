// Pictures on surfaces, of all the formats that mesh files bring along.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "scene/scene.h"

namespace illum {

/// Colours of 8 and 16 bits are decoded from sRGB; roughness, metal and normals are taken as they
/// are. Floats are linear.
enum class TextureUse { Colour, Data };

/// Reads a picture (PNG, JPEG, WebP, TIFF, BMP, TGA, GIF, OpenEXR, Radiance). Throws Error naming
/// the file. Untrusted input is safe: sizes are checked before memory is allocated.
Texture readTexture(const std::filesystem::path& file, TextureUse use);

/// The same of a picture in memory; `name` is for messages.
Texture textureFromBytes(std::span<const std::byte> bytes, const std::string& name, TextureUse use);

}  // namespace illum
