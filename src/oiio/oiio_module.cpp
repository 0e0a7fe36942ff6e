#include "oiio/oiio_module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "illum/error.h"

namespace illum {

LoadedOiioModule loadOiioModule(const char* file) {
  void* library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return {nullptr, fmt::format("cannot be loaded: {}", dlerror())};
  void* entry = dlsym(library, "illumOiioModule");
  if (entry == nullptr) return {nullptr, fmt::format("is something else: {}", dlerror())};
  const OiioModule* functions = reinterpret_cast<const OiioModule* (*)()>(entry)();
  if (functions->build == std::string_view(ILLUM_OIIO_BUILD)) return {functions, {}};
  return {nullptr, fmt::format("does not belong to this program: expected build {}, found {}",
                               ILLUM_OIIO_BUILD, functions->build)};
}

const OiioModule& oiioModule(const std::string& picture, std::string_view kind) {
  static const LoadedOiioModule loaded = loadOiioModule("illum_oiio.so");
  if (loaded.functions != nullptr) return *loaded.functions;
  throw Error(Fault::Machine, fmt::format("{}: {} pictures are read by illum_oiio.so, which {}",
                                          picture, kind, loaded.fault));
}

}  // namespace illum
