#!/bin/sh
# tests/hashes.sh FOLDER: builds what steps a world with several compilers and options, lets each
# compute the hash of every scene (tests/physics/determinism_test.cpp) and compares them. `make hashes`.
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
build() {
  mkdir -p "$folder/$1"
  "$make" --no-print-directory OUT="$folder/$1" CXX="$2" WARN=-w CXXFLAGS="$3" \
    "$folder/$1/seam-hashes" >"$folder/$1.log" 2>&1 ||
    { echo "$1: does not build, see $folder/$1.log" >&2; exit 1; }
}

# NAME: leaves $folder/NAME.txt if all went well. It compares what it has just written: a failure is
# one of the program's.
compute() {
  rm -f "$folder/$1.txt"
  SEAM_GOLDEN=write SEAM_GOLDEN_FILE="$folder/$1.part" "$folder/$1/seam-hashes" --gtest_brief=1 \
    --gtest_filter='Determinism.EveryBuild*' >>"$folder/$1.log" 2>&1 &&
    mv "$folder/$1.part" "$folder/$1.txt"
}

# Each computes while the next is built.
names=
for variant in "g++-O2|$gcc|-O2" "g++-O0|$gcc|-O0" "g++-v3|$gcc|-O2 -march=x86-64-v3" \
  "clang++-O2|$clang|-O2" "clang++-O0|$clang|-O0" "clang++-v3|$clang|-O2 -march=x86-64-v3"; do
  name=${variant%%|*}
  rest=${variant#*|}
  build "$name" "${rest%%|*}" "${rest#*|}"
  compute "$name" &
  names="$names $name"
done
wait

status=0
for name in $names; do
  [ -f "$folder/$name.txt" ] || { echo "$name: fails, see $folder/$name.log" >&2; exit 1; }
  if diff tests/physics/golden_hashes.txt "$folder/$name.txt" >"$folder/$name.diff"; then
    echo "$name: $(grep -c toml "$folder/$name.txt") hashes as golden_hashes.txt"
  else
    echo "$name: differs in $(grep -c '^>' "$folder/$name.diff") scenes, see $folder/$name.diff"
    status=1
  fi
done
exit $status
