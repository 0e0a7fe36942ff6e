#include "core/page_buffer.h"

#include <sys/mman.h>

#include "core/memory.h"
#include "illum/error.h"

namespace illum {

PageBuffer::PageBuffer(std::size_t bytes) : bytes_(bytes) {
  if (bytes == 0) return;
  void* pages = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (pages == MAP_FAILED) {
    throw Error(Fault::Machine, "memory: cannot have another " + textFromBytes(bytes));
  }
  madvise(pages, bytes, MADV_HUGEPAGE);
  data_ = static_cast<std::byte*>(pages);
}

PageBuffer::~PageBuffer() {
  if (data_ != nullptr) munmap(data_, bytes_);
}

}  // namespace illum
