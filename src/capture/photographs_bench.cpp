// Decoding a stack against decoding alone: libjpeg-turbo on the same files, in the same run, on as
// many threads.
//
//   ILLUM_BENCH_PHOTOGRAPHS   how many (12)
//   ILLUM_BENCH_MEGAPIXELS    of each (12)
#include <OpenImageIO/imageio.h>
#include <benchmark/benchmark.h>
#include <tbb/blocked_range2d.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numeric>
#include <string>
#include <vector>
// After <cstdio>, which it needs and does not include.
#include <jpeglib.h>
#include <unistd.h>

#include "illum/capture.h"

namespace illum {
namespace {

using Clock = std::chrono::steady_clock;

int numberFrom(const char* variable, int standard) {
  const char* text = std::getenv(variable);
  return text == nullptr ? standard : std::max(1, std::atoi(text));
}

// Of the wall clock, and of all threads together, which other programs disturb less.
struct Spent {
  double wall = 0, processor = 0;
  Spent& operator+=(const Spent& more) {
    wall += more.wall;
    processor += more.processor;
    return *this;
  }
};

template <typename Work>
Spent spentOn(Work work) {
  const auto begin = Clock::now();
  const std::clock_t processorBegin = std::clock();
  work();
  return {std::chrono::duration<double>(Clock::now() - begin).count(),
          static_cast<double>(std::clock() - processorBegin) / CLOCKS_PER_SEC};
}

// A folder of photographs whose noise and edges cost about as much as a camera's, removed at the
// end.
class Stack {
 public:
  explicit Stack(bool progressive) : count_(numberFrom("ILLUM_BENCH_PHOTOGRAPHS", 12)) {
    const double megapixels = numberFrom("ILLUM_BENCH_MEGAPIXELS", 12);
    width_ = static_cast<int>(std::sqrt(megapixels * 4 / 3 * 1e6)) / 16 * 16;
    height_ = width_ * 3 / 4;
    std::string name = (std::filesystem::temp_directory_path() / "illum-bench-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) std::abort();
    folder_ = name;
    writePhotograph(progressive);
    std::ofstream lights(folder_ / "lights.lp");
    for (int i = 0; i < count_; ++i) {
      if (i > 0) std::filesystem::copy(file(0), file(i));
      lights << file(i).filename().string() << " " << std::cos(i) << " " << std::sin(i) << " 1\n";
    }
  }
  ~Stack() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Stack(const Stack&) = delete;
  Stack& operator=(const Stack&) = delete;

  int count() const { return count_; }
  double megapixels() const { return 1e-6 * count_ * width_ * height_; }
  std::uint64_t bytes() const {
    return std::uint64_t{3} * static_cast<unsigned>(count_) * static_cast<unsigned>(width_) *
           static_cast<unsigned>(height_);
  }
  const std::filesystem::path& folder() const { return folder_; }
  std::filesystem::path file(int i) const { return folder_ / ("p" + std::to_string(i) + ".jpg"); }

 private:
  void writePhotograph(bool progressive) const {
    OIIO::ImageSpec spec(width_, height_, 3, OIIO::TypeUInt8);
    spec.attribute("Compression", "jpeg:92");
    spec.attribute("jpeg:subsampling", "4:2:0");
    if (progressive) spec.attribute("jpeg:progressive", 1);
    std::vector<std::uint8_t> samples;
    std::uint32_t noise = 1;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const double shape = 120 + 60 * std::sin(x * 0.01) * std::cos(y * 0.013) +
                             ((x / 64 + y / 48) % 2 == 0 ? 25 : -25);
        for (int c = 0; c < 3; ++c) {
          noise = noise * 1664525 + 1013904223;
          samples.push_back(static_cast<std::uint8_t>(shape + 5 * c + (noise >> 28)));
        }
      }
    }
    const auto output = OIIO::ImageOutput::create("a.jpg");
    if (!output || !output->open(file(0).string(), spec) ||
        !output->write_image(OIIO::TypeUInt8, samples.data()) || !output->close()) {
      std::abort();
    }
  }

  int count_, width_ = 0, height_ = 0;
  std::filesystem::path folder_;
};

const Stack& stack(bool progressive) {
  static const Stack baseline(false), slow(true);
  return progressive ? slow : baseline;
}

// All that libjpeg-turbo itself takes: the rows go nowhere.
void decodeAlone(const std::filesystem::path& file) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(file.c_str(), "rb"),
                                                           std::fclose);
  jpeg_decompress_struct codec{};
  jpeg_error_mgr errors{};
  codec.err = jpeg_std_error(&errors);
  jpeg_create_decompress(&codec);
  jpeg_stdio_src(&codec, in.get());
  jpeg_read_header(&codec, TRUE);
  jpeg_start_decompress(&codec);
  std::vector<JSAMPLE> rows(std::size_t{3} * 16 * codec.output_width);
  JSAMPROW pointers[16];
  for (std::size_t i = 0; i < 16; ++i) pointers[i] = rows.data() + 3 * i * codec.output_width;
  while (codec.output_scanline < codec.output_height) jpeg_read_scanlines(&codec, pointers, 16);
  jpeg_finish_decompress(&codec);
  jpeg_destroy_decompress(&codec);
}

Spent decodingAlone(const Stack& photographs) {
  return spentOn([&] {
    tbb::parallel_for(
        0, photographs.count(), [&](int i) { decodeAlone(photographs.file(i)); },
        tbb::simple_partitioner());
  });
}

std::unique_ptr<Capture> openStack(const Stack& photographs, std::uint64_t memoryBytes) {
  static Progress progress;
  PhotographOptions options;
  options.memoryBytes = memoryBytes;
  return openPhotographs(photographs.folder(), options, progress);
}

// Does `work` beside decoding alone, and says how they compare.
template <typename Work>
void compare(benchmark::State& state, const Stack& photographs, Work work) {
  Spent alone, spent;
  for ([[maybe_unused]] auto _ : state) {
    alone += decodingAlone(photographs);
    const Spent one = spentOn(work);
    state.SetIterationTime(one.wall);
    spent += one;
  }
  state.counters["wall/alone"] = spent.wall / alone.wall;
  state.counters["cpu/alone"] = spent.processor / alone.processor;
  const double done = photographs.megapixels() * static_cast<double>(state.iterations());
  state.counters["MP/s"] = done / spent.wall;
  state.counters["MP/s/thread"] = done / spent.processor;
}

// Opening, decoding into memory and one sample.
void decodeIntoMemory(benchmark::State& state) {
  const Stack& photographs = stack(state.range(0) != 0);
  compare(state, photographs, [&] {
    const auto capture = openStack(photographs, 4 * photographs.bytes());
    float samples[3];
    const int light = 0;
    capture->read(0, {0, 0, 1, 1}, std::span(&light, 1), samples);
  });
}
BENCHMARK(decodeIntoMemory)
    ->ArgName("progressive")
    ->Arg(0)
    ->Arg(1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

// Going down once, band after band, with a third of the stack's bytes.
void decodeInBands(benchmark::State& state) {
  const Stack& photographs = stack(state.range(0) != 0);
  compare(state, photographs, [&] {
    const auto capture = openStack(photographs, photographs.bytes() / 3);
    float samples[3];
    const int light = 0;
    for (int y = 0; y < capture->size().height; y += capture->bandRows()) {
      capture->read(0, {0, y, 1, 1}, std::span(&light, 1), samples);
    }
  });
}
BENCHMARK(decodeInBands)
    ->ArgName("progressive")
    ->Arg(0)
    ->Arg(1)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

// What is left once everything is decoded: bytes to planes of floats, block by block.
void convertFromMemory(benchmark::State& state) {
  const Stack& photographs = stack(false);
  const auto capture = openStack(photographs, 4 * photographs.bytes());
  std::vector<int> lights(capture->lights().size());
  std::iota(lights.begin(), lights.end(), 0);
  float first[3];
  capture->read(0, {0, 0, 1, 1}, std::span(lights).first(1), first);
  constexpr int kWidth = 512, kHeight = 4;
  tbb::enumerable_thread_specific<std::vector<float>> buffers(
      std::vector<float>(3 * lights.size() * kWidth * kHeight));
  const Size size = capture->size();
  compare(state, photographs, [&] {
    tbb::parallel_for(
        tbb::blocked_range2d<int>(0, size.height / kHeight, 16, 0, size.width / kWidth, 1),
        [&](const tbb::blocked_range2d<int>& blocks) {
          std::vector<float>& samples = buffers.local();
          for (int row = blocks.rows().begin(); row < blocks.rows().end(); ++row) {
            const int x = blocks.cols().begin() * kWidth;
            capture->read(0, {x, row * kHeight, kWidth, kHeight}, lights, samples);
            benchmark::DoNotOptimize(samples.data());
          }
        },
        tbb::simple_partitioner());
  });
}
BENCHMARK(convertFromMemory)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace illum
