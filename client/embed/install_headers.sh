#!/bin/sh
# client/embed/install_headers.sh INCLUDE: installs the headers of client/embed/seam2d/ as INCLUDE/seam2d/, and those
# that they include as INCLUDE/seam2d/detail/, so that no other name is taken. Includes are changed to these places.
set -eu
to=$1/seam2d
install -d "$to"
put() {  # FILE AS
  install -d "$(dirname "$to/$2")"
  sed -E 's@^(#include )"client/embed/(seam2d/[^"]*)"@\1"\2"@; s@^(#include )"((common|server|client)/[^"]*)"@\1"seam2d/detail/\2"@' \
    "$1" > "$to/$2"
  chmod 644 "$to/$2"
}
for header in client/embed/seam2d/*.h; do put "$header" "${header##*/}"; done
# CXX may be several words.
needed=$(${CXX:-g++} -std=c++17 -I. -isystem "${EIGEN:-/usr/include/eigen3}" -MM client/embed/seam2d/*.h)
echo "$needed" | tr -s ' \\' '\n' |
  grep -E '^(common|server|client)/.*\.h$' | grep -v '^client/embed/seam2d/' | sort -u |
  while read -r header; do put "$header" "detail/$header"; done
