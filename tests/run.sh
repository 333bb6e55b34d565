#!/usr/bin/env bash
# tests/run.sh BUILD_DIR [PROGRAM]: all tests, on every processor (JOBS=1: on one), and then, one
# after the other, those that go by the clock of the wall. What fails is printed, and done once more
# alone: what passes then is named, and has passed; it may have met another test, or a busy machine.
# Everything else is in BUILD_DIR/test-logs/. Last line: "N passed, N failed"; a program that ends
# without its summary counts as one failed, and so does one that is still at it after LIMIT (2h).
# Exit code 1 if anything failed.
set -uo pipefail
cd "$(dirname "$0")/.."
bin=$1
tests=$bin/${2:-seam-tests}
limit=${LIMIT:-2h}
jobs=${JOBS:-$(nproc)}
logs=$bin/test-logs
rm -rf "$logs" && mkdir -p "$logs" || exit 2
export SEAM_BIN=$bin

# Suites that go by the clock of the wall: a busy processor makes them late.
timed=$(sed -nE 's/^TEST(_F|_P)?\((\w+),.*/\2.*/p' tests/process/timed/*.cpp tests/net/net_udp_test.cpp \
  tests/record/slow/bus_test.cpp tests/render/slow/render_live_test.cpp | sort -u | paste -sd:)

pids=()
trap 'kill "${pids[@]}" 2>/dev/null; exit 130' INT TERM
for ((i = 0; i < jobs; ++i)); do
  GTEST_TOTAL_SHARDS=$jobs GTEST_SHARD_INDEX=$i \
    timeout "$limit" "$tests" --gtest_filter="-$timed" \
    > "$logs/part-$i.log" 2>&1 &
  pids+=($!)
done

count() {  # LOG PATTERN: the last number that the pattern finds, or 0
  local found
  found=$(sed -nE "s/^$2\$/\1/p" "$1" | tail -1)
  echo "${found:-0}"
}

finish() {  # LOG EXIT_CODE: counts, and prints what failed
  awk '/^\[ RUN      \]/ { text = "" } { text = text $0 "\n" }
       /^\[  FAILED  \].* ms\)$/ { printf "%s", text }' "$1"
  passed=$((passed + $(count "$1" '\[  PASSED  \] ([0-9]+) tests?\.')))
  failed=$((failed + $(count "$1" '\[  FAILED  \] ([0-9]+) tests?, listed below:')))
  skipped=$((skipped + $(count "$1" '\[  SKIPPED \] ([0-9]+) tests?, listed below:')))
  if ! grep -q '^\[  PASSED  \] ' "$1"; then
    echo "$1: ended with code $2, without a summary:"
    tail -40 "$1"
    failed=$((failed + 1))
  fi
}

passed=0 failed=0 skipped=0
for ((i = 0; i < jobs; ++i)); do
  wait "${pids[i]}"
  finish "$logs/part-$i.log" $?
done
# Not in the background, where a shell makes programs ignore SIGINT.
timeout --foreground "$limit" "$tests" --gtest_filter="$timed" > "$logs/timed.log" 2>&1
finish "$logs/timed.log" $?

names=$(sed -nE 's/^\[  FAILED  \] ([^ ,]+)(, where .*)?$/\1/p' "$logs"/*.log | sort -u)
again=$(printf '%s' "$names" | grep -c .)
if [ "$again" -gt 0 ] && [ "$again" = "$failed" ] && [ "$again" -le 3 ]; then
  failed=0
  timeout --foreground "$limit" "$tests" --gtest_filter="$(paste -sd: <<<"$names")" > "$logs/again.log" 2>&1
  finish "$logs/again.log" $?
  [ "$failed" = "$again" ] || echo "failed beside others, done again alone: $(tr '\n' ' ' <<<"$names")"
fi

sed -nE 's/^\[  (     OK|FAILED) +\] (\S+) \(([0-9]+) ms\)$/\3 ms: \2/p' "$logs"/*.log | sort -rn | head -5
[ "$skipped" = 0 ] ||
  echo "$skipped skipped:$(sed -nE 's/^\[  SKIPPED \] (\S+)$/ \1/p' "$logs"/*.log | sort -u | tr -d '\n')"
echo "$passed passed, $failed failed"
[ "$failed" = 0 ]
