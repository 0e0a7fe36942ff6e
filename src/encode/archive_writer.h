// Packing files into a zip archive whose bytes depend on nothing but names and contents.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace illum {

/// Writes `archive` anew from `folder`/NAME for every name, in the given order: no clock, no
/// permissions, no paths but the names. object.json is deflated, all else is stored.
/// Flushed to the disk. Throws Error (Fault::Machine).
void writeArchive(const std::filesystem::path& archive, const std::filesystem::path& folder,
                  std::span<const std::string> names);

}  // namespace illum
