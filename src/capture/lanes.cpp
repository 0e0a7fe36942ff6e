#include "capture/lanes.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>

namespace illum {

int availableThreads() {
  return std::max(1, tbb::this_task_arena::max_concurrency());
}

void forEachInLanes(std::size_t count, int lanes, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::exception_ptr fault;
  std::size_t faultAt = count;
  const auto lane = [&](int) {
    while (true) {
      const std::size_t i = next++;
      if (i >= count) return;
      try {
        work(i);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (i < faultAt) fault = std::current_exception();
        faultAt = std::min(faultAt, i);
        next = count;
      }
    }
  };
  tbb::parallel_for(0, std::max(lanes, 1), lane, tbb::simple_partitioner());
  if (fault) std::rethrow_exception(fault);
}

}  // namespace illum
