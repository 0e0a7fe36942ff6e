// Work on many photographs at once, but never on more than memory has room for.
#pragma once

#include <cstddef>
#include <functional>

namespace illum {

/// Threads that the calling task may use.
int availableThreads();

/// Calls `work(i)` for every i below `count`, at most `lanes` at a time, in order of their
/// beginning. After a fault no further ones begin, and the fault of the lowest i is thrown: which
/// one that is does not depend on threads.
void forEachInLanes(std::size_t count, int lanes, const std::function<void(std::size_t)>& work);

}  // namespace illum
