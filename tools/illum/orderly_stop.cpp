#include "orderly_stop.h"

#include <csignal>

namespace illum::cli {
namespace {

volatile std::sig_atomic_t asked = 0;

// The second signal is the system's usual one.
void ask(int signal) {
  asked = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void stopOnSignals() {
  std::signal(SIGINT, ask);
  std::signal(SIGTERM, ask);
}

bool stopAsked() {
  return asked != 0;
}

}  // namespace illum::cli
