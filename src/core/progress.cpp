#include "illum/progress.h"

namespace illum {

void Progress::begin(std::string_view, std::uint64_t) {}
void Progress::advance(std::uint64_t) {}
void Progress::end() {}
void Progress::remark(std::string_view) {}

}  // namespace illum
