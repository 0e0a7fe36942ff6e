#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "commands.h"
#include "core/memory.h"
#include "illum/object.h"
#include "object/manifest.h"

namespace illum::cli {
namespace {

const char* nameOfResponse(Response response) {
  switch (response) {
    case Response::Linear:
      return "linear";
    case Response::Display:
      return "display";
    case Response::Cone:
      return "cone";
  }
  return "";
}

// Bytes of the entries whose names begin with `prefix`.
std::uint64_t bytesUnder(const Object& object, const std::string& prefix) {
  std::uint64_t bytes = 0;
  for (const auto& name : object.entries()) {
    if (name.starts_with(prefix)) bytes += object.entry(name).size();
  }
  return bytes;
}

const char* kindOf(const ViewGeometry& geometry) {
  if (std::holds_alternative<SlabView>(geometry)) return "slab";
  if (std::holds_alternative<PinholeCamera>(geometry)) return "camera";
  if (std::holds_alternative<Panorama>(geometry)) return "panorama";
  return "photograph";
}

// How many views are of each kind, by the order of their first.
nlohmann::ordered_json kindsOf(const Object& object) {
  nlohmann::ordered_json kinds = nlohmann::ordered_json::object();
  for (int group = 0; group < object.groups(); ++group) {
    auto& views = kinds[kindOf(object.view(group).geometry)];
    views = views.is_null() ? 1 : views.get<int>() + 1;
  }
  return kinds;
}

// {"name": "turn_0", "columns": 3, "rows": 2} for each slab that there is.
nlohmann::ordered_json slabsOf(const Manifest& manifest) {
  nlohmann::ordered_json slabs = nlohmann::ordered_json::array();
  for (const GroupEntry& group : manifest.groups) {
    const auto* view = std::get_if<SlabView>(&group.view.geometry);
    if (view == nullptr) continue;
    const LightSlab& slab = view->slab;
    if (!slabs.empty() && slabs.back()["name"] == slab.name) continue;
    slabs.push_back({{"name", slab.name}, {"columns", slab.uCount}, {"rows", slab.vCount}});
  }
  return slabs;
}

nlohmann::ordered_json describe(const Object& object) {
  const Manifest& m = object.manifest();
  const BasisEntry& basis = m.bases.front();
  const TileGrid grid = m.grid(0);
  const nlohmann::ordered_json kinds = kindsOf(object);
  double pixels = 0;
  bool oneSize = true;
  for (int group = 0; group < object.groups(); ++group) {
    pixels += static_cast<double>(object.size(group).pixels());
    oneSize = oneSize && object.size(group) == grid.size;
  }
  nlohmann::ordered_json out;
  out["version"] = 1;
  out["format"] = fmt::format("{}.{}", m.versionMajor, m.versionMinor);
  out["geometry"] = kinds.size() == 1 ? kinds.items().begin().key() : "mixed";
  out["views"] = object.groups();
  out["viewsOfKind"] = kinds;
  out["slabs"] = slabsOf(m);
  out["bases"] = m.bases.size();
  out["width"] = grid.size.width;
  out["height"] = grid.size.height;
  out["oneSize"] = oneSize;
  out["levels"] = grid.levels();
  out["tile"] = m.tile;
  out["basis"] = basis.name;
  out["domain"] = basis.domain == LightDomain::Sphere ? "sphere" : "hemisphere";
  out["coefficients"] = basis.coefficients;
  out["planes"] = object.basis(0).planes();
  out["storedPlanes"] = basis.coding.planes();
  out["response"] = nameOfResponse(m.response);
  out["coding"] = nameOf(basis.coding.coding);
  out["quality"] = basis.coding.quality;
  out["bits"] = basis.coding.bits;
  out["curve"] = nameOf(basis.coding.curve);
  out["step"] = basis.coding.step;
  out["mask"] = m.mask;
  out["depth"] = object.hasDepth();
  out["lights"] = m.lights.size();
  out["heldOut"] = m.heldOut.size();
  out["generator"] = m.generator;
  out["bytes"] = object.fileBytes();
  out["planeBytes"] = bytesUnder(object, "planes/");
  out["basisBytes"] = bytesUnder(object, "basis.bin");
  out["maskBytes"] = bytesUnder(object, "mask/");
  out["depthBytes"] = bytesUnder(object, "depth/");
  out["bitsPerPixel"] = 8 * static_cast<double>(object.fileBytes()) / pixels;
  for (const auto& [key, text] : m.provenance) out["provenance"].push_back({key, text});
  return out;
}

// Slabs side by side with as many view points each, such as those of a turn, take one word:
// "8 slabs 'turn_0' to 'turn_7' of 3 x 2 each".
std::string textOfSlabs(const nlohmann::ordered_json& slabs) {
  const auto same = [](const auto& a, const auto& b) {
    return a["columns"] == b["columns"] && a["rows"] == b["rows"];
  };
  std::string text;
  for (std::size_t first = 0, end = 0; first < slabs.size(); first = end) {
    while (end < slabs.size() && same(slabs[first], slabs[end])) ++end;
    const auto name = slabs[first]["name"].get<std::string>();
    const auto points =
        fmt::format("{} x {}", slabs[first]["columns"].get<int>(), slabs[first]["rows"].get<int>());
    text += first == 0 ? ": " : ", ";
    text += end == first + 1 ? fmt::format("slab '{}' of {}", name, points)
                             : fmt::format("{} slabs '{}' to '{}' of {} each", end - first, name,
                                           slabs[end - 1]["name"].get<std::string>(), points);
  }
  return text;
}

// "slab", or "mixed (9 slab, 1 camera)".
std::string textOfKinds(const nlohmann::ordered_json& facts) {
  const auto geometry = facts["geometry"].get<std::string>();
  if (facts["viewsOfKind"].size() == 1) return geometry;
  std::string parts;
  for (const auto& [kind, views] : facts["viewsOfKind"].items())
    parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", views.get<int>(), kind);
  return fmt::format("{} ({})", geometry, parts);
}

void print(const std::string& path, const nlohmann::ordered_json& facts) {
  const auto number = [&](const char* key) { return facts[key].get<long long>(); };
  const auto text = [&](const char* key) { return facts[key].get<std::string>(); };
  const auto bytes = [&](const char* key) {
    return textFromBytes(facts[key].get<std::uint64_t>());
  };
  const auto line = [](const char* name, const std::string& value) {
    fmt::print("{:<12}{}\n", name, value);
  };
  fmt::print("{}\n", path);
  line("geometry", fmt::format("{}, {} x {} pixels{}, {} level{}, tiles of {}", textOfKinds(facts),
                               number("width"), number("height"),
                               facts["oneSize"].get<bool>() ? "" : " (the first; sizes differ)",
                               number("levels"), number("levels") == 1 ? "" : "s", number("tile")));
  if (number("views") > 1 || facts["slabs"].size() > 0)
    line("views", fmt::format("{}{}{}", number("views"), textOfSlabs(facts["slabs"]),
                              number("bases") > 1
                                  ? fmt::format("; {} bases, this is the first", number("bases"))
                                  : ""));
  line("basis", fmt::format("{} over the {}, {} coefficients, {} planes ({} stored)", text("basis"),
                            text("domain"), number("coefficients"), number("planes"),
                            number("storedPlanes")));
  line("response", text("response"));
  line("coding",
       fmt::format("{}, quality {}, {} bits, curve {}, step {:.6g}", text("coding"),
                   number("quality"), number("bits"), text("curve"), facts["step"].get<double>()));
  line("lights", fmt::format("{}, {} held out", number("lights"), number("heldOut")));
  line("size",
       fmt::format("{}, {:.2f} bits a pixel (planes {}, basis {}{}{})", bytes("bytes"),
                   facts["bitsPerPixel"].get<double>(), bytes("planeBytes"), bytes("basisBytes"),
                   facts["mask"].get<bool>() ? ", mask " + bytes("maskBytes") : "",
                   facts["depth"].get<bool>() ? ", depth " + bytes("depthBytes") : ""));
  line("made by", text("generator"));
  if (!facts.contains("provenance")) return;
  for (const auto& entry : facts["provenance"]) {
    line(entry[0].get<std::string>().c_str(), entry[1].get<std::string>());
  }
}

}  // namespace

void addInfo(CLI::App& program, int& exitCode) {
  auto* command = program.add_subcommand("info", "say what an object is");
  const auto object = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);
  command->add_option("OBJECT", *object, ".illum file or folder")->required();
  command->add_flag("--json", *json, "as JSON");
  command->callback([object, json, &exitCode] {
    const auto facts = describe(Object::open(*object));
    if (*json) {
      fmt::print("{}\n", facts.dump(2));
    } else {
      print(*object, facts);
    }
    exitCode = kDone;
  });
}

}  // namespace illum::cli
