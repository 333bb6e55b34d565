#!/usr/bin/env bash
# make demo: real processes over loopback UDP and the LCM bus, one session per scene and method,
# captured by the stock lcm-logger, then drawn and measured. Usage: demo.sh OUTPUT_DIR
# Then one session of each of the large worlds and of the players' scenes, over 4g.
# Environment: SEAM_BIN (folder of the programs),
# IMPAIR (network profile of the first part, default demo), SEED, SCENES and WORLDS (which scenes; "": none).
set -euo pipefail

out=${1:?usage: demo.sh OUTPUT_DIR}
bin=${SEAM_BIN:-build/release}
impair=${IMPAIR:-demo}
seed=${SEED:-1}
scenes=${SCENES-crossing wall stack cradle}
worlds=
all="titanic skyline regatta harbour ragdolls obstacle crane gluehouse conveyor playground"
all="$all headon rally seesaw scrum heap train gas"
for world in ${WORLDS-$all}; do
  [ ! -f "scenes/$world.toml" ] || worlds="$worlds $world"
done
runs="oracle central strict snap interleave fade retrospect rollback"

# The LCM bus is multicast: a network namespace of our own has it without root, without the
# network, and without disturbing other users of the bus.
if [ -z "${SEAM_IN_NAMESPACE:-}" ]; then
  if unshare -rn true 2>/dev/null; then
    exec env SEAM_IN_NAMESPACE=1 unshare -rn sh -c \
      'ip link set lo up; ip route add 224.0.0.0/4 dev lo; exec "$@"' sh bash "$0" "$@"
  fi
  echo "demo: no network namespace allowed here; using this machine's own multicast route" >&2
fi

mkdir -p "$out"
rm -rf "$out"/*.lcm "$out"/*.png "$out"/*.html "$out"/*.csv "$out"/*.log "$out"/frames
pids=()
cleanup() { for p in "${pids[@]:-}"; do kill "$p" 2>/dev/null || true; done; }
trap cleanup EXIT INT TERM
began=$SECONDS

# players SCENE: their names, as [[player]] sections give them.
players() {
  if [ "$1" = swarm ]; then
    echo p-0 p-1 p-2 p-3 # of 256
    return
  fi
  awk '/^\[/ { player = /^\[\[player\]\]/ }
       player && /^name *=/ { split($0, quoted, "\""); print quoted[2] }' "scenes/$1.toml"
}

# run_session SCENE RUN INDEX IMPAIR: starts logger, server and all players; returns at once.
run_session() {
  local scene=$1 run=$2 index=$3 impair=$4 log="$out/$1-$2" mode=buffer reconcile="" url
  local port=$((17000 + index)) publish="--publish all"
  [ "$scene" != swarm ] || publish="--publish own" # its thousand crates are in the server's view
  url="udpm://239.255.76.67:$((18000 + index))?ttl=0"
  case $run in
    oracle|strict|central) mode=$run ;;
    world) reconcile="--reconcile rollback" ;;
    *) reconcile="--reconcile $run" ;;
  esac
  lcm-logger --quiet --lcm-url="$url" "$log.lcm" >"$log-logger.log" 2>&1 &
  local logger=$!
  pids+=("$logger")
  (
    sleep 0.3
    # shellcheck disable=SC2086
    "$bin/seam-server" "scenes/$scene.toml" --port "$port" --bind 127.0.0.1 --mode "$mode" \
      $reconcile --impair "$impair" --seed "$seed" --lcm-url "$url" --quiet \
      --wait "$(players "$scene" | wc -w)" --duration "$(sed -n 's/^duration *= *\([0-9.]*\).*/\1/p' "scenes/$scene.toml")" \
      >"$log-server.log" 2>&1 &
    server=$!
    clients=()
    for name in $(players "$scene"); do
      "$bin/seam-client" "127.0.0.1:$port" --name "$name" --drive "$name" --lcm-url "$url" \
        $publish --duration 90 --quiet >"$log-$name.log" 2>&1 &
      clients+=($!)
    done
    status=0
    wait "$server" || status=$?
    for c in "${clients[@]}"; do wait "$c" || status=$?; done
    sleep 0.2
    kill -INT "$logger" 2>/dev/null || true
    exit "$status"
  ) &
  sessions+=("$!:$scene/$run")
  pids+=("$!")
}

# wait_sessions: for all of `sessions`; names those that failed.
wait_sessions() {
  local s name
  for s in "${sessions[@]}"; do
    if ! wait "${s%%:*}"; then
      name=${s#*:}
      printf '\ndemo: session %s failed; see %s/%s-*.log\n' "$name" "$out" "${name/\//-}" >&2
      failed=1
    fi
  done
  sleep 0.3
  printf ' done at %d s\n' $((SECONDS - began))
}

# Two scenes at a time: fourteen sessions sleep most of the time.
index=0
failed=0
set -- $scenes
while [ $# -gt 0 ]; do
  batch="$1 ${2:-}"
  shift
  [ $# -eq 0 ] || shift
  sessions=()
  for scene in $batch; do
    for run in $runs; do
      run_session "$scene" "$run" "$index" "$impair"
      index=$((index + 1))
    done
  done
  printf 'demo: %-16s %d sessions of logger + server + 2 clients, network %s ...' \
    "$batch" "${#sessions[@]}" "$impair"
  wait_sessions
done

# Large worlds: three at a time, and one method, because their servers do not sleep.
set -- $worlds
while [ $# -gt 0 ]; do
  batch="$1 ${2:-} ${3:-}"
  shift $(($# < 3 ? $# : 3))
  sessions=()
  for scene in $batch; do
    run_session "$scene" world "$index" 4g
    index=$((index + 1))
  done
  printf 'demo: %-28s %d worlds with all their players, network 4g ...' "$batch" "${#sessions[@]}"
  wait_sessions
done

# Four players of a scene without fixed regions: what each has authority over moves with it.
sessions=()
run_session swarm world "$index" "$impair"
printf 'demo: %-28s a room for 256 with four of its players, network %s ...' swarm "$impair"
wait_sessions
[ "$failed" = 0 ] || exit 1

csv="$out/results.csv"
for scene in $scenes; do
  logs=()
  for run in $runs; do logs+=("$out/$scene-$run.lcm"); done
  # Each by the oracle that its method is judged by: docs/metrics.md.
  "$bin/seam-measure" --floor --csv "$csv" --append --names "${runs// /,}" "${logs[@]}"
done

echo "demo: drawing"
size=${SIZE:-960x540}
"$bin/seam-render" --force "$out/swarm-world.lcm" -o "$out/regions.png" --sheet 4 --from 1.5 --to 6 \
  --view server --size 1280x720
for scene in $scenes; do
  for run in $runs; do
    "$bin/seam-render" --force "$out/$scene-$run.lcm" -o "$out/frames/$scene-$run" --fps 15 --size "$size"
    "$bin/seam-render" --force --strobe "$out/$scene-$run.lcm" -o "$out/$scene-$run-strobe.png"
  done
  "$bin/seam-render" --force --compare "$out/$scene"-{strict,interleave,retrospect,rollback}.lcm \
    -o "$out/frames/$scene-compare" --fps 15 --size 1280x720
done
if [ -f "$out/crossing-oracle.lcm" ]; then
  "$bin/seam-render" --force --strobe --compare \
    "$out"/crossing-{oracle,strict,interleave,retrospect,rollback}.lcm \
    --oracle "$out/crossing-oracle.lcm" -o "$out/summary.png"
fi

# The oracle of a large world is computed from the log; where that takes long, it goes unmeasured.
for scene in $worlds; do
  log=$out/$scene-world.lcm
  if ! timeout 20 "$bin/seam-measure" --more --csv "$out/worlds.csv" --append --names rollback \
    "$log" >"$out/$scene-world.txt"; then
    echo "demo: $scene is not measured (no oracle within 20 s)" >&2
    continue
  fi
  awk -v OFS="  " -v scene="$scene" '
    NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i }
    NR == 2 { error = $column["path_error_rms_m"]; stutter = $column["stutter_shown_mps2"] }
    /^  seam / { seam = $2 }
    /bodies lost/ { lost = $(NF - 5) }
    END { printf "  %-11s error of others %9s m, stutter %8s m/s2, seam %9s m RMS", scene, error,
          stutter, seam
          print (lost == "" ? "" : ", bodies lost or too many " lost) }' "$out/$scene-world.txt"
  middle=$(awk '/^duration *=/ { print $3 / 2 }' "scenes/$scene.toml")
  # One moment, so what moves just then says little of the scene.
  timeout 40 "$bin/seam-render" --force "$log" -o "$out/frames/$scene-world" --view all --fps 1 \
    --camera scene --from "$middle" --to "$middle" >/dev/null 2>&1 || continue
  mv "$out/frames/$scene-world"/*.png "$out/$scene-world.png"
  timeout 40 "$bin/seam-render" --force --strobe "$log" -o "$out/$scene-world-strobe.png" >/dev/null 2>&1 ||
    echo "demo: no strobe of $scene" >&2
done
if [ -f "$out/crossing-rollback.lcm" ]; then
  "$bin/seam-render" --force --page "$out"/crossing-{rollback,interleave,strict}.lcm -o "$out/review.html"
  entrance="  look here file://$(cd "$out" && pwd)/review.html"
fi
echo "demo: $((SECONDS - began)) s in all"
echo "${entrance:-}"
echo "  tables    $csv and $out/worlds.csv"
echo "  summary   $out/summary.png"
echo "  strobes   $out/SCENE-RUN-strobe.png"
echo "  worlds    $out/SCENE-world.png, -strobe.png and .txt"
echo "  frames    $out/frames/SCENE-RUN/ and $out/frames/SCENE-compare/"
echo "  captures  $out/SCENE-RUN.lcm (as lcm-logger wrote them)"
