// Filling what the mask hides, so that hidden texels cost the coder little.
#pragma once

#include <span>

#include "illum/picture.h"

namespace illum {

/// Replaces each plane's values where `coverage` is 0 by a smooth continuation of the others
/// (push-pull, Gortler et al. 1996, section 3.4). `planes`: count x size.pixels(). With no
/// coverage at all the planes become 0.
void fillHidden(std::span<float> planes, std::span<const float> coverage, Size size);

}  // namespace illum
