#include "object/entry_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace illum {
namespace {

constexpr std::size_t kMaxNameBytes = 255;
constexpr std::size_t kMaxDigits = 7;

/// Takes a number without sign or leading zeros from the front of `text`.
std::optional<int> takeNumber(std::string_view& text) {
  const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
  if (digits == 0 || digits > kMaxDigits || (digits > 1 && text.front() == '0')) return {};
  int number = 0;
  std::from_chars(text.data(), text.data() + digits, number);
  text.remove_prefix(digits);
  return number;
}

bool take(std::string_view& text, std::string_view expected) {
  if (!text.starts_with(expected)) return false;
  text.remove_prefix(expected.size());
  return true;
}

/// "GROUP/LEVEL/X_Y", leaving the suffix.
std::optional<EntryKey> takeTile(EntryKey::Kind kind, std::string_view& text) {
  const auto group = takeNumber(text);
  if (!group || !take(text, "/")) return {};
  const auto level = takeNumber(text);
  if (!level || !take(text, "/")) return {};
  const auto x = takeNumber(text);
  if (!x || !take(text, "_")) return {};
  const auto y = takeNumber(text);
  if (!y) return {};
  return EntryKey{kind, *group, *level, *y, *x};
}

bool isSafePart(std::string_view part) {
  return !part.empty() && part != "." && part != "..";
}

bool isSafeCharacter(char c) {
  return c != '\\' && c != ':' && static_cast<unsigned char>(c) >= 0x20 && c != 0x7f;
}

}  // namespace

std::optional<EntryKey> entryKeyOf(std::string_view name) {
  if (name == kManifestEntry) return EntryKey{EntryKey::Kind::Manifest};
  if (name == kBasisEntry) return EntryKey{EntryKey::Kind::Basis};
  if (name == kPosterEntry) return EntryKey{EntryKey::Kind::Poster};

  EntryKey::Kind kind = EntryKey::Kind::Planes;
  if (take(name, "depth/"))
    kind = EntryKey::Kind::Depth;
  else if (take(name, "mask/"))
    kind = EntryKey::Kind::Mask;
  else if (!take(name, "planes/"))
    return {};
  const auto key = takeTile(kind, name);
  const bool suffixFits =
      name == ".png" || (kind == EntryKey::Kind::Planes && (name == ".avif" || name == ".jpg"));
  return suffixFits ? key : std::nullopt;
}

std::string tileEntryName(std::string_view folder, int group, int level, int x, int y,
                          std::string_view suffix) {
  return fmt::format("{}/{}/{}/{}_{}{}", folder, group, level, x, y, suffix);
}

bool isSafeEntryName(std::string_view name) {
  if (name.empty() || name.size() > kMaxNameBytes) return false;
  if (!std::all_of(name.begin(), name.end(), isSafeCharacter)) return false;
  if (name.back() == '/') name.remove_suffix(1);
  for (;;) {
    const std::size_t slash = name.find('/');
    if (!isSafePart(name.substr(0, slash))) return false;
    if (slash == std::string_view::npos) return true;
    name.remove_prefix(slash + 1);
  }
}

bool entryNameLess(std::string_view a, std::string_view b) {
  const auto keyA = entryKeyOf(a), keyB = entryKeyOf(b);
  if (keyA && keyB && *keyA != *keyB) return *keyA < *keyB;
  if (keyA.has_value() != keyB.has_value()) return keyA.has_value();
  return a < b;
}

bool mayBeDeflated(std::string_view name) {
  return name == kManifestEntry || name == kBasisEntry;
}

}  // namespace illum
