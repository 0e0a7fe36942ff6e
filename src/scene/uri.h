// Names of files as glTF writes them (RFC 3986).
#pragma once

#include <string>

namespace illum {

/// "a%20b" as "a b".
std::string unescaped(const std::string& text);

/// Whether it names something in the folder that it is relative to, or in a folder below: no
/// address of elsewhere, no "..", that leads out of it.
bool staysBelow(const std::string& uri);

}  // namespace illum
