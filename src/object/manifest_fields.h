// One description of each record of object.json, `describe`, drives reading, writing and checking
// (json/field.h).
//
// To extend the format within version 1: add a field as `optional("name")` whose default means what
// older objects meant, or a word to a `choice`, which older readers refuse by the field's name; and
// raise kMinor. Anything else that older readers must not ignore needs a new major.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "json/field.h"
#include "object/entry_source.h"
#include "object/manifest.h"
#include "object/view_record.h"

namespace illum::fields {

inline constexpr int kMajor = 1, kMinor = 1;
inline constexpr std::string_view kFormat = "illum";
inline constexpr std::size_t kMaxProvenance = 1000;

template <typename Visitor>
void describe(Visitor& v, Size& size) {
  v.integer("width", size.width, 1, kMaxSide);
  v.integer("height", size.height, 1, kMaxSide);
}

template <typename Visitor>
void describe(Visitor& v, RigidTransform& transform) {
  v.numbers("rotation", transform.rotation, -1.000001, 1.000001);
  v.triple("translation", coordinatesOf(transform.translation), -kHuge, kHuge);
}

template <typename Visitor>
void describe(Visitor& v, BasisEntry& basis) {
  using Kind = BasisColour::Kind;
  v.text("name", basis.name);
  v.integer("coefficients", basis.coefficients, 1, kMaxPlanes);
  v.choice(
      "kind", basis.colour.kind,
      Choices<Kind>{{Kind::Separable, "separable"}, {Kind::Full, "full"}, {Kind::Exact, "exact"}});
  v.numbers("colourMatrix", basis.colour.colourMatrix, -kHuge, kHuge);
  v.choice("domain", basis.domain,
           Choices<LightDomain>{{LightDomain::Hemisphere, "hemisphere"},
                                {LightDomain::Sphere, "sphere"}});
  v.integer("tableOffset", basis.tableOffset, 0, kMaxBasisBytes);
  v.integer("tableBytes", basis.tableBytes, 1, kMaxBasisBytes);
  v.numbers("offsets", basis.coding.offsets, -kHuge, kHuge, 1, kMaxPlanes);
  v.integers("functions", basis.coding.functions, 0, kMaxPlanes - 1, 1, kMaxPlanes);
  v.numbers(optional("mixing"), basis.mixing, -kHuge, kHuge, 0, kMaxPlanes * kMaxPlanes);
}

/// Of the whole object: offsets and functions are the bases' own.
template <typename Visitor>
void describe(Visitor& v, CodingEntry& coding) {
  v.choice("name", coding.coding,
           Choices<Coding>{{Coding::Png, "png"}, {Coding::Avif, "avif"}, {Coding::Jpeg, "jpeg"}});
  v.integer("bits", coding.bits, 8, 16);
  v.choice(
      "curve", coding.curve,
      Choices<Curve>{
          {Curve::Linear, "linear"}, {Curve::SignedSqrt, "signedSqrt"}, {Curve::Half, "half"}});
  v.number("step", coding.step, 1e-30, kHuge);
  v.integer(optional("quality"), coding.quality, 0, 100);
}

template <typename Visitor>
void describe(Visitor& v, DepthRange& depth) {
  v.number("from", depth.from, -kHuge, kHuge);
  v.number("to", depth.to, -kHuge, kHuge);
  v.integer("steps", depth.steps, 1, kMaxDepthSteps);
}

/// A group with its view's geometry as a record of its own.
struct GroupRecord {
  GroupEntry entry;  ///< all but the geometry
  ViewRecord view;
};

template <typename Visitor>
void describe(Visitor& v, GroupRecord& group) {
  v.text("name", group.entry.view.name);
  v.integer("basis", group.entry.basis, 0, kMaxBases - 1);
  v.record("geometry", group.view);  // object/view_fields.h
  v.maybeRecord("depth", group.entry.depth);
}

/// A light of the capture, its direction not yet checked to be one.
struct LightRecord {
  std::string name;
  Vector3 direction;
  LinearRgb intensity{1, 1, 1};
};

template <typename Visitor>
void describe(Visitor& v, LightRecord& light) {
  v.text("name", light.name);
  v.triple("direction", coordinatesOf(light.direction), -kHuge, kHuge);
  v.triple(optional("intensity"), channelsOf(light.intensity), 0, kHuge);
}

struct ProvenanceRecord {
  std::string name, value;
};

template <typename Visitor>
void describe(Visitor& v, ProvenanceRecord& record) {
  v.text("name", record.name);
  v.text("value", record.value);
}

/// The manifest as it stands in the file.
struct FileManifest {
  Manifest manifest;  ///< without groups, lights and provenance
  CodingEntry coding;
  std::vector<LightSlab> slabs;
  std::vector<GroupRecord> groups;
  std::vector<LightRecord> lights;
  std::vector<ProvenanceRecord> provenance;
};

template <typename Visitor>
void describe(Visitor& v, FileManifest& file) {
  Manifest& m = file.manifest;
  v.text("generator", m.generator);
  v.integer("tile", m.tile, kMinTile, kMaxTile);
  v.choice(
      "response", m.response,
      Choices<Response>{
          {Response::Linear, "linear"}, {Response::Display, "display"}, {Response::Cone, "cone"}});
  v.record("coding", file.coding);
  v.records("bases", m.bases, 1, kMaxBases);
  v.records(optional("slabs"), file.slabs, 0, kMaxSlabs);
  v.records("groups", file.groups, 1, kMaxGroups);
  v.flag(optional("mask"), m.mask);
  v.records(optional("lights"), file.lights, 0, kMaxLights);
  v.integers(optional("heldOut"), m.heldOut, 0, kMaxLights - 1, 0, kMaxLights);
  v.records(optional("provenance"), file.provenance, 0, kMaxProvenance);
}
}  // namespace illum::fields
