// Numbers as options take them.
#pragma once

#include <string>
#include <vector>

#include "illum/colour.h"
#include "illum/error.h"
#include "illum/vector.h"

namespace illum::cli {

/// The sentence for an option whose text is not as it should be.
Error wrongOption(const char* option, const char* form, const std::string& text);

/// The numbers of "1,2,3". Members throw Error (Fault::Usage), naming the option and the form that
/// it should have had.
class Numbers {
 public:
  Numbers(const char* option, const char* form, const std::string& text);

  std::size_t count() const { return values_.size(); }  ///< 0 if there is anything but numbers
  double operator[](std::size_t i) const { return values_[i]; }
  Error wrong() const { return wrongOption(option_, form_, text_); }
  Vector3 vector(std::size_t from) const;
  Direction direction(std::size_t from) const;
  /// The last three numbers, which may be missing: white then.
  LinearRgb colour(std::size_t from) const;

 private:
  const char *option_, *form_;
  std::string text_;
  std::vector<double> values_;
};

}  // namespace illum::cli
