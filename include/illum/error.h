// The one error path: the library throws Error and never prints or exits.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace illum {

/// Whose fault an error is. The command line maps it to its exit code.
enum class Fault {
  Input = 1,    ///< a file or value that was given is wrong
  Usage = 2,    ///< the request itself makes no sense
  Machine = 3,  ///< disk, memory, permissions
};

/// One sentence for the user. what() names the file or field, what was expected and what was found.
class Error : public std::runtime_error {
 public:
  Error(Fault fault, const std::string& sentence) : std::runtime_error(sentence), fault_(fault) {}
  Fault fault() const { return fault_; }

 private:
  Fault fault_;
};

/// "FILE: expected EXPECTED, found FOUND", as a Fault::Input.
Error inputError(const std::filesystem::path& file, std::string_view expected,
                 std::string_view found);

/// "FILE: cannot ACTION: REASON" from errno, as a Fault::Machine. What is wrong with the
/// name itself (nothing there, a folder, a file taken for a folder, too long) is Fault::Input.
Error fileError(const std::filesystem::path& file, std::string_view action, int errnoValue);

}  // namespace illum
