// The subcommands, one file each. Every function adds its subcommand to the program; what the
// subcommand's callback returns is in `exitCode`.
#pragma once

#include <CLI/CLI.hpp>

namespace illum::cli {

inline constexpr int kDone = 0, kFault = 1, kStopped = 130;

void addBuild(CLI::App& program, int& exitCode);
void addCapture(CLI::App& program, int& exitCode);
void addConvert(CLI::App& program, int& exitCode);
void addRelight(CLI::App& program, int& exitCode);
void addEvaluate(CLI::App& program, int& exitCode);
void addNormals(CLI::App& program, int& exitCode);
void addInfo(CLI::App& program, int& exitCode);
void addVerify(CLI::App& program, int& exitCode);

}  // namespace illum::cli
