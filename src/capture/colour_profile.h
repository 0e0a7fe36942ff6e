// Embedded colour profiles: from the file's colours to sRGB or linear Rec.709.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <tuple>

#include "capture/photo_reader.h"

namespace illum {

/// Converts rows of samples from one colour space to another. Thread safe.
class ColourConversion {
 public:
  virtual ~ColourConversion() = default;
  /// `pixels` pixels with the source's channels and type; alpha is copied.
  virtual void apply(const std::byte* source, std::byte* samples, int pixels) const = 0;
};

/// What a photograph's samples are after its profile has been honoured.
struct ProfiledColour {
  SampleType type = SampleType::Byte;
  Transfer transfer = Transfer::Display;
  std::shared_ptr<const ColourConversion> conversion;  ///< null: samples stay as the file has them
};

/// Looks at the profiles of a stack, which are mostly the same one: equal profiles share a
/// conversion.
class ColourProfiles {
 public:
  /// Profiles that are sRGB, or linear with Rec.709's colours, convert nothing. Others give linear
  /// Rec.709 for float samples and for profiles that are linear themselves, sRGB otherwise; bytes
  /// become words, so that nothing is lost. The profile of a grey picture must be a grey one to be
  /// of use. Throws Error naming `file` for a damaged profile. Untrusted input is safe.
  const ProfiledColour& colourOf(const std::filesystem::path& file, const PhotographHeader& header);

 private:
  using Key = std::tuple<std::string, int, bool, SampleType, Transfer, double>;
  std::map<Key, ProfiledColour> known_;
};

}  // namespace illum
