// What a light must be before it shines.
#pragma once

#include "illum/lighting.h"

namespace illum {

/// Throws Error (Fault::Input) naming the field for numbers out of range (light/lighting_fields.h)
/// and for fields that contradict each other.
void checkLight(const Light& light);

}  // namespace illum
