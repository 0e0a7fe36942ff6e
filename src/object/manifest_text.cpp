#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "illum/error.h"
#include "json/json_text.h"
#include "json/visitors.h"
#include "object/entry_name.h"
#include "object/manifest_fields.h"
#include "object/view_fields.h"

namespace illum {
namespace {

using namespace fields;

void checkVersion(const Json& root, const FieldPath& top, Manifest& manifest) {
  const auto format = root.find("format");
  if (format == root.end() || *format != kFormat)
    throw FieldPath(&top, "format")
        .wrong("'illum'", format == root.end() ? "none" : shown(*format));
  const auto version = root.find("version");
  const FieldPath path(&top, "version");
  if (version == root.end() || !version->is_array() || version->size() != 2 ||
      !(*version)[0].is_number_unsigned() || !(*version)[1].is_number_unsigned())
    throw path.wrong("two whole numbers", version == root.end() ? "none" : shown(*version));
  const auto major = (*version)[0].get<std::uint64_t>(), minor = (*version)[1].get<std::uint64_t>();
  if (major > kMajor)
    throw Error(Fault::Input, fmt::format("made by a newer Illumigraph: format {}.{}, this program "
                                          "reads {}.x",
                                          major, minor, kMajor));
  if (major < kMajor || minor > std::numeric_limits<int>::max())
    throw path.wrong(fmt::format("{}.x", kMajor), fmt::format("{}.{}", major, minor));
  manifest.versionMajor = kMajor;
  manifest.versionMinor = static_cast<int>(minor);
}

Manifest manifestOf(FileManifest file) {
  Manifest manifest = std::move(file.manifest);
  for (BasisEntry& basis : manifest.bases) {
    CodingEntry coding = file.coding;
    coding.offsets = std::move(basis.coding.offsets);
    coding.functions = std::move(basis.coding.functions);
    basis.coding = std::move(coding);
  }
  for (std::size_t g = 0; g < file.groups.size(); ++g) {
    GroupEntry& entry = file.groups[g].entry;
    try {
      entry.view.geometry = geometryOf(file.groups[g].view, file.slabs);
    } catch (const Error& error) {
      throw Error(Fault::Input, fmt::format("field 'groups[{}].geometry': {}", g, error.what()));
    }
    manifest.groups.push_back(std::move(entry));
  }
  for (LightRecord& light : file.lights)
    manifest.lights.push_back(
        {std::move(light.name), {Direction::fromVector(light.direction), light.intensity}, 0});
  for (ProvenanceRecord& record : file.provenance)
    manifest.provenance.emplace_back(std::move(record.name), std::move(record.value));
  return manifest;
}

FileManifest fileManifestOf(const Manifest& manifest) {
  FileManifest file;
  file.manifest = manifest;
  if (!manifest.bases.empty()) file.coding = manifest.bases.front().coding;
  for (const GroupEntry& entry : manifest.groups)
    file.groups.push_back({{{entry.view.name, {}}, entry.basis, entry.depth},
                           recordOf(entry.view.geometry, file.slabs)});
  for (const LightFileEntry& entry : manifest.lights)
    file.lights.push_back({entry.name, entry.light.toLight.vector(), entry.light.intensity});
  for (const auto& [name, value] : manifest.provenance) file.provenance.push_back({name, value});
  return file;
}

// The oldest version that knows everything in the manifest: what readers of 1.0 understand stays
// theirs.
int minorOf(const Manifest& manifest) {
  const bool exact =
      std::any_of(manifest.bases.begin(), manifest.bases.end(), [](const BasisEntry& basis) {
        return basis.colour.kind == BasisColour::Kind::Exact || basis.coding.curve == Curve::Half;
      });
  return exact ? kMinor : 0;
}

Manifest readManifest(std::string_view text) {
  if (text.size() > kMaxManifestBytes)
    throw Error(Fault::Input,
                fmt::format("expected at most {} bytes, found {}", kMaxManifestBytes, text.size()));
  const Json root = Json::parse(text);
  const FieldPath top;
  FileManifest file;
  Reader reader(root, top);
  checkVersion(root, top, file.manifest);
  describe(reader, file);
  Manifest manifest = manifestOf(std::move(file));
  checkConsistency(manifest);
  return manifest;
}

std::string writeManifest(const Manifest& manifest) {
  FileManifest file = fileManifestOf(manifest);
  Writer writer{FieldPath()};
  writer.node()["format"] = kFormat;
  writer.node()["version"] = {kMajor, minorOf(manifest)};
  describe(writer, file);
  checkConsistency(manifest);
  std::string text = jsonText(writer.node());
  if (text.size() > kMaxManifestBytes)
    throw Error(Fault::Input,
                fmt::format("expected at most {} bytes, found {}", kMaxManifestBytes, text.size()));
  return text;
}

}  // namespace

std::string textOf(const Manifest& manifest) {
  try {
    return writeManifest(manifest);
  } catch (const Error& error) {
    throw Error(error.fault(), fmt::format("{}: {}", kManifestEntry, error.what()));
  }
}

Manifest manifestFromText(std::string_view json, const std::string& source) {
  try {
    return readManifest(json);
  } catch (const nlohmann::json::exception& error) {
    throw Error(Fault::Input,
                fmt::format("{}: expected JSON, found a fault: {}", source, error.what()));
  } catch (const Error& error) {
    throw Error(error.fault(), fmt::format("{}: {}", source, error.what()));
  }
}

}  // namespace illum
