// Renames that lose nothing: what is finished takes its place in one step.
#pragma once

#include <filesystem>

namespace illum {

/// Throws Error (Fault::Input) if `to` is there, which then stays as it was; Fault::Machine for
/// whatever else goes wrong.
void renameToNew(const std::filesystem::path& from, const std::filesystem::path& to);

/// Puts `from`, a file or a folder, in the place of `to`, a file or a folder. The old one is then
/// at `from`, or at `aside` where the file system cannot exchange. Throws Error (Fault::Machine).
void exchange(const std::filesystem::path& from, const std::filesystem::path& to,
              const std::filesystem::path& aside);

}  // namespace illum
