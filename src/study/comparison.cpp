#include "study/comparison.h"

#include <algorithm>
#include <string>

#include "illum/colour.h"
#include "illum/error.h"
#include "object/manifest.h"

namespace illum {
namespace {

std::string photographsOf(Size size) {
  return "photographs of " + std::to_string(size.width) + "x" + std::to_string(size.height) +
         " pixels";
}

void checkComparable(const Object& object, const Capture& truth) {
  if (object.size() != truth.size())
    throw inputError(object.path(), photographsOf(object.size()) + " to judge it by",
                     photographsOf(truth.size()));
  if (truth.lights().empty()) throw inputError(object.path(), "photographs to judge it by", "none");
}

/// The alpha of any relit picture is the object's mask.
BytePicture coverageOf(const Relighter& relighter) {
  const Picture relit = relighter.relight({});
  BytePicture coverage(relit.size(), 1);
  for (std::size_t pixel = 0; pixel < relit.size().pixels(); ++pixel)
    coverage.samples()[pixel] = byteFromUnit(relit.samples()[4 * pixel + 3]);
  return coverage;
}

/// Premultiplied colour is colour over black.
Picture withoutAlpha(const Picture& relit) {
  Picture rgb(relit.size(), 3);
  for (std::size_t pixel = 0; pixel < relit.size().pixels(); ++pixel)
    std::copy_n(&relit.samples()[4 * pixel], 3, &rgb.samples()[3 * pixel]);
  return rgb;
}

}  // namespace

Comparison::Comparison(const Object& object, const Capture& truth, std::uint64_t tileMemoryBytes)
    : object_(object), truth_(truth), relighter_(object, tileMemoryBytes) {
  checkComparable(object, truth);
  coverage_ = illum::coverageOf(truth);
  if (coverage_.empty() && object.manifest().mask) coverage_ = coverageOf(relighter_);
}

Picture Comparison::relit(int light) const {
  const DirectionalLight& source = truth_.lights().at(static_cast<std::size_t>(light)).light;
  Picture relit = relighter_.relight({&source, 1});
  return relit.channels() == 4 ? withoutAlpha(relit) : relit;
}

void Comparison::readPhotograph(int light,
                                const std::function<void(const PhotographBand&)>& use) const {
  illum::readPhotograph(truth_, light, object_.manifest().mask ? coverage_ : BytePicture(), use);
}

}  // namespace illum
