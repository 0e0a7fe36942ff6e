// Photographs that were left out, predicted from the others (docs/quality.md, "Photographs that
// were left out"). The data are public and not part of this project.
//
//   illum_view_holdout shop|cube FOLDER [SHRINK [EVERY [PICTURES]]]
//   illum_view_holdout shop-object FOLDER OBJECT [EVERY [PICTURES]]
//
// shop: a grid of parallel cameras, views/ and holdout/ with views.csv and holdout.csv (col, row,
// cam_x_mm, cam_y_mm); every EVERY-th of the held-out pictures is predicted. cube: images/,
// poses.json and proxy.obj, each view from all others. shop-object: the pictures of holdout/ at
// their full size, seen in an object that was built of those of views/ (scripts/posed_capture.py
// grid). PICTURES: a folder for sheets to look at.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "capture/proxy_mesh.h"
#include "core/files.h"
#include "held_out.h"
#include "illum/error.h"
#include "illum/lumigraph.h"
#include "illum/picture_io.h"
#include "lumigraph/sharpest_plane.h"
#include "lumigraph/swept_depth.h"

namespace {

using namespace illum;
using bench::Score;
namespace fs = std::filesystem;

struct Arguments {
  std::string what;
  fs::path folder;
  int shrink = 2, every = 12;
  fs::path pictures, object;
};

// A box of shrink x shrink pixels becomes one; RGBA, covered everywhere.
Picture readShrunk(const fs::path& file, int shrink) {
  const Picture full = readPicture(file);
  Picture picture({full.width() / shrink, full.height() / shrink}, 4);
  const float share = 1.0F / static_cast<float>(shrink * shrink);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      for (int i = 0; i < shrink * shrink; ++i) {
        for (int c = 0; c < 3; ++c) {
          picture.at(x, y, c) +=
              share * full.at(x * shrink + i % shrink, y * shrink + i / shrink, c);
        }
      }
      picture.at(x, y, 3) = 1;
    }
  }
  return picture;
}

// The ways of predicting, each with its score.
class Table {
 public:
  void add(const std::string& way, const Picture& found, const Picture& truth) {
    const auto at = std::ranges::find(rows_, way, &Row::way);
    Row& row = at != rows_.end() ? *at : rows_.emplace_back(Row{way, {}, 1});
    row.score.add(found, truth);
    row.coverage = std::min(row.coverage, bench::coverageShare(found, truth));
  }
  void print() const {
    fmt::print("| predicted by | PSNR, dB | least coverage |\n|---|---|---|\n");
    for (const Row& row : rows_) {
      fmt::print("| {} | {:.2f} | {:.1f} % |\n", row.way, row.score.decibels(), 100 * row.coverage);
    }
    fmt::print("{} pictures\n", rows_.empty() ? 0 : rows_.front().score.pictures());
  }

 private:
  struct Row {
    std::string way;
    Score score;
    double coverage;
  };
  std::vector<Row> rows_;
};

SynthesisOptions focusedAt(const Plane& plane, int blended) {
  SynthesisOptions options;
  options.focus = plane;
  options.blendedViews = blended;
  return options;
}

// --- the shop ---

struct ShopCamera {
  fs::path file;
  double x = 0, y = 0;  // metres
};

std::vector<ShopCamera> shopCameras(const fs::path& list, const fs::path& pictures) {
  std::ifstream file(list);
  if (!file) throw Error(Fault::Input, fmt::format("{}: cannot be read", list.string()));
  std::vector<ShopCamera> cameras;
  std::string line, cell;
  std::getline(file, line);  // the header
  while (std::getline(file, line)) {
    std::vector<std::string> cells;
    for (std::stringstream rest(line); std::getline(rest, cell, ',');) cells.push_back(cell);
    if (cells.size() < 5) continue;
    cameras.push_back(
        {pictures / cells[0], std::stod(cells[3]) / 1000, std::stod(cells[4]) / 1000});
  }
  return cameras;
}

View shopView(const ShopCamera& camera, Size size, double focal) {
  PinholeCamera pinhole;
  pinhole.objectFromCamera.translation = {camera.x, camera.y, 0};
  pinhole.size = size;
  pinhole.focalX = pinhole.focalY = focal;
  pinhole.centre = {0.5 * size.width, 0.5 * size.height};
  return {camera.file.stem().string(), pinhole};
}

class Shop {
 public:
  explicit Shop(const Arguments& arguments)
      : arguments_(arguments),
        sampled_(shopCameras(arguments.folder / "views.csv", arguments.folder / "views")),
        heldOut_(shopCameras(arguments.folder / "holdout.csv", arguments.folder / "holdout")) {
    const auto geometry =
        nlohmann::json::parse(readTextFile(arguments.folder / "geometry.json", 1 << 16));
    focal_ = geometry.at("focal_px").get<double>() / arguments.shrink;
  }

  void run() {
    std::unique_ptr<Lumigraph> lumigraph;
    if (!arguments_.object.empty()) {
      lumigraph = std::make_unique<Lumigraph>(Object::open(arguments_.object));
      // The object knows one light, from wherever it is asked for.
      const DirectionalLight light{Direction(), {1, 1, 1}};
      lumigraph->setLights(std::span(&light, 1));
    }
    for (std::size_t i = static_cast<std::size_t>(arguments_.every) / 2; i < heldOut_.size();
         i += static_cast<std::size_t>(arguments_.every)) {
      if (lumigraph)
        predictBy(*lumigraph, heldOut_[i]);
      else
        predict(heldOut_[i]);
      fmt::print(stderr, "{}\n", heldOut_[i].file.string());
    }
    table_.print();
  }

 private:
  void predictBy(Lumigraph& lumigraph, const ShopCamera& camera) {
    const Picture truth = readShrunk(camera.file, 1);
    const View target = shopView(camera, truth.size(), focal_);
    SynthesisOptions one;
    one.blendedViews = 1;
    std::vector<Picture> sheet{lumigraph.see(target.geometry, one).picture,
                               lumigraph.see(target.geometry).picture, truth};
    table_.add("one view", sheet[0], truth);
    table_.add("blending of 4", sheet[1], truth);
    if (!arguments_.pictures.empty()) {
      bench::writeSheet(arguments_.pictures / (target.name + "_object.png"), sheet);
    }
  }

  // The held-out cameras stand in the middle of four others, which are all that blending asks for.
  void predict(const ShopCamera& camera) {
    const Picture truth = readShrunk(camera.file, arguments_.shrink);
    const View target = shopView(camera, truth.size(), focal_);
    std::vector<SourceView> near = nearest(camera, 4);
    std::vector<Picture> sheet;
    const auto judge = [&](const char* way, const Picture& found) {
      table_.add(way, found, truth);
      sheet.push_back(found);
    };
    const auto source = viewSource(near);
    const Plane plane = sharpestPlane(*source).value();
    judge("nearest view", near[0].picture);
    judge("nearest view, on the best focal plane",
          synthesise(*source, target.geometry, focusedAt(plane, 1)).picture);
    judge("plain blending of 4", synthesise(*source, target.geometry).picture);
    judge("blending of 4 on the best focal plane",
          synthesise(*source, target.geometry, focusedAt(plane, 4)).picture);
    addDepth(near);
    judge("blending of 4 by swept depth", synthesise(*viewSource(near), target.geometry).picture);
    sheet.push_back(truth);
    if (!arguments_.pictures.empty()) {
      bench::writeSheet(arguments_.pictures / (target.name + ".png"), sheet);
    }
  }

  std::vector<SourceView> nearest(const ShopCamera& camera, std::size_t count) const {
    std::vector<ShopCamera> by = sampled_;
    std::stable_sort(by.begin(), by.end(), [&](const ShopCamera& a, const ShopCamera& b) {
      return std::hypot(a.x - camera.x, a.y - camera.y) <
             std::hypot(b.x - camera.x, b.y - camera.y) - 1e-9;
    });
    std::vector<SourceView> views;
    for (std::size_t i = 0; i < count; ++i) {
      Picture picture = readShrunk(by[i].file, arguments_.shrink);
      const View view = shopView(by[i], picture.size(), focal_);
      views.push_back({view, std::move(picture), {}});
    }
    return views;
  }

  // Of each view from the others.
  void addDepth(std::vector<SourceView>& views) const {
    std::vector<SmallView> small;
    for (const SourceView& view : views)
      small.push_back({ViewProjector(view.view.geometry), SmallPicture(view.picture, kSweptSide)});
    for (std::size_t i = 0; i < views.size(); ++i) {
      std::vector<const SmallView*> others;
      for (std::size_t k = 0; k < views.size(); ++k) {
        if (k != i) others.push_back(&small[k]);
      }
      views[i].depth = sweptDepth(views[i].picture, small[i], others);
    }
  }

  Arguments arguments_;
  std::vector<ShopCamera> sampled_, heldOut_;
  double focal_ = 1;
  Table table_;
};

// --- the cube ---

View cubeView(const nlohmann::json& entry, int shrink, Size size) {
  const double f = entry.at("f").get<double>() / shrink;
  const double cx = entry.at("cx").get<double>() / shrink;
  const double cy = entry.at("cy").get<double>() / shrink;
  ProjectionMatrix matrix{};
  for (std::size_t i = 0; i < 4; ++i) {
    std::array<double, 3> column;
    for (std::size_t r = 0; r < 3; ++r) {
      column[r] =
          i < 3 ? entry.at("R").at(r).at(i).get<double>() : entry.at("t").at(r).get<double>();
    }
    matrix[i] = f * column[0] + cx * column[2];
    matrix[4 + i] = f * column[1] + cy * column[2];
    matrix[8 + i] = column[2];
  }
  return {entry.at("file").get<std::string>(), pinholeFromProjection(matrix, size)};
}

// The mesh was made from another reconstruction of the photographs than their poses: it lies 3.5
// degrees and 2 % of scale away from the points that the poses and the tracks of images.txt give.
// The similarity that lays it upon them, by iterated closest points (Chen and Medioni 1992) between
// 1500 tracks and the mesh, median distance afterwards 0.03 (before: 0.74; the cube's edge is about
// 5).
constexpr std::array kMovedMesh{1.02136878,  -0.01073355, 0.00792374,  -0.62266327,
                                0.01119689,  1.01949502,  -0.06226329, 0.11368243,
                                -0.00725426, 0.06234483,  1.01952571,  -0.47158412};

ProxyMesh moved(ProxyMesh mesh) {
  for (Vector3& p : mesh.positions) {
    const auto row = [&](std::size_t r) {
      const double* m = &kMovedMesh[4 * r];
      return m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3];
    };
    p = {row(0), row(1), row(2)};
  }
  return mesh;
}

// The photographs' heights differ by a pixel or two, as taking their distortion out left them.
Picture cropped(const Picture& picture, Size size) {
  Picture part(size, picture.channels());
  for (int y = 0; y < std::min(size.height, picture.height()); ++y) {
    for (int x = 0; x < std::min(size.width, picture.width()); ++x) {
      for (int c = 0; c < picture.channels(); ++c) part.at(x, y, c) = picture.at(x, y, c);
    }
  }
  return part;
}

void predictCube(const Arguments& arguments) {
  const auto poses = nlohmann::json::parse(readTextFile(arguments.folder / "poses.json", 1 << 20));
  const ProxyMesh given =
      proxyFromObj(readTextFile(arguments.folder / "proxy.obj", 1 << 26), "proxy.obj");
  const ProxyMesh fitting = moved(given);
  std::vector<SourceView> onGiven, onFitting;
  for (const auto& entry : poses.at("views")) {
    Picture picture = readShrunk(arguments.folder / "images" / entry.at("file").get<std::string>(),
                                 arguments.shrink);
    const View view = cubeView(entry, arguments.shrink, picture.size());
    onGiven.push_back({view, picture, depthOfProxy(given, view.geometry)});
    onFitting.push_back({view, std::move(picture), depthOfProxy(fitting, view.geometry)});
  }
  const auto without = [](std::vector<SourceView> views, std::size_t i) {
    views.erase(views.begin() + static_cast<std::ptrdiff_t>(i));
    return views;
  };
  const auto eyeOf = [](const View& view) {
    return std::get<PinholeCamera>(view.geometry).objectFromCamera.translation;
  };
  Table table;
  for (std::size_t i = 0; i < onGiven.size(); ++i) {
    const SourceView& truth = onGiven[i];
    const std::vector<SourceView> others = without(onGiven, i), fitted = without(onFitting, i);
    const auto asGiven = viewSource(others), asFitting = viewSource(fitted);
    const auto nearest = std::ranges::min_element(others, {}, [&](const SourceView& other) {
      return length(eyeOf(other.view) - eyeOf(truth.view));
    });
    SynthesisOptions one, plain;
    one.blendedViews = 1;
    plain.useDepth = false;
    std::vector<Picture> sheet;
    const auto judge = [&](const char* way, const Picture& found) {
      table.add(way, found, truth.picture);
      sheet.push_back(found);
    };
    const ViewGeometry& target = truth.view.geometry;
    judge("nearest view", cropped(nearest->picture, truth.picture.size()));
    judge("blending of 4 on the plane that cameras look at",
          synthesise(*asGiven, target, plain).picture);
    judge("blending of 4 on the mesh as it is", synthesise(*asGiven, target).picture);
    judge("one view on the mesh where it belongs", synthesise(*asFitting, target, one).picture);
    judge("blending of 4 on the mesh where it belongs", synthesise(*asFitting, target).picture);
    sheet.push_back(truth.picture);
    if (!arguments.pictures.empty()) {
      bench::writeSheet(arguments.pictures / fmt::format("cube_{}.png", i), sheet);
    }
    fmt::print(stderr, "{}\n", truth.view.name);
  }
  table.print();
}

int run(const Arguments& arguments) {
  if (!fs::is_directory(arguments.folder)) {
    fmt::print("skipped: {} is not there\n", arguments.folder.string());
    return 0;
  }
  if (!arguments.pictures.empty()) fs::create_directories(arguments.pictures);
  if (arguments.what == "cube") {
    predictCube(arguments);
  } else {
    Shop(arguments).run();
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  if (argc > 1) arguments.what = argv[1];
  const bool ofObject = arguments.what == "shop-object";
  if (argc < (ofObject ? 4 : 3) ||
      (arguments.what != "shop" && arguments.what != "cube" && !ofObject)) {
    fmt::print(stderr,
               "usage: illum_view_holdout shop|cube FOLDER [SHRINK [EVERY [PICTURES]]]\n"
               "       illum_view_holdout shop-object FOLDER OBJECT [EVERY [PICTURES]]\n");
    return 2;
  }
  arguments.folder = argv[2];
  if (ofObject) {
    arguments.object = argv[3];
    arguments.shrink = 1;
  } else if (argc > 3)
    arguments.shrink = std::max(1, std::atoi(argv[3]));
  if (argc > 4) arguments.every = std::max(1, std::atoi(argv[4]));
  if (argc > 5) arguments.pictures = argv[5];
  try {
    return run(arguments);
  } catch (const Error& error) {
    fmt::print(stderr, "illum_view_holdout: {}\n", error.what());
    return 1;
  }
}
