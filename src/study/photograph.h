// The photographs of a capture, made again from its samples: what relit pictures are held against.
#pragma once

#include <span>
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

/// View `view` of the capture cut into rows of its whole width, from the top: no step crosses a
/// multiple of the capture's bandRows() or of `tileRows` (> 0), so that each needs one band of the
/// capture and one row of the object's tiles; none is larger than makes a read worthwhile, and of a
/// rendered capture than lets the samples of all lights be held. Readers finish a step for all
/// lights before the next, since a sequential capture decodes all its photographs side by side.
std::vector<Rectangle> stepsDown(const Capture& capture, int view, int tileRows);

/// The whole width of `rows` of view `view` under light `light` (indices). A photograph is sample
/// times light intensity, in linear light. For display-referred captures the bytes are those of the
/// photograph's own file. `coverage` (1 channel, the view's size, or empty) multiplies the
/// linear values. Throws what Capture::read throws.
PhotographBand readPhotograph(const Capture& capture, int view, int light, const Rectangle& rows,
                              const BytePicture& coverage);

/// The same of what capture.read() gave for that light, which is asked for nothing.
PhotographBand photographOf(std::span<const float> samples, const Capture& capture, int light,
                            const Rectangle& rows, const BytePicture& coverage);

/// The mask of view `view` as 8-bit coverage; empty if the capture has none. Reads the view from
/// top to bottom.
BytePicture coverageOf(const Capture& capture, int view);

}  // namespace illum
