// The only symbol of illum_oiio.so.
#include "capture/oiio_reader.h"
#include "oiio/oiio_module.h"
#include "scene/oiio_texture.h"

extern "C" const illum::OiioModule* illumOiioModule() {
  static constexpr illum::OiioModule kModule{ILLUM_OIIO_BUILD, illum::readOiioHeader,
                                             illum::openOiioReader, illum::readOiioTexture};
  return &kModule;
}
