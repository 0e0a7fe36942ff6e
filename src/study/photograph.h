// The photographs of a capture, made again from its samples: what relit pictures are held against.
#pragma once

#include "illum/capture.h"
#include "illum/picture.h"

namespace illum {

/// Some rows of a photograph, whole width.
struct PhotographBand {
  Rectangle rows;
  Picture linear;     ///< RGB, unclamped; times the coverage, where one was given
  BytePicture bytes;  ///< the same on screen
};

/// How many rows to read at once: the step that the capture likes, or one of our own where it has
/// no preference. Readers go down the picture in these steps and finish one for all lights before
/// the next, since a sequential capture decodes all its photographs side by side.
int bandRowsOf(const Capture& capture);

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
