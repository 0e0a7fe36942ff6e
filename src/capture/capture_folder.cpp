#include "illum/capture_folder.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <list>
#include <mutex>
#include <optional>

#include "capture/camera_list.h"
#include "capture/capture_file.h"
#include "capture/file_pool.h"
#include "capture/lanes.h"
#include "capture/photo_reader.h"
#include "capture/photograph_list.h"
#include "capture/proxy_mesh.h"
#include "core/files.h"
#include "core/memory.h"
#include "illum/error.h"
#include "illum/picture_io.h"

namespace illum {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxCaptureFileBytes = std::uint64_t{1} << 30;
constexpr int kMostOpenViews = 4;
constexpr const char* kProxyName = "proxy.obj";  // where a list of cameras names none

// A picture of one number a pixel: OpenEXR as it is, anything else as coverage out of 255.
Picture readValues(const fs::path& file, Size expected) {
  // A pipe would be waited for.
  std::error_code missing;
  if (fs::exists(file, missing) && !fs::is_regular_file(file, missing)) {
    throw inputError(file, "a picture", "no ordinary file");
  }
  Picture picture;
  const bool exr = file.extension() == ".exr";
  if (exr) {
    picture = readPicture(file);
  } else {
    const BytePicture bytes = readBytePicture(file);
    picture = Picture(bytes.size(), bytes.channels());
    std::transform(bytes.samples().begin(), bytes.samples().end(), picture.samples().begin(),
                   [](std::uint8_t value) { return static_cast<float>(value) / 255.0F; });
  }
  if (picture.channels() != 1 || picture.size() != expected) {
    throw inputError(
        file, fmt::format("one channel of {}x{} pixels", expected.width, expected.height),
        fmt::format("{} of {}x{}", picture.channels(), picture.width(), picture.height()));
  }
  return picture;
}

void copyRectangle(const Picture& picture, const Rectangle& rectangle, std::span<float> values) {
  for (int y = 0; y < rectangle.height; ++y) {
    const auto row = picture.row(rectangle.y + y).subspan(static_cast<std::size_t>(rectangle.x));
    std::copy_n(row.begin(), rectangle.width,
                values.begin() + static_cast<std::ptrdiff_t>(y) * rectangle.width);
  }
}

// The pictures of one view, opened.
struct OpenView {
  int group = 0;
  std::unique_ptr<Capture> photographs;
  Picture mask, depth;  // empty: none
};

CaptureFile readColmap(const fs::path& folder, const fs::path& images) {
  ColmapText text;
  const fs::path cameras = images.parent_path() / "cameras.txt";
  text.images = readTextFile(images, kMaxCaptureFileBytes);
  text.cameras = readTextFile(cameras, kMaxCaptureFileBytes);
  text.imagesName = images.string();
  text.camerasName = cameras.string();
  std::error_code missing;
  if (fs::is_directory(folder / "images", missing)) text.picturesFolder = "images";
  return captureFromColmap(text);
}

// Lists of other programs say nothing of meshes.
CaptureFile withProxyBeside(const fs::path& folder, CaptureFile file) {
  std::error_code missing;
  if (fs::is_regular_file(folder / kProxyName, missing)) file.proxy = kProxyName;
  return file;
}

// `list`: capture.json, or what stands in its place.
CaptureFile readCameraList(const fs::path& folder, const fs::path& list,
                           const PhotographOptions& options) {
  if (list.filename() == "images.txt") return withProxyBeside(folder, readColmap(folder, list));
  const std::string text = readTextFile(list, kMaxCaptureFileBytes);
  if (list.filename() == kCaptureFileName) return captureFileFromText(text, list.string());
  const auto sizeOfPicture = [&](const std::string& name) {
    FilePool pool;
    return readHeader(pool, pool.add(folder / name), options.memoryBytes).upright();
  };
  return withProxyBeside(folder, captureFromTransforms(text, list.string(), sizeOfPicture));
}

// Views are opened when they are read, a few at a time: a thousand views under a thousand lights
// are more files than a system opens.
class CaptureFolder final : public Capture {
 public:
  CaptureFolder(const fs::path& folder, const PhotographOptions& options, Progress& progress)
      : folder_(folder), list_(cameraListIn(folder)), options_(options) {
    if (options_.memoryBytes == 0) options_.memoryBytes = machineMemoryBytes() / 4;
    if (list_.empty()) list_ = folder / kCaptureFileName;
    file_ = readCameraList(folder, list_, options_);
    if (!file_.proxy.empty()) {
      const fs::path proxy = folder / file_.proxy;
      proxy_ = proxyFromObj(readTextFile(proxy, kMaxCaptureFileBytes), proxy.string());
    }
    for (const CaptureFileView& view : file_.views) views_.push_back(view.view);
    mostOpen_ = std::min({kMostOpenViews, availableThreads() + 1, groups()});
    options_.lightFile.clear();
    options_.mask.clear();
    open_.push_front(openView(0, progress));
    transfer_ = open_.front()->photographs->transfer();
    hasAlpha_ = open_.front()->photographs->hasMask();
    bandRows_ = open_.front()->photographs->bandRows();
  }

  const std::vector<View>& views() const override { return views_; }
  Transfer transfer() const override { return transfer_; }
  const std::vector<LightFileEntry>& lights() const override { return file_.lights; }
  bool hasMask() const override { return !file_.views.front().mask.empty() || hasAlpha_; }
  bool hasDepth() const override { return !file_.views.front().depth.empty() || proxy_; }
  bool isRendered() const override { return file_.rendered; }
  int bandRows() const override { return bandRows_; }
  std::uint64_t residentBytes() const override { return options_.memoryBytes; }

  void read(int group, const Rectangle& rectangle, std::span<const int> lights,
            std::span<float> samples) const override {
    view(group)->photographs->read(0, rectangle, lights, samples);
  }
  void readMask(int group, const Rectangle& rectangle, std::span<float> coverage) const override {
    const auto open = view(group);
    if (open->mask.empty()) return open->photographs->readMask(0, rectangle, coverage);
    copyRectangle(open->mask, rectangle, coverage);
  }
  void readDepth(int group, const Rectangle& rectangle, std::span<float> depth) const override {
    if (!hasDepth()) return Capture::readDepth(group, rectangle, depth);
    copyRectangle(view(group)->depth, rectangle, depth);
  }
  std::string fingerprint() const override;

 private:
  std::shared_ptr<const OpenView> openView(int group, Progress& progress) const;
  std::shared_ptr<const OpenView> view(int group) const;

  fs::path pictureUnder(const CaptureFileView& view, std::size_t light) const;

  fs::path folder_, list_;
  PhotographOptions options_;
  CaptureFile file_;
  std::optional<ProxyMesh> proxy_;
  std::vector<View> views_;
  int mostOpen_ = 1, bandRows_ = 1;
  Transfer transfer_ = Transfer::Linear;
  bool hasAlpha_ = false;
  mutable Progress silent_;  // views are opened in the middle of other work
  mutable std::mutex mutex_;
  mutable std::list<std::shared_ptr<const OpenView>> open_;  // the latest used first
};

// Relative to the folder.
fs::path CaptureFolder::pictureUnder(const CaptureFileView& view, std::size_t light) const {
  try {
    return pictureOf(view, file_.lights[light], static_cast<int>(light));
  } catch (const Error& error) {
    throw Error(error.fault(), fmt::format("{}: {}", list_.string(), error.what()));
  }
}

std::shared_ptr<const OpenView> CaptureFolder::openView(int group, Progress& progress) const {
  const CaptureFileView& entry = file_.views[static_cast<std::size_t>(group)];
  const Size size = sizeOf(entry.view.geometry);
  auto view = std::make_shared<OpenView>();
  view->group = group;
  if (!entry.mask.empty()) view->mask = readValues(folder_ / entry.mask, size);
  if (!entry.depth.empty()) view->depth = readValues(folder_ / entry.depth, size);
  if (proxy_) view->depth = depthOfProxy(*proxy_, entry.view.geometry);

  PhotographList list{folder_, {}, file_.lights};
  for (std::size_t i = 0; i < file_.lights.size(); ++i) {
    list.files.push_back(folder_ / pictureUnder(entry, i));
  }
  const fs::path first = list.files.front();
  PhotographOptions options = options_;
  const std::uint64_t own =
      (view->mask.samples().size() + view->depth.samples().size()) * sizeof(float);
  const std::uint64_t share = options_.memoryBytes / static_cast<std::uint64_t>(mostOpen_);
  options.memoryBytes = std::max<std::uint64_t>(1, share - std::min(share, own));
  view->photographs = openPhotographList(std::move(list), options, progress);
  if (view->photographs->size() != size) {
    const Size found = view->photographs->size();
    throw inputError(
        first,
        fmt::format("{}x{} pixels as view '{}' has", size.width, size.height, entry.view.name),
        fmt::format("{}x{}", found.width, found.height));
  }
  return view;
}

std::shared_ptr<const OpenView> CaptureFolder::view(int group) const {
  const std::lock_guard lock(mutex_);
  auto at = std::find_if(open_.begin(), open_.end(),
                         [&](const auto& open) { return open->group == group; });
  if (at == open_.end()) {
    if (static_cast<int>(open_.size()) >= mostOpen_) open_.pop_back();
    // Whoever holds the lock must not take up other work, which may wait for it.
    auto opened = tbb::this_task_arena::isolate([&] { return openView(group, silent_); });
    if (opened->photographs->transfer() != transfer_) {
      throw inputError(list_, "all views linear or all display-referred",
                       fmt::format("'{}' unlike '{}'", views_[static_cast<std::size_t>(group)].name,
                                   views_.front().name));
    }
    at = open_.insert(open_.begin(), std::move(opened));
  }
  open_.splice(open_.begin(), open_, at);
  return open_.front();
}

// Contents are not read for it: a capture may be larger than a disk reads in an hour. What was
// changed since has another time.
std::string CaptureFolder::fingerprint() const {
  std::string text = textOf(file_);
  const auto add = [&](const fs::path& name) {
    struct stat status {};
    const fs::path file = folder_ / name;
    if (::stat(file.c_str(), &status) != 0) throw fileError(file, "look at", errno);
    text += fmt::format("{} {} {}.{:09}\n", name.string(), status.st_size, status.st_mtim.tv_sec,
                        status.st_mtim.tv_nsec);
  };
  for (const CaptureFileView& view : file_.views) {
    for (std::size_t i = 0; i < file_.lights.size(); ++i) {
      add(pictureUnder(view, i));
    }
    if (!view.mask.empty()) add(view.mask);
    if (!view.depth.empty()) add(view.depth);
  }
  if (!file_.proxy.empty()) add(file_.proxy);
  return fmt::format("capture folder {:08x} {}", crc32Of(std::as_bytes(std::span(text))),
                     text.size());
}

}  // namespace

bool isCaptureFolder(const fs::path& folder) {
  return !cameraListIn(folder).empty();
}

std::unique_ptr<Capture> openCaptureFolder(const fs::path& folder, const PhotographOptions& options,
                                           Progress& progress) {
  return std::make_unique<CaptureFolder>(folder, options, progress);
}

}  // namespace illum
