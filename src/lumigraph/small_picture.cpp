#include "lumigraph/small_picture.h"

#include <algorithm>

#include "illum/colour.h"

namespace illum {

SmallPicture::SmallPicture(const Picture& picture, int longerSide)
    : shrink_(
          std::max(1, (std::max(picture.width(), picture.height()) + longerSide - 1) / longerSide)),
      colours_({picture.width() / shrink_, picture.height() / shrink_}, 3) {
  const auto share = 1 / static_cast<float>(shrink_ * shrink_);
  for (int y = 0; y < colours_.height() * shrink_; ++y) {
    for (int x = 0; x < colours_.width() * shrink_; ++x) {
      for (int c = 0; c < 3; ++c)
        colours_.at(x / shrink_, y / shrink_, c) += share * picture.at(x, y, c);
    }
  }
  for (float& value : colours_.samples()) value = displayFromLinear(std::clamp(value, 0.0F, 1.0F));
}

}  // namespace illum
