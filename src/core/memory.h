// Memory sizes as people write them, and what the machine has.
#pragma once

#include <cstdint>
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

}  // namespace illum
