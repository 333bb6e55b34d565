#!/usr/bin/env bash
# make fleet-demo: three servers with one room between them, an etcd that says which of them has it,
# and players who know the directory alone. The server that has the room is killed in the middle
# (SIGKILL), the next one is drained (SIGTERM), and the third plays on. Recorded by the stock
# lcm-logger, then drawn. Usage: fleet_demo.sh OUTPUT_DIR
# Environment: SEAM_BIN (folder of the programs), IMPAIR (network profile, default demo), SEED (1),
# PLAY (seconds between the events, 6).
set -euo pipefail

out=${1:?usage: fleet_demo.sh OUTPUT_DIR}
bin=${SEAM_BIN:-build/release}
play=${PLAY:-6}
names="ann bob"

# A network of our own, on which the bus is multicast: nobody else hears of it.
if [ -z "${SEAM_IN_NAMESPACE:-}" ]; then
  exec env SEAM_IN_NAMESPACE=1 unshare -rn sh -c \
    'ip link set lo up; ip route add 224.0.0.0/4 dev lo; exec "$@"' sh bash "$0" "$@"
fi

rm -rf "$out" && mkdir -p "$out"
out=$(cd "$out" && pwd)
export LCM_DEFAULT_URL="udpm://239.255.76.67:7667?ttl=0"
declare -A pid
trap 'kill "${pid[@]}" 2>/dev/null || true' EXIT INT TERM
begin=$(date +%s%N)
clock() { awk -v b="$begin" -v n="$(date +%s%N)" 'BEGIN { printf "%.2f", (n - b) / 1e9 }'; }
say() { printf '%6s s  %s\n' "$(clock)" "$*" | tee -a "$out/story.txt"; }
# wait_for SECONDS WORDS COMMAND...
wait_for() {
  local i tries=$(($1 * 50)) words=$2
  shift 2
  for ((i = 0; i < tries; ++i)); do
    "$@" >/dev/null 2>&1 && return
    sleep 0.02
  done
  echo "fleet-demo: $words; see $out/*.log" >&2
  exit 1
}

etcd=http://127.0.0.1:2379 peer=http://127.0.0.1:2380
/usr/bin/etcd --data-dir "$out/etcd" --listen-client-urls $etcd --advertise-client-urls $etcd \
  --listen-peer-urls $peer --initial-advertise-peer-urls $peer --initial-cluster default=$peer \
  --logger zap --log-level error >"$out/etcd.log" 2>&1 &
pid[etcd]=$!
lcm-logger --quiet "$out/fleet.lcm" >"$out/logger.log" 2>&1 &
pid[logger]=$!
directory=etcd:127.0.0.1:2379

# server ID ARGUMENTS...
server() {
  local id=$1
  shift
  : >"$out/server-$id.log"
  "$bin/seam-server" "$@" --id "$id" --directory $directory --drain-to fleet --bind "127.0.0.1" \
    --port "78$id" --duration 0 --impair "${IMPAIR:-demo}" >>"$out/server-$id.log" 2>&1 &
  pid[$id]=$!
}
wait_for 30 "etcd does not start" bash -c "exec 3<>/dev/tcp/127.0.0.1/2379"
server 01 rally --state "$out/rooms" --seed "${SEED:-1}" --wait 0
wait_for 30 "the first server does not hold the room" grep -q "Ctrl-C ends it" "$out/server-01.log"
server 02 --resume "$out/rooms"
server 03 --resume "$out/rooms"
say "server 01 has the room, 02 and 03 stand by; etcd is the directory"

for name in $names; do
  "$bin/seam-client" --directory $directory --name "$name" --drive bot --join-timeout 30 --quiet \
    >"$out/$name.log" 2>&1 &
  pid[$name]=$!
done
# here ID: all players are at this server.
here() {
  local name
  for name in $names; do grep -q ": $name is here as " "$out/server-$1.log" || return 1; done
}
# next_holder: waits until all players are at a server that is still there, and says which.
next_holder() {
  local id
  for id in "${!standing[@]}"; do
    if here "$id"; then
      holder=$id
      unset "standing[$id]"
      return
    fi
  done
  return 1
}
declare -A standing=([01]=1 [02]=1 [03]=1)
wait_for 30 "the players do not come" next_holder
say "$names play at server $holder"
sleep "$play"
say "kill -9 of server $holder"
kill -9 "${pid[$holder]}"
wait_for 30 "nobody takes the room over" next_holder
say "$names play on at server $holder: the lease of the dead one had to end, 5 s"
sleep "$play"
say "SIGTERM of server $holder: it hands the room over"
kill -TERM "${pid[$holder]}"
wait_for 30 "nobody is given the room" next_holder
say "$names play on at server $holder"
sleep "$play"
for name in $names; do kill -INT "${pid[$name]}"; done
for name in $names; do wait "${pid[$name]}" || { echo "fleet-demo: $name failed" >&2; exit 1; }; done
kill -INT "${pid[$holder]}"
wait "${pid[$holder]}" || true
sleep 0.3
kill -INT "${pid[logger]}"

# The players' own screens: where they saw the bodies, session by session.
for session in 1 2 3; do
  for name in $names; do
    "$bin/seam-export" "$out/fleet.lcm" --session $session --csv --view "$name" --force \
      -o "$out/$name-$session.csv" 2>>"$out/export.log"
  done
done
# The tick at which each of the later servers goes on, s.
goes_on() {
  "$bin/seam-log" list "$out/fleet.lcm" | sed -nE "s/^main +$1 .*ticks ([0-9]+)\.\..*/\1/p" |
    awk '{ print $1 / 60 }'
}
second=$(goes_on 2) third=$(goes_on 3)
gnuplot 2>"$out/gnuplot.log" <<PLOT
set terminal pngcairo size 1280,720 font "DejaVu Sans,11"
set output "$out/fleet.png"
set datafile separator ","
set title "Rally on three servers: the first is killed, the second drained. What each player saw"
set xlabel "time of the room, s"
set ylabel "x, m"
set key outside bottom center horizontal
set grid
set arrow from $second, graph 0 to $second, graph 1 nohead lw 2 dt 2 lc rgb "#b00020"
set arrow from $third, graph 0 to $third, graph 1 nohead lw 2 dt 2 lc rgb "#404040"
set label "killed: the next one goes on from here" at $second, graph 0.97 offset 0.5,0 tc rgb "#b00020"
set label "drained" at $third, graph 0.97 offset 0.5,0 tc rgb "#404040"
# A body on a player's screen, while the session's server was there (0) or afterwards (1).
until(session) = session == 1 ? $second : session == 2 ? $third : 1e9
seen(body, player, session, after) = sprintf( \
  "< awk -F, '\$4 == \"%s\" && (\$2 <= %g) != %d' $out/%s-%d.csv", \
  body, until(session), after, player, session)
once(s, after, text) = s == 1 && after == 0 ? text : ""
plot for [p=0:1] for [s=1:3] seen("ball", "ann", s, p) using 2:5 with lines lw 2 dt 1+2*p lc rgb "#1f77b4" title once(s, p, "ball, ann's screen"), \
     for [p=0:1] for [s=1:3] seen("ball", "bob", s, p) using 2:5 with lines lw 1 dt 1+2*p lc rgb "#ff7f0e" title once(s, p, "ball, bob's screen"), \
     for [p=0:1] for [s=1:3] seen("bat-a", "ann", s, p) using 2:5 with lines lw 2 dt 1+2*p lc rgb "#2ca02c" title once(s, p, "ann's bat, her screen"), \
     for [p=0:1] for [s=1:3] seen("bat-b", "bob", s, p) using 2:5 with lines lw 2 dt 1+2*p lc rgb "#9467bd" title once(s, p, "bob's bat, his screen"), \
     NaN with lines dt 3 lc rgb "#404040" title "without a server: undone when the next one goes on"
PLOT
"$bin/seam-render" --page "$out/fleet.lcm" "$out/fleet.lcm" "$out/fleet.lcm" --session 1 --session 2 \
  --session 3 -o "$out/fleet.html" --force 2>>"$out/render.log"
say "drawn: $out/fleet.png, and a page to look through: $out/fleet.html"
