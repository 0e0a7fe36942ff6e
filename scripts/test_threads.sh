#!/usr/bin/env bash
# The unit tests under the thread sanitizer: scripts/test_threads.sh [MODULE…]
#
# Not a part of scripts/test.sh, for it takes as long as all of it. Debian's oneTBB is not
# instrumented, so that what it puts in order would look like races; its source package is compiled
# here with the sanitizer first. Without arguments: the modules that use threads.
set -euo pipefail
cd "$(dirname "$0")/.."

modules=("$@")
[ "${#modules[@]}" -gt 0 ] ||
  modules=(core oiio capture fit encode relight normals lumigraph build convert study render)
tbb=$PWD/build/instrumented-tbb
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=true
CMAKE_BUILD_PARALLEL_LEVEL=$(nproc)
export CMAKE_BUILD_PARALLEL_LEVEL

scripts/setup.sh test

if [ ! -e "$tbb/install/lib/cmake/TBB/TBBConfig.cmake" ]; then
  echo "threads: building Debian's oneTBB with the thread sanitizer"
  mkdir -p "$tbb/source"
  # The machine's own archives, as sources, with lists of their own so that the machine's stay as
  # they are.
  parts=$tbb/source/parts
  mkdir -p "$parts"
  [ ! -s /etc/apt/sources.list ] || sed -n 's/^deb /deb-src /p' /etc/apt/sources.list >"$parts/one.list"
  for file in /etc/apt/sources.list.d/debian*.sources; do
    [ ! -e "$file" ] || sed 's/^Types:.*/Types: deb-src/' "$file" >"$parts/$(basename "$file")"
  done
  apt=(-qq -o "Dir::Etc::SourceList=/dev/null" -o "Dir::Etc::SourceParts=$parts"
    -o "Dir::State::Lists=$tbb/source/lists" -o "Dir::Cache=$tbb/source/cache")
  mkdir -p "$tbb/source/lists/partial" "$tbb/source/cache/archives/partial"
  (
    cd "$tbb/source"
    apt-get "${apt[@]}" update
    apt-get "${apt[@]}" source --download-only onetbb
    tar -xf onetbb_*.orig.tar.* --one-top-level=onetbb --strip-components=1
  )
  cmake -S "$tbb/source/onetbb" -B "$tbb/build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DCMAKE_CXX_COMPILER=clang++-16 -DTBB_SANITIZE=thread \
    -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF -DCMAKE_INSTALL_LIBDIR=lib \
    -DCMAKE_INSTALL_PREFIX="$tbb/install" >"$tbb/configure.log"
  cmake --build "$tbb/build" --target install >"$tbb/build.log"
fi

cmake --preset threads -DILLUM_TESTS=ON -DTBB_DIR="$tbb/install/lib/cmake/TBB" >"$tbb/illum.log"
targets=()
for module in "${modules[@]}"; do targets+=("illum_${module}_test"); done
cmake --build --preset threads --target "${targets[@]}"

# The test that counts allocations replaces operator new, which the sanitizer does itself.
export GTEST_FILTER="-*AllocatesNothing"
export TSAN_OPTIONS="ignore_noninstrumented_modules=1 suppressions=$PWD/tests/tsan.supp exitcode=66"
status=0
for module in "${modules[@]}"; do
  echo "threads: $module"
  GTEST_BRIEF=1 "build/threads/src/$module/illum_${module}_test" || status=1
done
exit "$status"
