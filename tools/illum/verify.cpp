#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <string>

#include "commands.h"
#include "illum/object.h"

namespace illum::cli {

void addVerify(CLI::App& program, int& exitCode) {
  auto* command = program.add_subcommand("verify", "check every byte of an object");
  const auto object = std::make_shared<std::string>();
  command->add_option("OBJECT", *object, ".illum file or folder")->required();
  command->callback([object, &exitCode] {
    const auto faults = verifyObject(*object);
    for (const auto& fault : faults) fmt::print(stderr, "illum: {}\n", fault);
    if (faults.empty()) fmt::print("{}: sound\n", *object);
    exitCode = faults.empty() ? kDone : kFault;
  });
}

}  // namespace illum::cli
