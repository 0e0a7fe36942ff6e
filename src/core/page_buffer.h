// Large memory straight from the system.
#pragma once

#include <cstddef>
#include <utility>

namespace illum {

/// Zeroed bytes in pages of their own, returned to the system as a whole: what a heap would keep or
/// cut up counts against the limit of memory. Huge pages where the system has them, because writing
/// hundreds of megabytes for the first time takes as long in page faults as a good part of
/// decoding.
class PageBuffer {
 public:
  PageBuffer() = default;
  /// Throws Error (Fault::Machine) if the system has no more.
  explicit PageBuffer(std::size_t bytes);
  ~PageBuffer();
  PageBuffer(PageBuffer&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}
  PageBuffer& operator=(PageBuffer&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }

  std::byte* data() const { return data_; }
  std::size_t bytes() const { return bytes_; }

 private:
  std::byte* data_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace illum
