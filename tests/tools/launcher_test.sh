#!/usr/bin/env bash
# The launcher in a folder of its own with stand-ins for cmake, ctest and the package tools, which write down how they were called: nothing is
# installed, compiled or fetched. Every case states its fact.
set -uo pipefail

launcher=$(dirname "$(readlink -f "$0")")/../../nanson
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
tree="$work/a tree"
tools=$work/tools
called=$work/called
failures=0

tool() { { echo '#!/bin/bash'; cat; } > "$tools/$1" && chmod +x "$tools/$1"; }

fresh_tree() {
  rm -rf "$tree" "$tools"
  mkdir -p "$tree"/{cmake,kernels,engine,io,tests,bench} "$tools" "$work/elsewhere"
  cp "$launcher" "$(dirname "$launcher")/packages.txt" "$tree"
  touch -d '1 minute ago' "$tree"/{CMakeLists.txt,CMakePresets.json,io/main.cpp} "$tree"/{cmake,kernels,engine,io,tests,bench}
  tool cmake << STUB
echo "cmake \$*" >> "$called"
if [[ \$1 == -S ]]; then mkdir -p "\$2/build/release"; exit; fi
[[ -z \${BREAK_BUILD:-} ]] || { echo "engine/broken.cpp:1: error"; exit 7; }
sleep "\${BUILD_SECONDS:-0}"
printf '[%3d%%] Building CXX\n' 1 7 45 60 100
for program in nanson nanson_bench; do
  printf '%s\n' '#!/bin/bash' "echo \$program in \"\\\$PWD\" got \"\\\$*\"" '[[ \$1 != unknown ]] || exit 42' '[[ \$1 != waiting ]] || echo \${OMP_WAIT_POLICY:-none} \${GOMP_SPINCOUNT:-none}' > "\$2/\$program"
  chmod +x "\$2/\$program"
done
STUB
  tool ctest <<< "echo \"ctest \$*\" >> '$called'; exit 8"
  tool dpkg-query <<< 'printf "installed %s\n" "${@:3}"'
  tool apt-get <<< "echo \"apt-get \$*\" >> '$called'"
  tool sudo <<< 'exit 1'
}

# Starts the launcher where the test stands; leaves output, messages, code and the calls of the stand-ins.
launch() {
  : > "$called"
  output=$(PATH="$tools:$PATH" "$tree/nanson" "$@" 2> "$work/messages")
  code=$?
  messages=$(< "$work/messages")
  calls=$(< "$called")
}

launched_with() {  # [NAME=VALUE...]: how threads of the program wait; the launcher that runs this test has set its own choice
  env -u OMP_WAIT_POLICY -u GOMP_SPINCOUNT PATH="$tools:$PATH" "$@" "$tree/nanson" waiting
}

check() {  # FACT VALUE PATTERN
  # shellcheck disable=SC2053
  [[ $2 == $3 ]] && return
  failures=$((failures + 1))
  printf 'FAILED: %s\n  expected: %s\n  found: %s\n' "$1" "$3" "$2"
}

cd "$work" || exit 1
mkdir -p elsewhere && cd elsewhere || exit 1

fresh_tree
launch run scene.toml --set a.b=1
check "the first call configures with tests" "$calls" "*cmake -S $tree --preset release -DBUILD_TESTING=ON*"
check "run builds the program only" "$calls" "*--target nanson --parallel*"
check "and tells how far it is" "$messages" "*building nanson: 45 %*building nanson: 100 %"
check "once in twenty per cent" "$(grep -c ' %$' <<< "$messages")" 3
check "the log has every line" "$(grep -c '^\[' "$tree/build/build.log")" 5
check "the program starts where the user stands, with all arguments" "$output" "nanson in $work/elsewhere got run scene.toml --set a.b=1"
check "nothing is installed when nothing is missing" "$calls" "cmake*"

fresh_tree
launch --help
check "help names the verbs, the launcher's own too" "$output" "*$tree/nanson run SCENE*$tree/nanson test *$tree/nanson bench *"
check "and needs no build" "$calls" ""
launch run scene.toml

launch check scene.toml
check "a second call builds nothing" "$calls" ""
check "and says nothing of its own" "$messages" ""

launch unknown
check "the exit code is that of the program" "$code" 42

check "threads spin for a short time, then sleep" "$(launched_with)" "*passive 1000"
check "unless the user says how they wait" "$(launched_with OMP_WAIT_POLICY=active)" "*active none"

ln -s "$tree/nanson" "$work/link"
output=$(PATH="$tools:$PATH" "$work/link" --version)
check "a link to the launcher works" "$output" "nanson in $work/elsewhere got --version"

touch "$tree/engine/new.hpp"
launch run scene.toml
check "a new source is built" "$calls" "cmake --build*"
check "without configuring again" "$calls" "*--target nanson *"
launch run scene.toml
check "once" "$calls" ""

echo "another processor" > "$tree/build/release/machine.stamp"
touch "$tree/build/release/old.o"
launch run scene.toml
check "another processor: configured anew" "$calls" "cmake -S*"
check "in an emptied folder" "$(find "$tree/build/release" -name old.o)" ""
CXX=true launch run scene.toml
check "another CXX: configured anew" "$calls" "cmake -S*"

touch -d '2 seconds' "$tree/io/main.cpp"
BREAK_BUILD=1 launch run scene.toml
check "a failed build is exit 1" "$code" 1
check "the end of its log is shown" "$messages" "*engine/broken.cpp:1: error*"
check "and the old program is not started" "$output" ""

launch test -R Dual
check "test builds all" "$calls" "*--target all *"
check "and hands its arguments to ctest, for which no tests are an error" "$calls" "*ctest --test-dir $tree/build/release*--no-tests=error*-R Dual"
check "whose exit code it returns" "$code" 8

launch bench --benchmark_filter=flux
check "bench builds the benchmarks" "$calls" "*--target nanson_bench *"
check "and starts them in the source folder" "$output" "nanson_bench in $tree got --benchmark_filter=flux"

fresh_tree
export BUILD_SECONDS=0.2
: > "$called"
for _ in 1 2 3; do PATH="$tools:$PATH" "$tree/nanson" run scene.toml > /dev/null 2>&1 & done
wait
unset BUILD_SECONDS
check "three calls at once build once" "$(grep -c -e --build "$called")" 1

fresh_tree
tool dpkg-query <<< 'echo installed libeigen3-dev; exit 1'
tool id <<< 'echo 1000'
launch run scene.toml
check "packages are missing and no root: exit 2" "$code" 2
check "with the line to type" "$messages" "*apt-get install -y --no-install-recommends libmetis-dev libhdf5-dev *libbenchmark-dev"
check "and nothing was started" "$calls" ""

tool id <<< 'echo 0'
tool apt-get <<< "echo \"apt-get \$*\" >> '$called'; [[ \"\$*\" == *update* ]] && touch '$work/updated'; [[ -e '$work/updated' ]]"
launch run scene.toml
check "as root they are installed, after an update" "$calls" "*apt-get *update*apt-get *install -y --no-install-recommends libmetis-dev*cmake -S*"
check "which is said" "$messages" "nanson: installing libmetis-dev *"
check "and the program is started" "$output" "nanson in * got run scene.toml"

[[ $failures == 0 ]] && echo "the launcher keeps its promises"
exit $((failures > 0))
