// docs/conventions.md, "Pictures".
#include "expect.h"
#include "illum/picture.h"

using illum::BytePicture;
using illum::Picture;
using illum::Rectangle;

namespace {

void samplesInMemory() {
  Picture picture({640, 480}, 3);
  picture.at(/*x=*/2, /*y=*/1, /*channel=*/0) = 0.5F;
  expect(picture.samples()[(1 * 640 + 2) * 3 + 0] == 0.5F, "channels fastest, then x, then y");
  expect(picture.row(0).data() == picture.samples().data(), "row 0 is the top one");
}

void rectangles() {
  const Rectangle rectangle{10, 20, 30, 40};
  int columns = 0;
  for (int x = rectangle.x; x < rectangle.right(); ++x) ++columns;
  expect(columns == rectangle.width, "ranges are half-open");
}

void alpha() {
  // Half covered by a surface of linear value 0.8: the product is what is kept.
  Picture linear({1, 1}, 4);
  for (int c = 0; c < 3; ++c) linear.at(0, 0, c) = 0.5F * 0.8F;
  linear.at(0, 0, 3) = 0.5F;
  const BytePicture shown = displayBytes(linear);
  expect(shown.at(0, 0, 0) == 231, "PNG holds the surface's own colour, encoded");
  expect(shown.at(0, 0, 3) == 128, "and its coverage, not encoded");
}

}  // namespace

int main() {
  samplesInMemory();
  rectangles();
  alpha();
}
