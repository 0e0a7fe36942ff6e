// A scene as a capture.
#pragma once

#include <memory>
#include <string>

#include "illum/capture.h"
#include "scene/scene.h"

namespace illum {

/// Every view a group, every light rendered when it is read. Throws Error (Fault::Input) for what
/// cannot be rendered.
std::unique_ptr<Capture> renderedCapture(const SceneCapture& scene);

/// Of all content and settings: equal text = equal samples, on one kind of machine.
std::string sceneFingerprint(const SceneCapture& scene);

}  // namespace illum
