#!/usr/bin/env bash
# make report: sweeps over the simulated network and over solver settings, renderings, and the page
# of it all. Usage: report.sh OUTPUT_DIR [quick]. Interrupted, the same command goes on where it was.
# Environment: SEAM_BIN (folder of the programs), JOBS (default: one a core), FORCE (not empty: all
# tables anew), FILL (pages of the docs into which the tables are put).
set -euo pipefail

out=${1:?usage: report.sh OUTPUT_DIR [quick]}
bin=${SEAM_BIN:-build/release}
grid=report
beside=()   # scenes for the step cost: seam-lab's own choice
data=$out/data
sweeps=tests/lab/sweeps
if [ "${2:-}" = quick ]; then
  grid=quick
  beside=(scenes/wall.toml scenes/stack.toml scenes/crossing.toml scenes/cradle.toml --repeats 2)
  data=$out/data-quick
  sweeps=$sweeps/quick
fi
jobs=()
[ -z "${JOBS:-}" ] || jobs=(--jobs "$JOBS")
[ -z "${FORCE:-}" ] || rm -f "$data"/*.csv
mkdir -p "$data/around" "$out/renders"
# What the steps take goes into the report. Going on after an interruption, a step that is done
# takes nothing and keeps the time it took.
times=$data/times.csv
[ -e "$times" ] || echo step,seconds >"$times"
last= begun=0
step() {
  local took=$((SECONDS - begun))
  if [ -n "$last" ] && { [ "$took" -gt 0 ] || ! grep -q "^$last," "$times"; }; then
    echo "$last,$took" >>"$times"
  fi
  last=$* begun=$SECONDS
  printf 'report: %4d s  %s\n' "$SECONDS" "$*"
}
# Medians of what was there before, measured with the present measure.
cp tests/lab/sweeps/before.csv "$data/before.csv"

# Runs that fail leave no row and are named on stderr; the others are reported.
failed=0
try() {
  local status=0
  "$@" || status=$?
  [ "$status" -lt 2 ] || exit "$status"
  [ "$status" = 0 ] || failed=1
}

step "step cost beside raw Box2D"
try "$bin/seam-lab" overhead "${beside[@]}" -o "$data/overhead.csv"
step "features of a scene beside their baselines"
quick=()
[ "${2:-}" != quick ] || quick=(--quick)
try "$bin/seam-lab" world "${quick[@]}" -o "$data/world" >/dev/null
for file in "$sweeps"/*.toml; do
  name=$(basename "$file" .toml)
  step "sweep $file"
  try "$bin/seam-lab" sweep "$file" -o "$data/$name.csv" "${jobs[@]}"
done
step "fairness"
fairness=()
[ "${2:-}" != quick ] || fairness=(--seeds 2)
try "$bin/seam-lab" fairness "${fairness[@]}" -o "$data/fairness.csv" "${jobs[@]}"
step "what the titles say"
titles=(--impair 4g --impair demo)
[ "${2:-}" != quick ] || titles=(--seeds 2)
try "$bin/seam-lab" titles "${titles[@]}" -o "$data/titles.csv" "${jobs[@]}"
step "hard cases"
try "$bin/seam-lab" physics --grid "$grid" -o "$data/physics.csv" "${jobs[@]}" >"$data/physics.txt"

# One run of each method, drawn in step. The commands go beside the pictures, into the page.
impair=delay=100ms,loss=1%,jitter=10ms
for scene in crossing wall cradle stack; do
  step "drawing $scene"
  strobe="$bin/seam-render --force --strobe --compare" frames="$bin/seam-render --force --compare"
  commands= logs=() names=()
  for method in oracle strict central fade rollback; do
    case $method in
      oracle | strict | central) how="--mode $method" ;;
      *) how="--reconcile $method" ;;
    esac
    log=$out/renders/$scene-$method.lcm
    run="seam-lab run scenes/$scene.toml $how --impair $impair --seed 1 -o $log"
    # shellcheck disable=SC2086
    "$bin/"$run --force >/dev/null
    commands+="$run"$'\n'
    strobe+=" $log"
    [ "$method" = oracle ] && continue
    frames+=" $log" logs+=("$log") names+=(--names "$method")
  done
  strobe+=" --oracle $out/renders/$scene-oracle.lcm"
  frames+=" --oracle $out/renders/$scene-oracle.lcm --fps 3 --size 960x540"
  event=contact
  [ "$scene" != stack ] || event=180  # the shove, which is no impact of 3 m/s
  "$bin/seam-measure" "${logs[@]}" "${names[@]}" --around "$event" \
    --around-csv "$data/around/$scene.csv" --force >/dev/null
  # shellcheck disable=SC2086
  $strobe -o "$out/renders/$scene-strobe.png" >/dev/null
  # shellcheck disable=SC2086
  $frames -o "$out/renders/$scene-frames" >/dev/null
  printf '%s%s -o %s\n' "$commands" "${strobe#"$bin/"}" "$out/renders/$scene-strobe.png" \
    >"$out/renders/$scene-strobe.txt"
  printf '%s%s -o %s\n' "$commands" "${frames#"$bin/"}" "$out/renders/$scene-frames" \
    >"$out/renders/$scene-frames.txt"
done

step "the page"
try "$bin/seam-lab" report "$data" -o "$out" --sweeps "$sweeps"
for page in ${FILL:-}; do  # pages of the docs with places for tables
  try "$bin/seam-lab" report "$data" -o "$out" --sweeps "$sweeps" --markdown "$page"
done
step "done: open $out/index.html"
exit "$failed"
