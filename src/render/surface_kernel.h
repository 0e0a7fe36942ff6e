// The formula of SurfaceBsdf for many lights, by vector instructions.
#pragma once

#include "render/direction_batch.h"
#include "render/surface_bsdf.h"

namespace illum {

/// The first `count` of the batch; entries behind it may be written.
void evaluateLobes(const SurfaceLobes& lobes, const DirectionBatch& toLight, std::size_t count,
                   BsdfBatch& out);

}  // namespace illum
