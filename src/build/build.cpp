#include "illum/build.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <utility>

#include "build/plan.h"
#include "build/plane_row.h"
#include "build/response_capture.h"
#include "build/tile_writer.h"
#include "build/view_writer.h"
#include "core/memory.h"
#include "core/stoppable_progress.h"
#include "encode/object_writer.h"
#include "illum/error.h"
#include "illum/version.h"
#include "object/entry_name.h"

namespace illum {
namespace {

// Chosen from the curves in docs/quality.md and docs/performance.md.
constexpr int kDefaultQuality = 80;
constexpr int kDefaultSpeed = 6;
constexpr int kDefaultTile = 512;

// What a program that reads photographs takes before it does anything, OpenImageIO's libraries
// where it needs them (35 MB otherwise).
constexpr std::uint64_t kProgramBytes = std::uint64_t{160} << 20;
constexpr std::uint64_t kLeastCaptureBytes = std::uint64_t{64} << 20;
constexpr double kCaptureShare = 0.55;

Response responseFor(const BuildOptions& options, Transfer transfer) {
  if (!options.response) {
    return transfer == Transfer::Display ? Response::Display : Response::Linear;
  }
  const bool display = *options.response == "display";
  if (!display && *options.response != "linear") {
    throw Error(Fault::Usage, fmt::format("--response: expected linear or display, found \"{}\"",
                                          *options.response));
  }
  return display ? Response::Display : Response::Linear;
}

void checkOptions(const BuildOptions& options) {
  if (options.holdout < 0) {
    throw Error(Fault::Usage,
                fmt::format("--holdout: expected at least 1, found {}", options.holdout));
  }
  if (options.tile && (*options.tile < 64 || *options.tile > 1360 || *options.tile % 8 != 0)) {
    throw Error(
        Fault::Usage,
        fmt::format("--tile: expected a multiple of 8 from 64 to 1360, found {}", *options.tile));
  }
  if (options.quality < -1 || options.quality > 100) {
    throw Error(Fault::Usage,
                fmt::format("--quality: expected 0 to 100, found {}", options.quality));
  }
  if (options.bits && *options.bits != 8 && *options.bits != 10 && *options.bits != 12 &&
      *options.bits != 16) {
    throw Error(Fault::Usage,
                fmt::format("--bits: expected 8, 10, 12 or 16, found {}", *options.bits));
  }
  const Coding coding = codingOf(options);
  const int most = coding == Coding::Png ? 16 : coding == Coding::Avif ? 12 : 8;
  if (options.bits && *options.bits > most) {
    throw Error(Fault::Usage,
                fmt::format("--bits {}: {} holds at most {}", *options.bits, nameOf(coding), most));
  }
}

// Everything of the options that changes a byte of the object.
std::string fingerprintOf(const Capture& capture, const BuildOptions& o) {
  const auto flag = [](const std::optional<bool>& f) { return f ? (*f ? "yes" : "no") : "chosen"; };
  return fmt::format(
      "illumigraph {}\nbasis {} {} {}\ncoding {} {} {} {} {}\nresponse {}\nholdout {}\n"
      "weights {} extension {} regularizer {} projection {}\ntile {}\n{}",
      kVersion, o.basis, o.coefficients, o.planes, nameOf(codingOf(o)), o.quality, o.speed,
      o.bits.value_or(0), o.curve.value_or("chosen"), o.response.value_or("chosen"), o.holdout,
      flag(o.solidAngleWeights), flag(o.extension),
      o.regularizer ? fmt::format("{}", *o.regularizer) : "chosen", o.projection,
      o.tile.value_or(0), capture.fingerprint());
}

// The side of a tile: what was asked for, or the largest whose planes fit one atlas.
int tileFor(const BuildOptions& options, const std::vector<CodingEntry>& codings) {
  if (options.tile) return *options.tile;
  int cells = 1;
  for (const CodingEntry& coding : codings) {
    const auto triples = (static_cast<int>(coding.functions.size()) + 2) / 3;
    cells = std::max(cells, triples * (splitsBytes(coding.coding, coding.bits) ? 2 : 1));
  }
  int tile = kDefaultTile;
  while (tile > 64 && (kMaxAtlasSide / tile) * (kMaxAtlasSide / tile) < cells) tile /= 2;
  return tile;
}

BasisEntry basisEntryOf(const Fit& fit, const CodingEntry& coding, int quality) {
  BasisEntry basis;
  basis.name = fit.basisName;
  basis.coefficients = fit.coefficients > 0 ? fit.coefficients : fit.basis.planes();
  basis.colour = fit.basis.colour();
  basis.domain = fit.basis.domain();
  basis.coding = coding;
  basis.coding.quality = quality;
  basis.mixing = fit.mixing;
  return basis;
}

Manifest manifestFor(const Capture& capture, const LightChoice& lights, const BuildOptions& options,
                     Response response, const Plan& plan, int quality) {
  Manifest manifest;
  manifest.tile = tileFor(options, plan.quantiser.entries);
  manifest.response = response;
  std::vector<TurnedFrame> frames;
  for (std::size_t b = 0; b < plan.bases.size(); ++b) {
    manifest.bases.push_back(basisEntryOf(plan.bases[b].fit, plan.quantiser.entries[b], quality));
    frames.push_back(plan.bases[b].frame);
  }
  const auto basisOf = frameOfEachView(frames, capture.views().size());
  for (std::size_t g = 0; g < basisOf.size(); ++g)
    manifest.groups.push_back({capture.views()[g], basisOf[g], {}});
  manifest.mask = capture.hasMask();
  manifest.lights = capture.lights();
  manifest.heldOut = lights.heldOut;
  manifest.generator = fmt::format("Illumigraph {}", kVersion);
  return manifest;
}

// How many tiles may be coded side by side, or an Error with the least budget.
int tilesAtOnce(const Manifest& manifest, std::span<const int> planesOfBases,
                const Capture& capture, std::uint64_t memoryBytes) {
  const std::uint64_t row = planeRowBytes(manifest, planesOfBases);
  const std::uint64_t fixed = kProgramBytes + capture.residentBytes() + row;
  const std::uint64_t each = tileCodingBytes(manifest, planesOfBases);
  if (fixed + each > memoryBytes) {
    // The capture takes its share of a larger budget, so its part of the sum grows too.
    const std::uint64_t own = row + each;
    const std::uint64_t least =
        kProgramBytes +
        std::max(capture.residentBytes() + own,
                 static_cast<std::uint64_t>(static_cast<double>(own) / (1 - kCaptureShare)));
    throw Error(
        Fault::Machine,
        fmt::format("--max-memory {}: this object needs at least {} ({} for a row of tiles, "
                    "{} to code a tile, the rest for photographs and program); a smaller "
                    "--tile needs less",
                    textFromBytes(memoryBytes), textFromBytes(least), textFromBytes(row),
                    textFromBytes(each)));
  }
  const auto threads = static_cast<std::uint64_t>(tbb::this_task_arena::max_concurrency());
  return static_cast<int>(std::clamp<std::uint64_t>((memoryBytes - fixed) / each, 1, threads));
}

// One line of what was chosen for each basis, or one a choice where there is but one basis.
std::vector<std::string> choicesOf(const Plan& plan, const std::vector<View>& views) {
  if (plan.bases.size() == 1) return plan.bases[0].fit.choices;
  std::vector<std::string> lines;
  for (const PlannedBasis& basis : plan.bases)
    lines.push_back(
        fmt::format("{}: {}", nameOf(basis.frame, views), fmt::join(basis.fit.choices, "; ")));
  return lines;
}

void describe(const Plan& plan, const std::vector<View>& views, const EncodeSettings& settings,
              Manifest& manifest, BuildReport& report) {
  report.choices = choicesOf(plan, views);
  for (const auto& choice : report.choices) manifest.provenance.emplace_back("fit", choice);
  std::size_t stored = 0, planes = 0;
  for (const PlannedBasis& basis : plan.bases) {
    for (const std::string& warning : basis.fit.warnings)
      if (std::ranges::find(report.warnings, warning) == report.warnings.end())
        report.warnings.push_back(warning);
    planes = std::max(planes, static_cast<std::size_t>(basis.fit.basis.planes()));
  }
  for (const CodingEntry& entry : plan.quantiser.entries)
    stored = std::max(stored, entry.functions.size());
  report.leaveOneOutDecibels = plan.leaveOneOutDecibels();
  report.quantisationDecibels = plan.quantiser.decibels;
  const CodingEntry& coding = manifest.coding();
  report.choices.push_back(fmt::format(
      "{} bits, curve {}, step {:.6g}: {}{} stored planes for {} of the basis; quantisation alone "
      "{:.1f} dB",
      coding.bits, nameOf(coding.curve), coding.step, plan.bases.size() > 1 ? "at most " : "",
      stored, planes, plan.quantiser.decibels));
  manifest.provenance.emplace_back("quantiser", report.choices.back());
  manifest.provenance.emplace_back(
      "coding", fmt::format("{}, quality {}, speed {}", nameOf(coding.coding), settings.quality,
                            settings.speed));
}

// A few highlights brighter than any that the pilot saw are to be expected.
void tellClipping(const SampleCounts& samples, BuildReport& report) {
  constexpr std::uint64_t kFew = 10000;  // one in as many
  if (samples.clipped == 0) return;
  auto& told = samples.clipped > samples.all / kFew ? report.warnings : report.choices;
  told.push_back(fmt::format(
      "{} of {} plane samples lay outside the quantiser's range and took its nearest end",
      samples.clipped, samples.all));
}

// basis.bin: the tables one after another.
std::vector<std::byte> encodeTables(const Plan& plan, Manifest& manifest) {
  std::vector<std::byte> all;
  for (std::size_t b = 0; b < plan.bases.size(); ++b) {
    const auto bytes = plan.bases[b].fit.basis.encode();
    manifest.bases[b].tableOffset = all.size();
    manifest.bases[b].tableBytes = bytes.size();
    all.insert(all.end(), bytes.begin(), bytes.end());
  }
  return all;
}

}  // namespace

std::uint64_t captureMemoryBytes(std::uint64_t budgetBytes) {
  const std::uint64_t usable = budgetBytes - std::min(budgetBytes, kProgramBytes);
  return std::max(kLeastCaptureBytes,
                  static_cast<std::uint64_t>(kCaptureShare * static_cast<double>(usable)));
}

BuildReport buildObject(const Capture& source, const std::filesystem::path& out,
                        const BuildOptions& options, Progress& reported) {
  checkOptions(options);
  StoppableProgress progress(reported, options.stop);
  const Response response = responseFor(options, source.transfer());
  const ResponseCapture capture(
      source, response == Response::Display ? Transfer::Display : Transfer::Linear);
  const LightChoice lights = chooseLights(capture, options.holdout);
  const std::uint64_t memoryBytes =
      options.memoryBytes != 0 ? options.memoryBytes : machineMemoryBytes() / 4;

  const bool folder = !out.has_filename();
  ObjectWriter writer(folder ? out.parent_path() : out,
                      folder ? ObjectForm::Folder : ObjectForm::Archive,
                      fingerprintOf(capture, options), options.resume, options.force);
  BuildReport report;
  try {
    const std::uint64_t forPlan =
        memoryBytes - std::min(memoryBytes, kProgramBytes + capture.residentBytes());
    const Plan plan = planObject(capture, lights, options, response, forPlan, progress);
    EncodeSettings settings;
    settings.quality = options.quality >= 0 ? options.quality : kDefaultQuality;
    settings.speed = options.speed >= 0 ? options.speed : kDefaultSpeed;
    Manifest manifest = manifestFor(capture, lights, options, response, plan, settings.quality);
    describe(plan, capture.views(), settings, manifest, report);

    std::vector<int> planesOfBases;
    for (const PlannedBasis& basis : plan.bases) planesOfBases.push_back(basis.fit.basis.planes());
    const int atOnce = tilesAtOnce(manifest, planesOfBases, capture, memoryBytes);
    const SampleCounts samples =
        ViewWriter(capture, lights, plan, manifest, settings, atOnce, writer, progress).writeAll();
    tellClipping(samples, report);
    writer.add(std::string(kBasisEntry), encodeTables(plan, manifest));
    const std::string text = textOf(manifest);
    writer.add(std::string(kManifestEntry), std::as_bytes(std::span(text)));
    report.bytes = writer.finish();
  } catch (const Stopped&) {
    writer.keepPartial();
    report.stopped = true;
  } catch (const Error& error) {
    if (error.fault() == Fault::Machine) writer.keepPartial();
    throw;
  } catch (const std::bad_alloc&) {
    writer.keepPartial();
    throw;
  }
  return report;
}

}  // namespace illum
