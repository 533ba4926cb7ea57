# To be sourced by run: the service over the network.
# shellcheck shell=bash

# How the server is reached and who may use it: everything the two sides are told.
server_access=(--listen 0.0.0.0:50051 --insecure-listen)
client_options=(-e ROLLGAIT_SERVER=rollgaitd:50051)
server_mounts=()

# start_server NAME VOLUME
start_server() {
  run_in "$1" -v "$2:/var/lib/rollgait" "${server_mounts[@]}" --health-interval disable "$image" \
    rollgaitd --data-dir /var/lib/rollgait "${server_access[@]}" --metrics-listen 0.0.0.0:9464 --solver-slots 2
}
healthy() { pod exec "$1" rollgait --server unix:/var/lib/rollgait/admin.sock --timeout 4 health; }
health_says() { pod healthcheck run "$1"; }
metric_at_least() {  # NAME METRIC VALUE
  local value
  value=$(curl -sf "http://$(pod inspect --format "{{(index .NetworkSettings.Networks \"$network\").IPAddress}}" "$1"):9464/metrics" |
    awk -v metric="$2" '$1 == metric {print $2}')
  awk -v value="${value:-none}" -v least="$3" 'BEGIN {exit !(value != "none" && value + 0 >= least)}' || { echo "$2 is '$value'"; return 1; }
}
logs_are_json() {
  local lines
  lines=$(pod logs "$1" 2>&1 | grep -v '^rollgaitd listening on ')
  [ -n "$lines" ] && ! grep -v '^{"ts":"[^"]*","level":"[a-z]*","program":"rollgait[a-z-]*","event":".*}$' <<< "$lines"
}

# The value of the first field of this name in the result of a finished solve's .json file.
result_field() { sed -n '/^ *"result": /,$p' "$work/out/$1.json" | sed -n "s/^ *\"$2\": \"\{0,1\}\([^\",]*\).*/\1/p;T;q"; }
# Events on standard output of `rollgait --json`: numbers 1, 2, 3 ... and a terminal event last.
dense() {
  awk -F'"' '/^{"sequence":/ { if (/"heartbeat":/) next; if ($4 + 0 != last + 1) { print "after " last " comes " $4; bad = 1 } last = $4 + 0; final = /"finished":/ }
    END { if (!last || !final) { print "ends at " last " without a terminal event"; bad = 1 } exit bad }' "$work/out/$1"
}
iterations_seen() { [ "$(grep -c '"iteration":' "$work/out/$1" 2> /dev/null)" -ge "$2" ]; }
long_solve=(--model human29 --speed 1.3 --slope 0)

check_service() {
  check "the server starts with a read-only root" start_server rollgaitd data
  check "it becomes healthy" until_true 60 healthy rollgaitd
  check "the image's own health check says so" health_says rollgaitd
  check "the client finds it by name" client server-info
  for slope in -10 0 10; do
    check "a gait at $slope degrees is optimal" client -q solve --model planar --slope "$slope" --speed 1.3 --output "/out/slope_$slope.json"
    check "  and its result says so" equal "$(result_field "slope_$slope" termination)" TERMINATION_OPTIMAL
  done
  check "a request that cannot be met is refused by field" refused_by_field
  check "the events of a finished solve are dense, to the terminal one" watch_again
  check "metrics count three solves" metric_at_least rollgaitd 'rollgait_solves_created_total{source="queue"}' 3
  check "every line of its log is a JSON event" logs_are_json rollgaitd
  check "the uninterrupted reference is solved" client -q solve "${long_solve[@]}" --output /out/reference.json
}
refused_by_field() {
  local output code=0
  output=$(client solve --model planar --slope 0 --speed 99 2>&1) || code=$?
  [ $code = 2 ] && grep -q 'speed' <<< "$output" || { echo "exit code $code: $output"; return 1; }
}
watch_again() {
  local name
  name=$(sed -n 's|^ *"name": *"\(solves/[^"]*\)".*|\1|p;T;q' "$work/out/slope_0.json")
  client --json watch "$name" > "$work/out/watched.jsonl" && dense watched.jsonl
}

kill_server() { pod kill -s KILL rollgaitd && pod wait rollgaitd; }
check_kill_and_reattach() {
  local name
  # The reference has answered this request: a server with a memory of its own solves it again.
  pod rm -f -t 0 rollgaitd > /dev/null
  check "a server on a new volume starts" start_server rollgaitd fresh
  check "it becomes healthy" until_true 60 healthy rollgaitd
  name=$(client solve "${long_solve[@]}" --detach | grep -o 'solves/[a-z0-9]*' | head -n 1)
  check "a long solve is running: $name" test -n "$name"
  client --json watch --reconnect 120 "$name" --output /out/interrupted.json > "$work/out/interrupted.jsonl" 2> "$logs/watch.log" &
  local watcher=$!
  check "its iterations arrive" until_true 120 iterations_seen interrupted.jsonl 5
  check "kill -9 of the server's container" kill_server
  local seen
  seen=$(sed -n 's/^{"sequence":"\([0-9]*\)".*/\1/p' "$work/out/interrupted.jsonl" | tail -n 1)
  check "the solve had not ended" sh -c "! grep -q '\"finished\":' $work/out/interrupted.jsonl"
  check "the container starts again on its volume" pod start rollgaitd
  check "it becomes healthy again" until_true 60 healthy rollgaitd
  check "the watcher re-attaches by itself and sees the end" wait $watcher
  check "it missed nothing and saw nothing twice" dense interrupted.jsonl
  check "the solve was run again" grep -q '"attempt":2' "$work/out/interrupted.jsonl"
  check "a second client takes up after number $seen" takes_up_after "$name" "$seen"
  for field in termination objective; do
    check "the result's $field is that of the uninterrupted run" equal "$(result_field interrupted $field)" "$(result_field reference $field)"
  done
}
takes_up_after() {
  client --json watch --after-sequence "$2" "$1" > "$work/out/after.jsonl"
  awk -F'"' -v expected="$(($2 + 1))" '{exit !($4 == expected)}' "$work/out/after.jsonl" || { head -n 1 "$work/out/after.jsonl"; return 1; }
}

stops_cleanly() {
  local begun=$SECONDS
  pod stop -t 40 "$1" && [ $((SECONDS - begun)) -le 30 ] || return 1
  equal "$(pod inspect --format '{{.State.ExitCode}}' "$1")" 0
}
check_stop() {
  check "SIGTERM ends the server with exit code 0 within 30 s" stops_cleanly rollgaitd
}
