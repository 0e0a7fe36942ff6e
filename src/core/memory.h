// Memory sizes as people write them, and what the machine has.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace illum {

/// "512M", "2G", "1.5GiB", "800000k", "1073741824": bytes, K/M/G/T are powers of 1024. Throws
/// Error (Fault::Usage).
std::uint64_t bytesFromText(std::string_view text);
/// "1.5 GiB"
std::string textFromBytes(std::uint64_t bytes);

/// Physical memory, or the control group's limit where that is lower.
std::uint64_t machineMemoryBytes();

/// The lowest memory limit on the way from a process's control group up to the root of the
/// hierarchy; UINT64_MAX if there is none. `mountPoint` is where control groups appear
/// (/sys/fs/cgroup), `membership` the text of /proc/PID/cgroup; versions 1 and 2.
std::uint64_t controlGroupLimitBytes(const std::filesystem::path& mountPoint,
                                     std::string_view membership);

}  // namespace illum
