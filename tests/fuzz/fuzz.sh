#!/bin/sh
# tests/fuzz/fuzz.sh PROGRAM FOLDER SECONDS [TARGET...]: fuzzes each target for so long, in FOLDER/TARGET; goes on with
# what is there. A finding is a file FOLDER/TARGET.crash-...; status 1 if there is one. With SEAM_FUZZ_HOLE=1 each target
# must find its hole: status 1 if one does not.
set -eu
program=$1 folder=$2 seconds=$3
shift 3
[ $# -gt 0 ] || set -- message packed session scene script log snapshot
status=0
for target; do
  mkdir -p "$folder/$target"
  "$program" seeds "$target" "$folder/$target"
  kept=$(dirname "$0")/kept/$target
  [ ! -d "$kept" ] || cp "$kept"/* "$folder/$target"
  found=0
  SEAM_FUZZ=$target "$program" -max_total_time="$seconds" -timeout=25 -rss_limit_mb=4096 -print_final_stats=1 \
    -artifact_prefix="$folder/$target." "$folder/$target" >"$folder/$target.log" 2>&1 || found=1
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$folder/$target.log")
  covered=$(grep -o 'cov: [0-9]*' "$folder/$target.log" | tail -n 1)
  if [ "${SEAM_FUZZ_HOLE:-}" = 1 ]; then
    if grep -q 'the hole was found' "$folder/$target.log"; then
      echo "$target: its hole was found; ${covered:-cov: 0}"
    else
      echo "$target: its hole was NOT found in $seconds s, ${runs:-?} runs; ${covered:-cov: 0}"
      status=1
    fi
  elif [ "$found" = 0 ]; then
    echo "$target: nothing found in $seconds s, ${runs:-?} runs; ${covered:-cov: 0}"
  else
    echo "$target: FOUND something, see $folder/$target.log and $folder/$target.crash-*"
    status=1
  fi
done
exit "$status"
