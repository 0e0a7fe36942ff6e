// The photographs of a capture, made again from its samples: what relit pictures are held against.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "illum/capture.h"
#include "illum/picture.h"

namespace illum {

/// Some rows of a photograph, whole width.
struct PhotographBand {
  Rectangle rows;
  Picture linear;     ///< RGB, unclamped; times the coverage, where one was given
  BytePicture bytes;  ///< the same on screen
};

/// Goes down the photograph under light `light` (an index), band by band in the steps the capture
/// likes. A photograph is sample times light intensity, in linear light. For display-referred
/// captures the bytes are those of the photograph's own file. `coverage` (1 channel, the capture's
/// size, or empty) multiplies the linear values. Throws what Capture::read throws.
void readPhotograph(const Capture& capture, int light, const BytePicture& coverage,
                    const std::function<void(const PhotographBand&)>& use);

/// The capture's mask as 8-bit coverage; empty if it has none.
BytePicture coverageOf(const Capture& capture);

/// Bytes that readPhotograph holds while it runs, beside what the capture holds.
std::uint64_t photographBandBytes(const Capture& capture);

}  // namespace illum
