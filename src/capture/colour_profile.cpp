#include "capture/colour_profile.h"

#include <lcms2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "illum/error.h"

namespace illum {
namespace {

struct CloseProfile {
  void operator()(void* profile) const { cmsCloseProfile(profile); }
};
using Profile = std::unique_ptr<void, CloseProfile>;
struct DeleteTransform {
  void operator()(void* transform) const { cmsDeleteTransform(transform); }
};
using Transform = std::unique_ptr<void, DeleteTransform>;
struct FreeCurve {
  void operator()(cmsToneCurve* curve) const { cmsFreeToneCurve(curve); }
};
using Curve = std::unique_ptr<cmsToneCurve, FreeCurve>;

// Half a step of 8 bits: what nobody sees, and more than sRGB profiles of different makers differ
// by.
constexpr float kSameColour = 0.5f / 255;

constexpr cmsCIExyY kD65{0.3127, 0.3290, 1.0};
constexpr cmsCIExyYTRIPLE kRec709{{0.64, 0.33, 1.0}, {0.30, 0.60, 1.0}, {0.15, 0.06, 1.0}};

Curve powerCurve(double gamma) {
  return Curve(cmsBuildGamma(nullptr, gamma));
}

// IEC 61966-2-1 as ICC's parametric curve of type 4: x >= d ? (a x + b)^g : c x.
Curve displayCurve() {
  constexpr std::array<cmsFloat64Number, 5> kParameters{2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92,
                                                        0.04045};
  return Curve(cmsBuildParametricToneCurve(nullptr, 4, kParameters.data()));
}

Profile profileWith(const Curve& curve, int colours) {
  if (colours == 1) return Profile(cmsCreateGrayProfile(cmsD50_xyY(), curve.get()));
  std::array<cmsToneCurve*, 3> curves{curve.get(), curve.get(), curve.get()};
  return Profile(cmsCreateRGBProfile(&kD65, &kRec709, curves.data()));
}

Profile targetProfile(Transfer transfer, int colours) {
  return profileWith(transfer == Transfer::Linear ? powerCurve(1) : displayCurve(), colours);
}

cmsUInt32Number pixelFormat(int colours, bool alpha, SampleType type) {
  const auto space = static_cast<cmsUInt32Number>(colours == 1 ? PT_GRAY : PT_RGB);
  return COLORSPACE_SH(space) | CHANNELS_SH(static_cast<cmsUInt32Number>(colours)) |
         EXTRA_SH(alpha ? 1u : 0u) | BYTES_SH(static_cast<cmsUInt32Number>(bytesOf(type))) |
         FLOAT_SH(type == SampleType::Float ? 1u : 0u);
}

Transform makeTransform(const Profile& from, cmsUInt32Number fromFormat, const Profile& to,
                        cmsUInt32Number toFormat, cmsUInt32Number flags) {
  return Transform(cmsCreateTransform(from.get(), fromFormat, to.get(), toFormat,
                                      INTENT_RELATIVE_COLORIMETRIC, flags | cmsFLAGS_NOCACHE));
}

class ProfileConversion final : public ColourConversion {
 public:
  explicit ProfileConversion(Transform transform) : transform_(std::move(transform)) {}
  void apply(const std::byte* source, std::byte* samples, int pixels) const override {
    cmsDoTransform(transform_.get(), source, samples, static_cast<cmsUInt32Number>(pixels));
  }

 private:
  Transform transform_;
};

// Colours on a grid over the cube, or greys, as the source has them and as the target would.
struct Comparison {
  float largestDifference = 0;  // over all colours
  float largestGreyDifference =
      0;  // over the greys, of the channels' mean: the transfer function alone
};

bool compare(const Profile& source, const Profile& target, int colours, Comparison& result) {
  const cmsUInt32Number format = pixelFormat(colours, false, SampleType::Float);
  const Transform transform = makeTransform(source, format, target, format, cmsFLAGS_NOOPTIMIZE);
  if (!transform) return false;
  constexpr int kSteps = 9;
  const int count = colours == 1 ? kSteps : kSteps * kSteps * kSteps;
  for (int i = 0; i < count; ++i) {
    std::array<float, 3> in{}, out{};
    for (int c = 0, rest = i; c < colours; ++c, rest /= kSteps) {
      in[static_cast<std::size_t>(c)] = static_cast<float>(rest % kSteps) / (kSteps - 1);
    }
    cmsDoTransform(transform.get(), in.data(), out.data(), 1);
    float sum = 0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(colours); ++c) {
      result.largestDifference = std::max(result.largestDifference, std::abs(out[c] - in[c]));
      sum += out[c];
    }
    const bool grey = colours == 1 || (in[0] == in[1] && in[1] == in[2]);
    if (grey) {
      const float mean = sum / static_cast<float>(colours);
      result.largestGreyDifference = std::max(result.largestGreyDifference, std::abs(mean - in[0]));
    }
  }
  return std::isfinite(result.largestDifference);
}

Profile sourceProfile(const PhotographHeader& header) {
  if (!header.profile.empty()) {
    return Profile(cmsOpenProfileFromMem(header.profile.data(),
                                         static_cast<cmsUInt32Number>(header.profile.size())));
  }
  return profileWith(powerCurve(header.gamma), header.colours);
}

// A profile for another kind of picture than the one it stands in says nothing about its samples.
bool describesSamples(const Profile& profile, int colours) {
  return cmsGetColorSpace(profile.get()) == (colours == 1 ? cmsSigGrayData : cmsSigRgbData);
}

// Nothing if the profile is readable but leads nowhere.
std::optional<ProfiledColour> convert(const Profile& source, const PhotographHeader& header) {
  Comparison toLinear, toDisplay;
  if (!compare(source, targetProfile(Transfer::Linear, header.colours), header.colours, toLinear) ||
      !compare(source, targetProfile(Transfer::Display, header.colours), header.colours,
               toDisplay)) {
    return std::nullopt;
  }
  const bool linear =
      header.type == SampleType::Float || toLinear.largestGreyDifference < kSameColour;
  ProfiledColour colour;
  colour.transfer = linear ? Transfer::Linear : Transfer::Display;
  colour.type = header.type;
  if ((linear ? toLinear : toDisplay).largestDifference < kSameColour) return colour;

  if (header.type == SampleType::Byte) colour.type = SampleType::Word;
  Transform transform = makeTransform(
      source, pixelFormat(header.colours, header.alpha, header.type),
      targetProfile(colour.transfer, header.colours),
      pixelFormat(header.colours, header.alpha, colour.type),
      cmsFLAGS_COPY_ALPHA | (header.type == SampleType::Byte ? 0 : cmsFLAGS_NOOPTIMIZE));
  if (!transform) return std::nullopt;
  colour.conversion = std::make_shared<ProfileConversion>(std::move(transform));
  return colour;
}

ProfiledColour examine(const std::filesystem::path& file, const PhotographHeader& header) {
  const ProfiledColour asItIs{header.type, header.transfer, nullptr};
  if (header.profile.empty() && header.gamma <= 0) return asItIs;
  const Profile source = sourceProfile(header);
  if (!source) throw inputError(file, "an undamaged colour profile", "one that cannot be read");
  if (!describesSamples(source, header.colours)) return asItIs;
  if (auto colour = convert(source, header)) return *colour;
  throw inputError(file, "a colour profile that gives every sample a colour", "one that does not");
}

// lcms prints nothing by itself, but would otherwise keep a handler from elsewhere.
void ignoreMessages() {
  static const bool done = [] {
    cmsSetLogErrorHandler([](cmsContext, cmsUInt32Number, const char*) {});
    return true;
  }();
  static_cast<void>(done);
}

}  // namespace

const ProfiledColour& ColourProfiles::colourOf(const std::filesystem::path& file,
                                               const PhotographHeader& header) {
  ignoreMessages();
  const Key key{
      std::string(reinterpret_cast<const char*>(header.profile.data()), header.profile.size()),
      header.colours,
      header.alpha,
      header.type,
      header.transfer,
      header.gamma};
  const auto found = known_.find(key);
  if (found != known_.end()) return found->second;
  return known_.emplace(key, examine(file, header)).first->second;
}

}  // namespace illum
