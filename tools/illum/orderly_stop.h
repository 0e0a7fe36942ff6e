// Ctrl-C and SIGTERM ask long work to stop in good order; a second one stops it at once.
#pragma once

namespace illum::cli {

void stopOnSignals();
/// Whether a signal came since.
bool stopAsked();

}  // namespace illum::cli
