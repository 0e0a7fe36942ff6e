// How long reading and fitting a stack takes, against its limits in the same run: decoding the same
// JPEG files by libjpeg-turbo alone, and the same matrix products by sgemm alone, on the same
// threads. What fresh memory costs is told beside: on a virtual machine that can be as much.
//
//   illum_fit_speed FOLDER [RUNS]        FOLDER: baseline JPEG photographs with a light file
#include <cblas.h>
#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <jpeglib.h>
#include <cstdio>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <vector>

#include "build/plan.h"
#include "build/plane_row.h"
#include "core/files.h"
#include "core/memory.h"
#include "core/page_buffer.h"
#include "encode/encode_tile.h"

namespace {

using namespace illum;
using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Decodes into one row that is thrown away.
void decodeAlone(const std::vector<std::byte>& file) {
  jpeg_decompress_struct decoder;
  jpeg_error_mgr errors;
  decoder.err = jpeg_std_error(&errors);
  jpeg_create_decompress(&decoder);
  jpeg_mem_src(&decoder, reinterpret_cast<const unsigned char*>(file.data()), file.size());
  jpeg_read_header(&decoder, TRUE);
  decoder.out_color_space = JCS_RGB;
  jpeg_start_decompress(&decoder);
  std::vector<JSAMPLE> row(3 * decoder.output_width);
  JSAMPROW rows[] = {row.data()};
  while (decoder.output_scanline < decoder.output_height) jpeg_read_scanlines(&decoder, rows, 1);
  jpeg_finish_decompress(&decoder);
  jpeg_destroy_decompress(&decoder);
}

double timeDecoding(const std::filesystem::path& folder, const Capture& capture) {
  const auto start = Clock::now();
  const auto& lights = capture.lights();
  tbb::parallel_for(std::size_t{0}, lights.size(), [&](std::size_t i) {
    decodeAlone(readFile(folder / lights[i].name, std::uint64_t{1} << 32));
  });
  return secondsSince(start);
}

double timeProducts(const PlaneOperator& op, std::size_t pixels) {
  constexpr std::size_t kPatch = 4096;
  const auto rows = 3 * static_cast<std::size_t>(op.lights);
  struct Buffers {
    std::vector<float> samples, planes;
  };
  tbb::enumerable_thread_specific<Buffers> buffers;
  const auto start = Clock::now();
  tbb::parallel_for(std::size_t{0}, (pixels + kPatch - 1) / kPatch, [&](std::size_t) {
    auto& b = buffers.local();
    b.samples.resize(rows * kPatch, 0.5f);
    b.planes.resize(static_cast<std::size_t>(op.planes) * kPatch);
    cblas_sgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, op.planes, static_cast<int>(kPatch),
                static_cast<int>(rows), 1.0f, op.matrix.data(), static_cast<int>(rows),
                b.samples.data(), static_cast<int>(kPatch), 0.0f, b.planes.data(),
                static_cast<int>(kPatch));
  });
  return secondsSince(start);
}

// Writes to every page of as much fresh memory as the decoded photographs take: what the system
// needs to clear it, or to get it from elsewhere.
double timeFreshPages(const Capture& capture) {
  constexpr std::size_t kPart = std::size_t{1} << 22, kPage = 4096;
  const auto start = Clock::now();
  const PageBuffer pages(3 * capture.lights().size() * capture.size().pixels());
  tbb::parallel_for(std::size_t{0}, (pages.bytes() + kPart - 1) / kPart, [&](std::size_t i) {
    const std::size_t end = std::min(pages.bytes(), (i + 1) * kPart);
    for (std::size_t at = i * kPart; at < end; at += kPage) pages.data()[at] = std::byte{1};
  });
  return secondsSince(start);
}

struct WholeWay {
  double seconds = 0, opening = 0, decoding = 0, choosing = 0;
  Fit fit;
};

// Everything of a build but the coding of tiles.
WholeWay readAndFit(const std::filesystem::path& folder, std::uint64_t memoryBytes) {
  Progress silent;
  const auto start = Clock::now();
  PhotographOptions photographs;
  photographs.memoryBytes = memoryBytes * 6 / 10;
  const auto capture = openPhotographs(folder, photographs, silent);
  const auto lights = chooseLights(*capture, 0);
  const double opening = secondsSince(start);
  std::vector<float> first(3);
  capture->read(0, {0, 0, 1, 1}, std::span(lights.used).first(1), first);  // decodes all, or a band
  const double decoding = secondsSince(start) - opening;
  const Plan plan = planObject(*capture, lights, {}, Response::Display, memoryBytes / 4, silent);
  const double choosing = secondsSince(start) - opening - decoding;
  Manifest manifest;
  manifest.groups = {{capture->views().front(), 0, {}}};
  const Fit& fit = plan.bases.front().fit;
  RowFitter fitter(*capture, lights.used, {&fit.planes}, manifest, silent);
  for (int row = 0; row < manifest.grid(0).tilesDown(0); ++row) fitter.fit(0, row);
  return {secondsSince(start), opening, decoding, choosing, fit};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: illum_fit_speed FOLDER [RUNS]\n");
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const int runs = argc > 2 ? std::atoi(argv[2]) : 3;
  const std::uint64_t memoryBytes = machineMemoryBytes() / 4;
  Progress silent;
  const auto capture = openPhotographs(folder, {}, silent);
  openblas_set_num_threads(1);
  fmt::print("{} photographs of {} x {}\n", capture->lights().size(), capture->size().width,
             capture->size().height);
  // One round untimed, so that files are in the page cache for all alike.
  timeDecoding(folder, *capture);
  for (int run = 0; run < runs; ++run) {
    const WholeWay whole = readAndFit(folder, memoryBytes);
    const double decoding = timeDecoding(folder, *capture);
    const double products = timeProducts(whole.fit.planes, capture->size().pixels());
    const double fresh = timeFreshPages(*capture);
    fmt::print(
        "decoding alone {:.2f} s, sgemm alone {:.2f} s ({} planes), fresh pages alone {:.2f} s; "
        "read and fit {:.2f} s (opening "
        "{:.2f}, decoding {:.2f}, choosing {:.2f}, planes {:.2f}): ratio {:.3f}, with pages "
        "{:.3f}\n",
        decoding, products, whole.fit.planes.planes, fresh, whole.seconds, whole.opening,
        whole.decoding, whole.choosing,
        whole.seconds - whole.opening - whole.decoding - whole.choosing,
        whole.seconds / (decoding + products), whole.seconds / (decoding + products + fresh));
  }
  return 0;
}
