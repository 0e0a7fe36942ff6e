#include "core/memory.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "illum/error.h"

namespace illum {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

char lowered(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// The power of 1024 that a unit stands for, or -1. Takes "", "b", "k", "kb", "kib", …, any case.
int unitPower(std::string_view unit) {
  std::string name(unit);
  std::transform(name.begin(), name.end(), name.begin(), lowered);
  if (name.empty() || name == "b") return 0;
  const std::size_t power = std::string_view("kmgt").find(name.front());
  const std::string_view rest = std::string_view(name).substr(1);
  const bool known = rest.empty() || rest == "b" || rest == "ib";
  return power == std::string_view::npos || !known ? -1 : static_cast<int>(power) + 1;
}

std::string textOf(const fs::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return std::move(text).str();
}

/// A limit file holds a number or "max"; a missing one means no limit.
std::uint64_t limitInFile(const fs::path& file) {
  const std::string text = textOf(file);
  std::uint64_t limit = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), limit);
  return result.ec == std::errc() ? limit : kNoLimit;
}

std::uint64_t lowestLimitUpward(const fs::path& root, fs::path group, const char* fileName) {
  std::uint64_t lowest = limitInFile(root / fileName);
  for (; group.has_relative_path(); group = group.parent_path())
    lowest = std::min(lowest, limitInFile(root / group.relative_path() / fileName));
  return lowest;
}

bool listContains(std::string_view list, std::string_view item) {
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    if (list.substr(0, comma) == item) return true;
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
  return false;
}

}  // namespace

std::uint64_t bytesFromText(std::string_view text) {
  const auto fail = [&](std::string_view why) {
    return Error(Fault::Usage, fmt::format("expected a size such as 512M or 1.5G, found '{}'{}",
                                           text.substr(0, 40), why));
  };
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number, std::chars_format::fixed);
  if (error != std::errc() || !std::isfinite(number) || number < 0) throw fail("");
  std::string_view unit(rest, static_cast<std::size_t>(end - rest));
  unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));
  const int power = unitPower(unit);
  if (power < 0) throw fail("");
  const double bytes = std::ldexp(number, 10 * power);
  if (bytes >= 0x1p63) throw fail(", which is too large");
  return static_cast<std::uint64_t>(bytes);
}

std::string textFromBytes(std::uint64_t bytes) {
  constexpr std::array<const char*, 5> kUnits = {"B", "KiB", "MiB", "GiB", "TiB"};
  if (bytes < 1024) return fmt::format("{} B", bytes);
  std::size_t unit = 0;
  auto value = static_cast<double>(bytes);
  // 1023.95 would be printed as 1024.0.
  while (value >= 1023.95 && unit + 1 < kUnits.size()) {
    value /= 1024;
    ++unit;
  }
  return fmt::format("{:.1f} {}", value, kUnits[unit]);
}

// Membership lines are "ID:CONTROLLERS:GROUP" (proc manual, cgroups(7)); version 2 has no
// controllers.
std::uint64_t controlGroupLimitBytes(const fs::path& mountPoint, std::string_view membership) {
  std::uint64_t lowest = kNoLimit;
  std::istringstream lines{std::string(membership)};
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string_view controllers =
        std::string_view(line).substr(first + 1, second - first - 1);
    const fs::path group = line.substr(second + 1);
    if (controllers.empty()) {
      lowest = std::min(lowest, lowestLimitUpward(mountPoint, group, "memory.max"));
    } else if (listContains(controllers, "memory")) {
      lowest = std::min(lowest,
                        lowestLimitUpward(mountPoint / "memory", group, "memory.limit_in_bytes"));
    }
  }
  return lowest;
}

std::uint64_t machineMemoryBytes() {
  const auto physical = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                        static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  return std::min(physical, controlGroupLimitBytes("/sys/fs/cgroup", textOf("/proc/self/cgroup")));
}

}  // namespace illum
