#include "capture/capture_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "illum/error.h"
#include "json/json_text.h"
#include "json/visitors.h"
#include "object/view_fields.h"

namespace illum {
namespace {

using namespace fields;

constexpr std::string_view kCaptureFormat = "illum-capture";
constexpr int kCaptureMajor = 1, kCaptureMinor = 0;
constexpr int kMaxViews = 65536;

struct ViewEntry {
  std::string name, photographs, mask, depth;
  ViewRecord geometry;
};

struct FileRecord {
  std::string generator;
  bool rendered = false;
  std::vector<LightRecord> lights;
  std::vector<LightSlab> slabs;
  std::vector<ViewEntry> views;
  std::string proxy;
};

// Found by argument-dependent lookup of the visitors, which live with their records.
template <typename Visitor>
void describe(Visitor& v, ViewEntry& entry) {
  v.text("name", entry.name);
  v.record("geometry", entry.geometry);
  v.text("photographs", entry.photographs);
  v.text(optional("mask"), entry.mask);
  v.text(optional("depth"), entry.depth);
}

template <typename Visitor>
void describe(Visitor& v, FileRecord& file) {
  v.text(optional("generator"), file.generator);
  v.flag(optional("rendered"), file.rendered);
  v.records("lights", file.lights, 1, kMaxLights);
  v.records(optional("slabs"), file.slabs, 0, kMaxViews);
  v.records("views", file.views, 1, kMaxViews);
  v.text(optional("proxy"), file.proxy);
}

void checkVersion(const Json& root, const FieldPath& top) {
  const auto format = root.find("format");
  if (!root.is_object() || format == root.end() || *format != kCaptureFormat) {
    throw FieldPath(&top, "format")
        .wrong(fmt::format("'{}'", kCaptureFormat),
               !root.is_object() || format == root.end() ? "none" : shown(*format));
  }
  const auto version = root.find("version");
  if (version == root.end() || !version->is_array() || version->size() != 2 ||
      !(*version)[0].is_number_unsigned()) {
    throw FieldPath(&top, "version")
        .wrong("two whole numbers", version == root.end() ? "none" : shown(*version));
  }
  if ((*version)[0] != kCaptureMajor) {
    throw FieldPath(&top, "version").wrong(fmt::format("{}.x", kCaptureMajor), version->dump());
  }
}

// Whether a name stays below the folder that it is relative to.
bool staysInside(const std::filesystem::path& name) {
  if (name.empty() || name.is_absolute()) return false;
  for (const auto& part : name) {
    if (part == "..") return false;
  }
  return name.string().find('\0') == std::string::npos;
}

void checkName(const FieldPath& path, const std::string& name) {
  if (!staysInside(name)) throw path.wrong("the name of a file in the folder", '\'' + name + '\'');
}

void checkView(const FieldPath& path, const CaptureFileView& view) {
  if (view.files.empty()) checkName(FieldPath(&path, "photographs"), view.photographs);
  for (const std::string& file : view.files) checkName(FieldPath(&path, "photographs"), file);
  if (!view.mask.empty()) checkName(FieldPath(&path, "mask"), view.mask);
  if (!view.depth.empty()) checkName(FieldPath(&path, "depth"), view.depth);
  checkGeometry(view.view.geometry);
}

void checkUnique(const CaptureFile& capture) {
  std::set<std::string> names;
  for (const CaptureFileView& view : capture.views) {
    if (!names.insert(view.view.name).second) {
      throw Error(Fault::Input, fmt::format("field 'views': expected each name once, found '{}' "
                                            "twice",
                                            view.view.name));
    }
    const bool alike = view.mask.empty() == capture.views.front().mask.empty() &&
                       view.depth.empty() == capture.views.front().depth.empty();
    if (!alike) {
      throw Error(Fault::Input,
                  fmt::format("field 'views': expected masks and depths of all views or of none, "
                              "found '{}' unlike '{}'",
                              view.view.name, capture.views.front().view.name));
    }
  }
}

LightFileEntry lightOf(const FieldPath& path, LightRecord& record) {
  if (record.direction == Vector3()) {
    throw FieldPath(&path, "direction").wrong("a direction", "the zero vector");
  }
  const auto [r, g, b] = record.intensity;
  if (!(r > 0 && g > 0 && b > 0)) {
    throw FieldPath(&path, "intensity")
        .wrong("a positive intensity", fmt::format("{}, {}, {}", r, g, b));
  }
  return {std::move(record.name), {Direction::fromVector(record.direction), record.intensity}, 0};
}

// Whether every light has a picture of its own wherever a pattern tells lights apart by name.
void checkLightNames(const CaptureFile& capture) {
  std::set<std::string_view> names;
  const bool unique = std::ranges::all_of(
      capture.lights, [&](const LightFileEntry& light) { return names.insert(light.name).second; });
  for (const CaptureFileView& view : capture.views) {
    if (!view.files.empty() || capture.lights.size() == 1) continue;
    if (view.photographs.find("{index}") != std::string::npos) continue;
    if (unique && view.photographs.find("{light}") != std::string::npos) continue;
    throw Error(
        Fault::Input,
        fmt::format("view '{}': expected a picture for each of {} lights, found '{}', which "
                    "is one for several",
                    view.view.name, capture.lights.size(), view.photographs));
  }
}

CaptureFile readCapture(std::string_view text) {
  const Json root = jsonFromText(text);
  const FieldPath top;
  checkVersion(root, top);
  FileRecord file;
  Reader reader(root, top);
  describe(reader, file);
  for (const LightSlab& slab : file.slabs) checkSlab(slab);

  CaptureFile capture;
  capture.generator = std::move(file.generator);
  capture.rendered = file.rendered;
  const FieldPath lights(&top, "lights");
  for (std::size_t i = 0; i < file.lights.size(); ++i) {
    capture.lights.push_back(lightOf(FieldPath(&lights, i), file.lights[i]));
  }
  for (std::size_t i = 0; i < file.views.size(); ++i) {
    ViewEntry& entry = file.views[i];
    capture.views.push_back({{std::move(entry.name), geometryOf(entry.geometry, file.slabs)},
                             std::move(entry.photographs),
                             std::move(entry.mask),
                             std::move(entry.depth),
                             {}});
  }
  capture.proxy = std::move(file.proxy);
  checkCaptureFile(capture);
  return capture;
}

void replaceAll(std::string& text, std::string_view word, std::string_view by) {
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + by.size())) {
    text.replace(at, word.size(), by);
  }
}

}  // namespace

std::string textOf(const CaptureFile& capture) {
  FileRecord file{capture.generator, capture.rendered, {}, {}, {}, capture.proxy};
  for (const LightFileEntry& entry : capture.lights) {
    file.lights.push_back({entry.name, entry.light.toLight.vector(), entry.light.intensity});
  }
  for (const CaptureFileView& view : capture.views) {
    file.views.push_back({view.view.name, view.photographs, view.mask, view.depth,
                          recordOf(view.view.geometry, file.slabs)});
  }
  Writer writer{FieldPath()};
  writer.node()["format"] = kCaptureFormat;
  writer.node()["version"] = {kCaptureMajor, kCaptureMinor};
  describe(writer, file);
  return jsonText(writer.node());
}

CaptureFile captureFileFromText(std::string_view json, const std::string& source) {
  try {
    return readCapture(json);
  } catch (const Error& error) {
    throw Error(error.fault(), fmt::format("{}: {}", source, error.what()));
  }
}

void checkCaptureFile(const CaptureFile& capture) {
  const FieldPath top;
  const FieldPath views(&top, "views");
  for (std::size_t i = 0; i < capture.views.size(); ++i) {
    checkView(FieldPath(&views, i), capture.views[i]);
  }
  checkUnique(capture);
  checkLightNames(capture);
  if (capture.proxy.empty()) return;
  checkName(FieldPath(&top, "proxy"), capture.proxy);
  if (!capture.views.front().depth.empty()) {
    throw FieldPath(&top, "proxy").wrong("a mesh or depth pictures", "both");
  }
}

std::filesystem::path pictureOf(const CaptureFileView& view, const LightFileEntry& light,
                                int index) {
  if (!view.files.empty()) return view.files.at(static_cast<std::size_t>(index));
  const std::string& pattern = view.photographs;
  std::string name = pattern;
  replaceAll(name, "{index}", fmt::format("{:04}", index));
  replaceAll(name, "{light}", light.name);
  if (!staysInside(name)) {
    throw Error(Fault::Input,
                fmt::format("light '{}': expected a name that makes '{}' a file in the folder, "
                            "found '{}'",
                            light.name, pattern, name));
  }
  return name;
}

}  // namespace illum
