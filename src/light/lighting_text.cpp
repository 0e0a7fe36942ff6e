#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/files.h"
#include "illum/error.h"
#include "illum/lighting.h"
#include "json/json_text.h"
#include "json/visitors.h"
#include "light/light_checks.h"
#include "light/lighting_fields.h"

namespace illum {
namespace {

using namespace fields;

constexpr std::uint64_t kMaxLightingBytes = 16 << 20;

void wrong(const FieldPath& light, std::string_view field, std::string_view expected,
           std::string_view found) {
  throw FieldPath(&light, field).wrong(expected, found);
}

template <typename Kind>
void checkRelations(const FieldPath&, const Kind&) {}

void checkRelations(const FieldPath& path, const SpotLight& light) {
  if (light.target == light.position)
    wrong(path, "target", "another point than 'position'", "the same");
  if (light.edgeDegrees > light.coneDegrees)
    wrong(path, "edgeDegrees", fmt::format("at most 'coneDegrees', {}", light.coneDegrees),
          fmt::format("{}", light.edgeDegrees));
}

void checkRelations(const FieldPath& path, const RectangleLight& light) {
  const double width = length(light.halfWidth), height = length(light.halfHeight);
  if (!(width > 0)) wrong(path, "halfWidth", "a vector that is not zero", "zero");
  if (!(height > 0)) wrong(path, "halfHeight", "a vector that is not zero", "zero");
  constexpr double kPerpendicular = 1e-6;
  const double cosine = dot((1 / width) * light.halfWidth, (1 / height) * light.halfHeight);
  if (!(std::abs(cosine) <= kPerpendicular))
    wrong(path, "halfHeight", "a vector perpendicular to 'halfWidth'",
          fmt::format("a cosine of {}", cosine));
}

void checkRelations(const FieldPath& path, const EnvironmentLight& light) {
  const std::string name = light.picture.string();
  if (name.empty() || name.find('\0') != std::string::npos)
    wrong(path, "picture", "the name of a file", name.empty() ? "no text" : "a zero byte");
}

void checkRelations(const FieldPath& path, const SkyLight& light) {
  if (light.model == SkyModel::Overcast) return;
  const double above = 90 - angleRadians(light.sun, light.up) * 180 / std::numbers::pi;
  if (above < -1e-6)
    wrong(path, "sun", "a direction above the horizon",
          fmt::format("{:.3g} degrees below", -above));
}

void checkRelations(const FieldPath& path, const Light& light) {
  std::visit([&](const auto& kind) { checkRelations(path, kind); }, light);
}

void checkAllRelations(const FieldPath& top, const std::vector<Light>& lights) {
  const FieldPath list(&top, "lights");
  for (std::size_t i = 0; i < lights.size(); ++i) checkRelations(FieldPath(&list, i), lights[i]);
}

Lighting read(std::string_view text) {
  if (text.size() > kMaxLightingBytes)
    throw Error(Fault::Input,
                fmt::format("expected at most {} bytes, found {}", kMaxLightingBytes, text.size()));
  const Json root = Json::parse(text);
  const FieldPath top;
  LightingRecord file;
  Reader reader(root, top, Unknown::Refuse);
  describe(reader, file);
  reader.finish();
  checkAllRelations(top, file.lights);
  return {std::move(file.lights)};
}

}  // namespace

void checkLight(const Light& light) {
  Writer writer{FieldPath()};
  Light copy = light;
  describe(writer, copy);
  checkRelations(FieldPath(), light);
}

Lighting lightingFromText(std::string_view json, const std::string& source) {
  try {
    return read(json);
  } catch (const nlohmann::json::exception& error) {
    throw Error(Fault::Input,
                fmt::format("{}: expected JSON, found a fault: {}", source, error.what()));
  } catch (const Error& error) {
    throw Error(error.fault(), fmt::format("{}: {}", source, error.what()));
  }
}

std::string textOf(const Lighting& lighting) {
  const FieldPath top;
  Writer writer(top);
  LightingRecord file{kLightingVersion, lighting.lights};
  describe(writer, file);
  checkAllRelations(top, lighting.lights);
  return jsonText(writer.node());
}

Lighting readLighting(const std::filesystem::path& file) {
  Lighting lighting = lightingFromText(readTextFile(file, kMaxLightingBytes), file.string());
  for (Light& light : lighting.lights) {
    if (auto* environment = std::get_if<EnvironmentLight>(&light))
      environment->picture = file.parent_path() / environment->picture;
  }
  return lighting;
}

void writeLighting(const std::filesystem::path& file, const Lighting& lighting) {
  writeFileAtomically(file, std::string_view(textOf(lighting)));
}

}  // namespace illum
