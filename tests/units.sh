#!/bin/sh
# OUT=build/release MAINS='server/main.cpp ...' tests/units.sh < SOURCES: writes the units that `make` compiles,
# $OUT/unity/FOLDER.cpp of a folder's sources and $OUT/unity/FOLDER-tests.cpp of its tests. A unit that would
# not change keeps its time, so that adding a file compiles one folder.
set -eu
awk -v out="$OUT/unity" -v mains=" $MAINS " '
  index(mains, " " $0 " ") { next }
  { unit = $0; sub(/\/[^\/]*$/, "", unit); if (/_test\.cpp$/) unit = unit "-tests"
    text[unit] = text[unit] "#include \"" $0 "\"\n" }
  END { for (unit in text) {
    file = out "/" unit ".cpp"; folder = file; sub(/\/[^\/]*$/, "", folder)
    old = ""; while ((getline line < file) > 0) old = old line "\n"; close(file)
    if (old == text[unit]) continue
    system("mkdir -p " folder); printf "%s", text[unit] > file; close(file) } }'
