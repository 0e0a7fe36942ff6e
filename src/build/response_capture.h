// A capture's samples in the domain in which planes are fitted.
#pragma once

#include "illum/capture.h"
#include "illum/colour.h"

namespace illum {

/// Converts samples of `inner`, which must outlive it, to `transfer` where they are not that
/// already.
class ResponseCapture final : public Capture {
 public:
  ResponseCapture(const Capture& inner, Transfer transfer) : inner_(inner), transfer_(transfer) {}
  const std::vector<View>& views() const override { return inner_.views(); }
  Transfer transfer() const override { return transfer_; }
  const std::vector<LightFileEntry>& lights() const override { return inner_.lights(); }
  bool hasMask() const override { return inner_.hasMask(); }
  bool hasDepth() const override { return inner_.hasDepth(); }
  bool isRendered() const override { return inner_.isRendered(); }
  void read(int group, const Rectangle& rectangle, std::span<const int> lights,
            std::span<float> samples) const override {
    inner_.read(group, rectangle, lights, samples);
    if (transfer_ == inner_.transfer()) return;
    if (transfer_ == Transfer::Linear) {
      for (float& s : samples) s = linearFromDisplay(s);
    } else {
      for (float& s : samples) s = displayFromLinear(s);
    }
  }
  const ByteSamples* bytes() const override {
    return transfer_ == inner_.transfer() ? inner_.bytes() : nullptr;
  }
  void readMask(int group, const Rectangle& rectangle, std::span<float> coverage) const override {
    inner_.readMask(group, rectangle, coverage);
  }
  void readDepth(int group, const Rectangle& rectangle, std::span<float> depth) const override {
    inner_.readDepth(group, rectangle, depth);
  }
  int bandRows() const override { return inner_.bandRows(); }
  std::uint64_t residentBytes() const override { return inner_.residentBytes(); }
  std::string fingerprint() const override { return inner_.fingerprint(); }

 private:
  const Capture& inner_;
  Transfer transfer_;
};

}  // namespace illum
