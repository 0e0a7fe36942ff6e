// Coding and decoding, one thread: items are samples of planes, so items_per_second / 1e6 are
// megapixels of planes a second a thread. Beside it the bytes and the decibels that they buy
// (docs/performance.md, "Coding"). Photographs come from the shared data (ILLUM_SHARED), else the
// planes are made up.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>

#include "encode/bench_planes.h"
#include "encode/encode_tile.h"

namespace illum {
namespace {

constexpr int kPlanes = 18;

const std::vector<BenchPlanes>& subjects() {
  static const std::vector<BenchPlanes> all = [] {
    std::vector<BenchPlanes> planes;
    const char* variable = std::getenv("ILLUM_SHARED");
    const std::filesystem::path shared = variable ? variable : "../shared";
    for (const char* stack : {"realrti09_coin_a", "realrti03_icon_michele"}) {
      const auto folder = shared / "data" / stack / "stack";
      if (std::filesystem::exists(folder)) planes.push_back(photographPlanes(folder, kPlanes));
    }
    if (planes.empty()) planes.push_back(syntheticPlanes({512, 512}, kPlanes));
    return planes;
  }();
  return all;
}

void report(benchmark::State& state, const BenchPlanes& subject, std::size_t bytes,
            const PlaneCodes& decoded) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(subject.values.size()));
  state.counters["bytes"] = static_cast<double>(bytes);
  state.counters["dB"] = subject.decibels(decoded);
}

void encode(benchmark::State& state, const BenchPlanes& subject, Coding coding,
            EncodeSettings settings) {
  std::vector<std::byte> file;
  for (auto _ : state) file = encodeTile(subject.codes, coding, 8, settings);
  report(state, subject, file.size(),
         decodeTile(coding, 8, subject.codes.planes, subject.codes.tile, file, "tile"));
}

void decode(benchmark::State& state, const BenchPlanes& subject, Coding coding,
            EncodeSettings settings) {
  const auto file = encodeTile(subject.codes, coding, 8, settings);
  PlaneCodes codes;
  for (auto _ : state)
    codes = decodeTile(coding, 8, subject.codes.planes, subject.codes.tile, file, "tile");
  report(state, subject, file.size(), codes);
}

void add(const BenchPlanes& subject, Coding coding, EncodeSettings settings) {
  std::string name = subject.name + "/" + std::string(nameOf(coding));
  if (coding != Coding::Png) name += "/quality:" + std::to_string(settings.quality);
  if (coding == Coding::Avif) name += "/speed:" + std::to_string(settings.speed);
  const auto unit = benchmark::kMillisecond;
  benchmark::RegisterBenchmark(("encode/" + name).c_str(), encode, subject, coding, settings)
      ->Unit(unit);
  if (coding != Coding::Avif || settings.speed == EncodeSettings().speed)
    benchmark::RegisterBenchmark(("decode/" + name).c_str(), decode, subject, coding, settings)
        ->Unit(unit);
}

const bool kRegistered = [] {
  for (const BenchPlanes& subject : subjects()) {
    add(subject, Coding::Png, {});
    for (const int quality : {90, 80, 65, 50, 35}) {
      add(subject, Coding::Jpeg, {quality, 0});
      add(subject, Coding::Avif, {quality, EncodeSettings().speed});
    }
    for (const int speed : {2, 3, 4, 5, 7, 8, 9, 10})
      for (const int quality : {80, 50}) add(subject, Coding::Avif, {quality, speed});
  }
  return true;
}();

}  // namespace
}  // namespace illum
