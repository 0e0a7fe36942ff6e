#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <system_error>

#include "capture/lanes.h"
#include "capture/light_file_search.h"
#include "capture/mask_picture.h"
#include "capture/photograph_list.h"
#include "capture/photograph_match.h"
#include "capture/photograph_stack.h"
#include "capture/sample_rows.h"
#include "core/memory.h"
#include "illum/capture.h"
#include "illum/error.h"

namespace illum {
namespace {

// Tables, names, directions: everything that is neither samples nor decoders.
constexpr std::uint64_t kBytesPerPhotograph = 16384;
constexpr std::uint64_t kQuarter = 4;

// Which photograph of a folder was taken under which light.
class ListMaker {
 public:
  ListMaker(const std::filesystem::path& folder, const PhotographOptions& options,
            Progress& progress)
      : folder_(folder), options_(options), progress_(progress) {}

  PhotographList make() {
    checkFolder();
    std::filesystem::path lightFile = options_.lightFile;
    if (lightFile.empty()) {
      const FoundLightFile found = findLightFile(folder_);
      lightFile = found.file;
      if (!found.remark.empty()) progress_.remark(found.remark);
    }
    LightFile lights = readLightFile(lightFile);
    std::error_code missing;
    const std::filesystem::path intensities = folder_ / "light_intensities.txt";
    if (std::filesystem::exists(intensities, missing)) readLightIntensities(intensities, lights);
    remark(lights.remarks);

    std::vector<std::string> names = filesIn(folder_);
    std::erase_if(names, [this](const std::string& name) { return isMask(name); });
    const PhotographMatch match = matchPhotographs(lights, lightFile, names);
    remark(match.remarks);
    PhotographList list{folder_, {}, std::move(lights.entries)};
    for (const std::string& name : match.names) list.files.push_back(folder_ / name);
    return list;
  }

 private:
  void checkFolder() const {
    std::error_code error;
    const auto status = std::filesystem::status(folder_, error);
    if (error) throw fileError(folder_, "open the folder of photographs", error.value());
    if (!std::filesystem::is_directory(status)) {
      throw inputError(folder_, "a folder of photographs", "something else");
    }
  }

  void remark(const std::vector<std::string>& remarks) {
    for (const std::string& sentence : remarks) progress_.remark(sentence);
  }

  bool isMask(const std::string& name) const {
    std::error_code missing;
    return !options_.mask.empty() &&
           std::filesystem::equivalent(folder_ / name, options_.mask, missing);
  }

  const std::filesystem::path& folder_;
  const PhotographOptions& options_;
  Progress& progress_;
};

// A list on its way to a stack.
class StackOpener {
 public:
  StackOpener(PhotographList list, const PhotographOptions& options, Progress& progress)
      : source_(std::move(list.source)),
        options_(options),
        progress_(progress),
        lights_(std::move(list.lights)) {
    if (options_.memoryBytes == 0) options_.memoryBytes = machineMemoryBytes() / kQuarter;
    if (options_.scratch.empty()) options_.scratch = std::filesystem::temp_directory_path();
    for (auto& file : list.files) photographs_.push_back({pool_->add(std::move(file)), {}, {}});
  }

  std::unique_ptr<Capture> open() {
    checkOptions();
    readHeaders();
    checkSizes();
    chooseRegion();
    readColours();
    readMask();
    return makeStack();
  }

 private:
  void checkOptions() const {
    if (options_.shrink < 1) {
      throw Error(Fault::Usage, "shrink: expected a whole number of at least 1, found " +
                                    std::to_string(options_.shrink));
    }
  }

  // Formats that are decoded as soon as they are opened are opened one at a time.
  void readHeaders() {
    const bool light = std::ranges::all_of(photographs_, [this](const Photograph& photograph) {
      const auto format = formatOfName(pool_->path(photograph.file));
      return format && !decodesWhenOpened(*format);
    });
    forEachInLanes(photographs_.size(), light ? availableThreads() : 1, [this](std::size_t i) {
      photographs_[i].header = readHeader(*pool_, photographs_[i].file, options_.memoryBytes);
    });
  }

  const std::filesystem::path& pathOf(const Photograph& photograph) const {
    return pool_->path(photograph.file);
  }
  std::string firstName() const { return pathOf(photographs_.front()).filename().string(); }

  void checkSizes() const {
    const Size expected = photographs_.front().header.upright();
    for (const Photograph& photograph : photographs_) {
      const Size found = photograph.header.upright();
      if (found == expected) continue;
      throw inputError(
          pathOf(photograph),
          fmt::format("{}x{} pixels as {}", expected.width, expected.height, firstName()),
          fmt::format("{}x{}", found.width, found.height));
    }
  }

  void chooseRegion() {
    const Size size = photographs_.front().header.upright();
    region_.crop = options_.crop.value_or(Rectangle{0, 0, size.width, size.height});
    region_.shrink = options_.shrink;
    const Rectangle& crop = region_.crop;
    const auto inside = [](int begin, int length, int all) {
      return begin >= 0 && length >= 1 && begin < all && length <= all - begin;
    };
    if (!inside(crop.x, crop.width, size.width) || !inside(crop.y, crop.height, size.height)) {
      throw Error(Fault::Usage,
                  fmt::format("crop: expected a rectangle within {}x{} pixels, found {}x{} at "
                              "({}, {})",
                              size.width, size.height, crop.width, crop.height, crop.x, crop.y));
    }
    if (region_.size().width < 1 || region_.size().height < 1) {
      throw Error(Fault::Usage, fmt::format("shrink: expected at most {}, found {}",
                                            std::min(crop.width, crop.height), region_.shrink));
    }
  }

  void readColours() {
    std::size_t overridden = 0;
    for (Photograph& photograph : photographs_) {
      const PhotographHeader& header = photograph.header;
      if (options_.transfer) {
        photograph.colour = {header.type, *options_.transfer, nullptr};
        overridden += header.profile.empty() ? 0 : 1;
        continue;
      }
      photograph.colour = profiles_.colourOf(pathOf(photograph), header);
    }
    if (overridden > 0) {
      progress_.remark(
          fmt::format("{}: {} embedded colour profiles are not looked at, because "
                      "the transfer function was given",
                      source_.string(), overridden));
    }
    checkTransfers();
  }

  void checkTransfers() const {
    const auto words = [](Transfer t) { return t == Transfer::Linear ? "linear" : "sRGB-encoded"; };
    const Transfer expected = photographs_.front().colour.transfer;
    for (const Photograph& photograph : photographs_) {
      if (photograph.colour.transfer == expected) continue;
      throw inputError(pathOf(photograph),
                       fmt::format("{} values as in {}", words(expected), firstName()),
                       fmt::format("{} ones", words(photograph.colour.transfer)));
    }
  }

  void readMask() {
    if (options_.mask.empty()) return;
    maskFile_ = pool_->add(options_.mask);
    mask_ = readMaskPicture(*pool_, *maskFile_, photographs_.front().header.upright(),
                            options_.memoryBytes);
  }

  std::unique_ptr<Capture> makeStack() {
    const Rectangle& crop = region_.crop;
    BandRequest request;
    request.rows = region_.size().height * region_.shrink;
    request.rowStep = 8 * region_.shrink;
    request.memoryBytes = options_.memoryBytes;
    request.otherBytes =
        kSharedTableBytes + mask_.samples().size() + kBytesPerPhotograph * photographs_.size();
    request.threads = availableThreads();
    const BandPlan plan = planBands(photographs_, request, source_.string());
    if (plan.scratchBytes > 0) {
      progress_.remark(fmt::format(
          "{}: photographs that cannot be read row by row go through a "
          "scratch file of {} in {}",
          source_.string(), textFromBytes(plan.scratchBytes), options_.scratch.string()));
    }
    StackParts parts;
    parts.pool = std::move(pool_);
    parts.photographs = std::move(photographs_);
    parts.lights = std::move(lights_);
    parts.region = region_;
    parts.mask = std::move(mask_);
    parts.maskFile = maskFile_;
    parts.plan = plan;
    parts.rows = request.rows;
    parts.top = crop.y;
    parts.scratch = options_.scratch;
    return makePhotographStack(std::move(parts), progress_);
  }

  std::filesystem::path source_;
  PhotographOptions options_;
  Progress& progress_;
  std::unique_ptr<FilePool> pool_ = std::make_unique<FilePool>();
  std::vector<LightFileEntry> lights_;
  std::vector<Photograph> photographs_;
  ColourProfiles profiles_;
  StackRegion region_;
  BytePicture mask_;
  std::optional<std::size_t> maskFile_;
};

}  // namespace

std::unique_ptr<Capture> openPhotographs(const std::filesystem::path& folder,
                                         const PhotographOptions& options, Progress& progress) {
  return openPhotographList(ListMaker(folder, options, progress).make(), options, progress);
}

std::unique_ptr<Capture> openPhotographList(PhotographList list, const PhotographOptions& options,
                                            Progress& progress) {
  return StackOpener(std::move(list), options, progress).open();
}

}  // namespace illum
