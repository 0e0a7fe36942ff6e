// A tiny object for tests, fuzzers' seeds and the format's worked example: a wavy surface of two
// levels under a basis of four smooth functions.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "codec/tile.h"
#include "encode/object_writer.h"
#include "object/manifest.h"

namespace illum {

struct SampleOptions {
  Coding coding = Coding::Png;
  int bits = 8;
  int quality = 80;
  Size size{100, 70};
  int tile = 64;
  bool mask = true;
  bool poster = true;
  Curve curve = Curve::Linear;
  Response response = Response::Linear;
  LightDomain domain = LightDomain::Hemisphere;
  bool fullBasis = false;   ///< b_k and a mean in RGB, instead of one scalar for three planes
  bool exact = false;       ///< the lights themselves as the basis, halves as codes; bits: 16
  std::vector<View> views;  ///< empty: one photograph of `size`
  int bases = 1;            ///< of one table and different offsets; views take them in turn
  int depthSteps = 0;       ///< > 0: with depth
};

/// Without the places of its tables, which sampleEntries fills in.
Manifest sampleManifest(const SampleOptions& options);

/// The codes of one tile: smooth, different in every plane, rounded to `bits`.
PlaneCodes sampleCodes(const Manifest& manifest, int group, int level, int x, int y);
BytePicture sampleMask(const Manifest& manifest, int group, int level, int x, int y);
/// A slope with holes in it.
std::vector<std::uint16_t> sampleDepth(const Manifest& manifest, int group, int level, int x,
                                       int y);
/// Two turned slabs of different sizes, a camera and both kinds of panorama.
std::vector<View> sampleViews();

using Entries = std::vector<std::pair<std::string, std::vector<std::byte>>>;
/// Every entry in canonical order.
Entries sampleEntries(const SampleOptions& options);

/// Writes the entries as an object.
void writeSampleObject(const std::filesystem::path& out, ObjectForm form,
                       const SampleOptions& options);

}  // namespace illum
