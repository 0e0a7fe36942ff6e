// Which views an object may have.
#pragma once

#include "object/manifest.h"

namespace illum {

/// Of all groups of a manifest, beyond the limits of each number: geometries make sense
/// (view_record.h), names and places on a slab are used once, a photograph is alone. Throws Error
/// (Fault::Input) naming the field.
void checkViews(const Manifest& manifest);

}  // namespace illum
