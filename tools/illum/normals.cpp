#include "illum/normals.h"

#include <fmt/format.h>

#include <memory>

#include "commands.h"
#include "illum/error.h"
#include "illum/picture_io.h"
#include "input_options.h"
#include "view_options.h"

namespace illum::cli {
namespace {

struct NormalsCommand {
  MachineOptions machine;
  std::string object, output, heights, view, method = "robust";

  void addTo(CLI::App& command) {
    command.add_option("OBJECT", object, ".illum file or folder")->required();
    command.add_option("-o,--output", output, "normals: .png (16 bits, (n + 1) / 2) or .exr")
        ->required();
    command.add_option("--height", heights,
                       "heights too, in units of the object: .exr, or .png from lowest to highest");
    command.add_option("--view", view, "u,v, SLAB:u,v or NAME (default: the middle view)");
    command.add_option("--method", method,
                       "robust (default), or plain: least squares over all lights");
    machine.addTo(command);
  }

  NormalOptions options() const {
    NormalOptions options;
    options.memoryBytes = machine.memoryBytes() / 2;
    if (method == "plain")
      options.method = NormalOptions::Method::LeastSquares;
    else if (method != "robust")
      throw Error(Fault::Usage,
                  fmt::format("--method: expected robust or plain, found \"{}\"", method));
    return options;
  }

  int group(const Object& opened) const {
    ViewOptions views;
    views.view = view;
    const auto group = views.choice(opened, Direction::fromVector({0, 1, 0})).group;
    if (group) return *group;
    throw Error(Fault::Usage, fmt::format("--view: expected a view that the object has, found "
                                          "\"{}\"",
                                          view));
  }

  void checkNames() const {
    for (const std::string& name : {output, heights}) {
      if (!name.empty() && pictureFormat(name) == PictureFormat::Jpeg) {
        throw Error(Fault::Usage,
                    fmt::format("{}: expected a name that ends in .png or .exr", name));
      }
    }
  }

  int run() const {
    const NormalOptions settings = options();
    checkNames();
    const ThreadLimit limit(machine.threads);
    const Object opened = Object::open(object);
    const int chosen = group(opened);
    if (!heights.empty() &&
        !std::holds_alternative<OrthographicView>(opened.view(chosen).geometry)) {
      throw Error(Fault::Usage,
                  fmt::format("--height: heights are integrated for photographs, {} has views of "
                              "another kind",
                              object));
    }
    const Picture normals = surfaceNormals(opened, chosen, settings);
    writeNormals(output, normals);
    if (!heights.empty()) {
      const HeightRange range = writeHeights(heights, photographHeights(normals));
      fmt::print("heights from {:.4f} to {:.4f}\n", range.lowest, range.highest);
    }
    return kDone;
  }
};

}  // namespace

void addNormals(CLI::App& program, int& exitCode) {
  auto* command = program.add_subcommand("normals", "the surface that an object's light shows");
  const auto state = std::make_shared<NormalsCommand>();
  state->addTo(*command);
  command->callback([state, &exitCode] { exitCode = state->run(); });
}

}  // namespace illum::cli
