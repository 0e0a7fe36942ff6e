// An illum_oiio.so of another build.
#include "oiio/oiio_module.h"

extern "C" const illum::OiioModule* illumOiioModule() {
  static constexpr illum::OiioModule kModule{"0.0.9-other", nullptr, nullptr, nullptr};
  return &kModule;
}
