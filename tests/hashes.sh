#!/bin/sh
# tests/hashes.sh FOLDER: builds the world with several compilers and options, lets each compute the
# hash of every scene (tests/physics/determinism_test.cpp) and compares them. `make hashes`.
# g++ 12 fuses multiplications and additions where it vectorises straight-line code, even with
# -ffp-contract=off: for processors that can, it has to be told not to.
# CLANG: another name of clang++. Status 1: two builds differ.
set -eu
folder=$1
make=${MAKE:-make}
gcc=${CXX:-g++}
clang=${CLANG:-clang++}
mkdir -p "$folder"

# NAME COMPILER OPTIONS
compute() {
  out="$folder/$1"
  "$make" --no-print-directory OUT="$out" CXX="$2" WARN=-w CXXFLAGS="$3" "$out/seam-hashes" >"$folder/$1.log" 2>&1 ||
    { echo "$1: does not build, see $folder/$1.log" >&2; exit 1; }
  rm -f "$folder/$1.txt"
  # It compares what it has just written: a failure is one of the program's.
  SEAM_GOLDEN=write SEAM_GOLDEN_FILE="$folder/$1.txt" "$out/seam-hashes" --gtest_brief=1 \
    --gtest_filter='Determinism.EveryBuild*' >>"$folder/$1.log" 2>&1 ||
    { echo "$1: fails, see $folder/$1.log" >&2; exit 1; }
}

status=0
compute g++-O2 "$gcc" -O2
for variant in "g++-O0|$gcc|-O0" "g++-v3|$gcc|-O2 -march=x86-64-v3" "clang++-O2|$clang|-O2" \
  "clang++-v3|$clang|-O2 -march=x86-64-v3"; do
  name=${variant%%|*}
  rest=${variant#*|}
  compute "$name" "${rest%%|*}" "${rest#*|}"
  if diff "$folder/g++-O2.txt" "$folder/$name.txt" >"$folder/$name.diff"; then
    echo "$name: $(grep -c toml "$folder/$name.txt") hashes as g++ -O2"
  else
    echo "$name: differs in $(grep -c '^>' "$folder/$name.diff") scenes, see $folder/$name.diff"
    status=1
  fi
done
if diff "$folder/g++-O2.txt" tests/physics/golden_hashes.txt >"$folder/golden.diff"; then
  echo "golden_hashes.txt: the same"
else
  echo "golden_hashes.txt: differs in $(grep -c '^>' "$folder/golden.diff") scenes, see $folder/golden.diff"
  status=1
fi
exit $status
