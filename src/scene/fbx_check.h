// What assimp 5.2 follows in an FBX file until its stack ends.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace illum {

/// `file`: text or binary. Throws Error (Fault::Input) naming `source` for records that nest too
/// deep, and unless the models hang from one another as trees of bounded depth. All else is left to
/// assimp, a file that is cut off as well. Untrusted input is safe.
void checkFbx(std::span<const std::byte> file, const std::string& source);

}  // namespace illum
