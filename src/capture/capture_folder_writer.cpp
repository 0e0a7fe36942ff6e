#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "capture/capture_file.h"
#include "core/files.h"
#include "core/memory.h"
#include "core/rename.h"
#include "core/stoppable_progress.h"
#include "illum/capture_folder.h"
#include "illum/error.h"
#include "illum/version.h"
#include "image/formats.h"

namespace illum {
namespace {

namespace fs = std::filesystem;

// Side of what one task reads at a time, under all lights of a batch.
constexpr int kPatchSide = 32;
constexpr std::string_view kLightFileName = "lights.lp";

std::string pictureName(std::size_t light) {
  return fmt::format("light_{:04}.exr", light);
}

// FOLDER.partial, which becomes FOLDER or goes away.
class NewFolder {
 public:
  NewFolder(const fs::path& folder, bool force)
      : folder_(folder.has_filename() ? folder : folder.parent_path()), force_(force) {
    check();
    partial_ = folder_;
    partial_ += ".partial";
    std::error_code error;
    fs::remove_all(partial_, error);
    if (!error) fs::create_directories(partial_, error);
    if (error) throw fileError(partial_, "create the folder", error.value());
  }
  ~NewFolder() {
    std::error_code ignored;
    fs::remove_all(partial_, ignored);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;

  const fs::path& path() const { return partial_; }

  void publish() {
    check();
    std::error_code error;
    if (!fs::exists(fs::symlink_status(folder_, error))) return renameToNew(partial_, folder_);
    fs::path aside = partial_;
    aside += ".replaced";
    exchange(partial_, folder_, aside);
    fs::remove_all(aside, error);
  }

 private:
  // Only empty folders and captures are replaced, captures only when asked.
  void check() const {
    std::error_code error;
    if (!fs::exists(fs::symlink_status(folder_, error))) return;
    const bool isFolder = fs::is_directory(folder_, error);
    if (isFolder && fs::is_empty(folder_, error)) return;
    if (!isFolder || !fs::exists(folder_ / kCaptureFileName, error)) {
      throw inputError(folder_, "no such folder yet, or an empty one, or a capture to replace",
                       isFolder ? "a folder with other contents" : "a file");
    }
    if (!force_) throw inputError(folder_, "no capture there yet (--force replaces it)", "one");
  }

  fs::path folder_, partial_;
  bool force_;
};

// Writes view by view, as many lights at a time as memory holds.
class FolderWriter {
 public:
  FolderWriter(const Capture& capture, const fs::path& folder, const CaptureFolderOptions& options,
               StoppableProgress& progress)
      : capture_(capture), folder_(folder), options_(options), progress_(progress) {}

  void write() {
    CaptureFile file;
    file.generator = fmt::format("Illumigraph {}", kVersion);
    file.rendered = capture_.isRendered();
    file.lights = capture_.lights();
    for (LightFileEntry& entry : file.lights) entry.light.intensity = {1, 1, 1};
    progress_.begin("capturing",
                    static_cast<std::uint64_t>(capture_.groups()) * capture_.lights().size());
    for (int group = 0; group < capture_.groups(); ++group) {
      const std::string name = fmt::format("views/{:04}", group);
      fs::create_directories(folder_ / name);
      writePhotographs(group, folder_ / name);
      writeLightFile(group, folder_ / name);
      CaptureFileView entry{capture_.views()[static_cast<std::size_t>(group)],
                            name + "/light_{index}.exr", "", ""};
      if (capture_.hasMask()) entry.mask = name + "/mask.exr";
      if (capture_.hasDepth()) entry.depth = name + "/depth.exr";
      writeValues(group, entry);
      file.views.push_back(std::move(entry));
    }
    progress_.end();
    writeFileAtomically(folder_ / kCaptureFileName, textOf(file));
  }

 private:
  void writePhotographs(int group, const fs::path& folder) {
    const std::size_t lights = capture_.lights().size();
    // A picture stands in memory as samples, as a picture and as a file.
    const std::uint64_t each = 3 * 3 * sizeof(float) * capture_.size(group).pixels();
    const std::size_t batch =
        static_cast<std::size_t>(std::clamp<std::uint64_t>(options_.memoryBytes / each, 1, lights));
    for (std::size_t first = 0; first < lights; first += batch) {
      writeBatch(group, folder, first, std::min(batch, lights - first));
    }
  }

  void writeBatch(int group, const fs::path& folder, std::size_t first, std::size_t count) {
    const Size size = capture_.size(group);
    std::vector<int> lights(count);
    std::iota(lights.begin(), lights.end(), static_cast<int>(first));
    std::vector<Picture> pictures(count);
    for (Picture& picture : pictures) picture = Picture(size, 3);
    const int across = (size.width + kPatchSide - 1) / kPatchSide;
    const int down = (size.height + kPatchSide - 1) / kPatchSide;
    tbb::parallel_for(0, across * down, [&](int patch) {
      progress_.check();
      const int x = patch % across * kPatchSide, y = patch / across * kPatchSide;
      const Rectangle rectangle{x, y, std::min(kPatchSide, size.width - x),
                                std::min(kPatchSide, size.height - y)};
      readPatch(group, rectangle, lights, pictures);
    });
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      const fs::path file = folder / pictureName(first + i);
      try {
        writeFileAtomically(file, encodeExr(pictures[i], samples()));
      } catch (const Error& error) {
        if (error.fault() == Fault::Machine) throw;
        throw Error(error.fault(), fmt::format("{}: {}", file.string(), error.what()));
      }
      pictures[i] = {};
    });
    for (std::size_t i = 0; i < count; ++i) progress_.advance(1);
  }

  void readPatch(int group, const Rectangle& patch, const std::vector<int>& lights,
                 std::vector<Picture>& pictures) const {
    const std::size_t pixels = patch.pixels();
    std::vector<float> samples(3 * lights.size() * pixels);
    capture_.read(group, patch, lights, samples);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      const float* planes = samples.data() + 3 * i * pixels;
      for (std::size_t p = 0; p < pixels; ++p) {
        const auto column = static_cast<int>(p) % patch.width;
        const auto row = static_cast<int>(p) / patch.width;
        for (int c = 0; c < 3; ++c) {
          pictures[i].at(patch.x + column, patch.y + row, c) =
              planes[static_cast<std::size_t>(c) * pixels + p];
        }
      }
    }
  }

  void writeValues(int group, const CaptureFileView& entry) const {
    const Size size = capture_.size(group);
    const Rectangle all{0, 0, size.width, size.height};
    Picture values(size, 1);
    if (!entry.mask.empty()) {
      capture_.readMask(group, all, values.samples());
      writeFileAtomically(folder_ / entry.mask, encodeExr(values));
    }
    if (!entry.depth.empty()) {
      capture_.readDepth(group, all, values.samples());
      writeFileAtomically(folder_ / entry.depth, encodeExr(values));
    }
  }

  // So that each view by itself is a stack of photographs, its lights in its own frame.
  void writeLightFile(int group, const fs::path& folder) const {
    const auto& lights = capture_.lights();
    const auto& geometry = capture_.views()[static_cast<std::size_t>(group)].geometry;
    const RigidTransform groupFromObject = inverse(objectFromGroup(geometry));
    std::string text = fmt::format("{}\n", lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i) {
      const Direction d = groupFromObject.direction(lights[i].light.toLight);
      text += fmt::format("{} {} {} {}\n", pictureName(i), d.x(), d.y(), d.z());
    }
    writeFileAtomically(folder / kLightFileName, text);
  }

  ExrSamples samples() const { return options_.half ? ExrSamples::Half : ExrSamples::Float; }

  const Capture& capture_;
  const fs::path& folder_;
  const CaptureFolderOptions& options_;
  StoppableProgress& progress_;
};

}  // namespace

std::uint64_t captureFolderBytes(const Capture& capture, bool half) {
  const std::uint64_t sample = half ? 2 : 4;
  const std::uint64_t others = (capture.hasMask() ? 4U : 0U) + (capture.hasDepth() ? 4U : 0U);
  std::uint64_t bytes = 0;
  for (int group = 0; group < capture.groups(); ++group) {
    bytes += capture.size(group).pixels() * (3 * sample * capture.lights().size() + others);
  }
  return bytes;
}

bool writeCaptureFolder(const Capture& capture, const fs::path& folder,
                        const CaptureFolderOptions& options, Progress& progress) {
  CaptureFolderOptions filled = options;
  if (filled.memoryBytes == 0) filled.memoryBytes = machineMemoryBytes() / 4;
  NewFolder target(folder, options.force);
  try {
    StoppableProgress stoppable(progress, filled.stop);
    FolderWriter(capture, target.path(), filled, stoppable).write();
  } catch (const Stopped&) {
    return false;
  }
  target.publish();
  return true;
}

}  // namespace illum
