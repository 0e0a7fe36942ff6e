// The photographs of a capture, made again from its samples: what relit pictures are held against.
#pragma once

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

/// The picture cut into rows of its whole width, from the top: no step crosses a multiple of the
/// capture's bandRows() or of `tileRows` (> 0), so that each needs one band of the capture and one
/// row of the object's tiles; none is larger than makes a read worthwhile. Readers finish a step
/// for all lights before the next, since a sequential capture decodes all its photographs side by
/// side.
std::vector<Rectangle> stepsDown(const Capture& capture, int tileRows);

/// The whole width of `rows` under light `light` (an index). A photograph is sample times light
/// intensity, in linear light. For display-referred captures the bytes are those of the
/// photograph's own file. `coverage` (1 channel, the capture's size, or empty) multiplies the
/// linear values. Throws what Capture::read throws.
PhotographBand readPhotograph(const Capture& capture, int light, const Rectangle& rows,
                              const BytePicture& coverage);

/// The capture's mask as 8-bit coverage; empty if it has none. Reads the capture from top to
/// bottom.
BytePicture coverageOf(const Capture& capture);

}  // namespace illum
