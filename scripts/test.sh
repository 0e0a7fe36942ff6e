#!/usr/bin/env bash
# Everything that CI checks, from a fresh Debian 12 on. Stops at the first stage that fails; the
# last lines are the runners' own summaries and their sum.
#
#   FUZZ_SECONDS=30    for each fuzzer
#   ILLUM_SHARED=DIR   the shared test data (default ../shared); without it those tests are skipped,
#                      with CI=true they fail
set -euo pipefail
cd "$(dirname "$0")/.."

fuzz_seconds=${FUZZ_SECONDS:-30}
jobs=$(nproc)
results=$PWD/out/test
# The same objects serve every checkout on the machine.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=true
export CMAKE_BUILD_PARALLEL_LEVEL=$jobs CTEST_OUTPUT_ON_FAILURE=1 PYTHONDONTWRITEBYTECODE=1
[ "${CI:-}" = true ] && export ILLUM_REQUIRE_SHARED=1

passed=0 failed=0 skipped=0
summaries=()
stage_name=""

stage() {
  stage_name=$1
  printf '\n==== %s (%s s since the start)\n' "$stage_name" "$SECONDS"
}

# The last word, whether all stages were reached or not.
finish() {
  local status=$?
  printf '\n==== Summaries\n'
  [ "${#summaries[@]}" -eq 0 ] || printf '%s\n' "${summaries[@]}"
  if [ "$status" -ne 0 ]; then
    printf 'stage "%s" failed after %s s\n' "$stage_name" "$SECONDS"
    [ "$failed" -gt 0 ] || failed=1
  fi
  printf '%s passed, %s failed, %s skipped\n' "$passed" "$failed" "$skipped"
  exit "$status"
}
trap finish EXIT

count() { # PASSED FAILED SKIPPED
  passed=$((passed + ${1:-0})) failed=$((failed + ${2:-0})) skipped=$((skipped + ${3:-0}))
}

# The sum of an attribute over a JUnit file's suites.
junit() { # FILE ATTRIBUTE
  tr '\n\t' '  ' <"$1" | grep -o '<testsuite [^>]*' | grep -o " $2=\"[0-9]*\"" |
    tr -dc '0-9\n' | awk '{ sum += $1 } END { print sum + 0 }'
}

count_junit() { # FILE
  local bad=$(($(junit "$1" failures) + $(junit "$1" errors)))
  local idle=$(($(junit "$1" skipped) + $(junit "$1" disabled)))
  count $(($(junit "$1" tests) - bad - idle)) "$bad" "$idle"
}

# One test program with a share of its tests. What it says is shown where it fails.
run_shard() { # OUTPUT SHARD PROGRAM
  local out=$1/$(basename "$3").$2
  GTEST_TOTAL_SHARDS=$jobs GTEST_SHARD_INDEX=$2 GTEST_OUTPUT=xml:$out.xml GTEST_BRIEF=1 \
    "$3" >"$out.log" 2>&1 || { cat "$out.log"; echo "$3, shard $2: failed"; return 1; }
}
export -f run_shard
export jobs

# All test programs of a build, each once a core: a process for every test, as ctest has it, takes
# longer to start than to test.
run_gtests() { # NAME BUILD
  local status=0 out=$results/$1
  mkdir -p "$out"
  find "$2/src" -name 'illum_*_test' -type f | sort | while read -r program; do
    for shard in $(seq 0 $((jobs - 1))); do echo "$shard $program"; done
  done | xargs -P "$jobs" -L 1 bash -c 'run_shard "$0" "$@"' "$out" || status=1
  cat "$out"/*.xml >"$out.xml" || status=1
  count_junit "$out.xml"
  summaries+=("$1: $(junit "$out.xml" tests) tests, $(junit "$out.xml" failures) failed")
  return "$status"
}

run_ctest() { # NAME BUILD [OPTIONS]
  local status=0
  ctest --test-dir "$2" "${@:3}" -j "$jobs" --output-junit "$results/$1.xml" 2>&1 | tee "$results/$1.log" ||
    status=$?
  [ ! -f "$results/$1.xml" ] || count_junit "$results/$1.xml"
  summaries+=("$1: $(grep 'tests passed' "$results/$1.log" || echo 'ctest ended early')")
  return "$status"
}

run_pytest() { # NAME ARGUMENTS…
  local name=$1 status=0
  shift
  /usr/bin/python3 -m pytest -q --junitxml "$results/$name.xml" "$@" 2>&1 |
    tee "$results/$name.log" || status=$?
  [ ! -f "$results/$name.xml" ] || count_junit "$results/$name.xml"
  summaries+=("$name: $(tail -n 1 "$results/$name.log")")
  return "$status"
}

# One fuzzer; the build made its first corpus beside it.
run_fuzzer() { # OUTPUT SECONDS PROGRAM
  local name corpus
  name=$(basename "$3")
  corpus=$(dirname "$3")/corpus/$name
  mkdir -p "$1/$name"
  local folders=("$1/$name")
  [ ! -d "$corpus" ] || folders+=("$corpus")
  "$3" -max_total_time="$2" -timeout=20 -rss_limit_mb=1500 -print_final_stats=1 \
    -artifact_prefix="$1/$name-" "${folders[@]}" >"$1/$name.log" 2>&1 || touch "$1/$name.failed"
}
export -f run_fuzzer

# All of them, one on each core.
run_fuzzers() { # FOLDER
  local status=0 name
  find "$1" -maxdepth 1 -name '*_fuzz' -type f | sort |
    xargs -P "$jobs" -L 1 bash -c 'run_fuzzer "$0" "$@"' "$results" "$fuzz_seconds"
  for program in "$1"/*_fuzz; do
    name=$(basename "$program")
    if [ -f "$results/$name.failed" ] || ! grep -q 'Done ' "$results/$name.log"; then
      count 0 1 0
      tail -n 40 "$results/$name.log"
      summaries+=("$name: found a fault, see $results/$name.log")
      status=1
    else
      count 1 0 0
      summaries+=("$name: $(grep -o 'Done .*' "$results/$name.log" | tail -n 1)")
    fi
  done
  return "$status"
}

stage "Set-up"
scripts/setup.sh test
rm -rf "$results"
mkdir -p "$results"

stage "Formatting"
git ls-files '*.h' '*.cpp' | xargs clang-format --dry-run -Werror

stage "Release build"
cmake --preset release -DILLUM_TESTS=ON >"$results/configure.log"
cmake --build --preset release

stage "Unit tests"
run_gtests unit build/release
run_ctest documents build/release -R '^(docs|format)\.'

stage "Command line"
run_pytest cli -n "$jobs" tests/cli

stage "Installation and a program built against it"
run_pytest install tests/install

stage "illum_read alone"
cmake --preset read -DILLUM_TESTS=ON >"$results/configure-read.log"
cmake --build --preset read
run_gtests read build/read
run_ctest read-documents build/read -R '^(docs|format)\.'

stage "Browser"
(cd tests/browser && npm ci --no-audit --no-fund --loglevel=error)
browser_status=0
node --test tests/browser/tiles.test.mjs 2>&1 | tee "$results/browser.log" || browser_status=$?
browser_count() { sed -n "s/^[^a-z]* *$1 \([0-9]*\)$/\1/p" "$results/browser.log" | tail -n 1; }
count "$(browser_count pass)" "$(browser_count fail)" "$(browser_count skipped)"
summaries+=("browser: $(browser_count pass) pass, $(browser_count fail) fail")
[ "$browser_status" -eq 0 ]

stage "Sanitizers"
cmake --preset sanitize -DILLUM_TESTS=ON -DILLUM_WARNINGS_AS_ERRORS=ON \
  >"$results/configure-sanitize.log"
cmake --build --preset sanitize
export ASAN_OPTIONS=exitcode=99 UBSAN_OPTIONS=exitcode=99:print_stacktrace=1
export LSAN_OPTIONS=suppressions=$PWD/tests/lsan.supp:print_suppressions=0
run_gtests sanitized-unit build/sanitize
run_ctest sanitized-documents build/sanitize -R '^(docs|format)\.'
ILLUM_BIN=$PWD/build/sanitize/tools/illum/illum run_pytest sanitized-cli \
  -n "$jobs" tests/cli/test_hostile_photographs.py tests/cli/test_hostile_objects.py

stage "Fuzzers, $fuzz_seconds s each"
run_fuzzers build/sanitize/tests/fuzz

stage "Done"
