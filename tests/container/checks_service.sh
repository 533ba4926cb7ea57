# To be sourced by run: the service over the network.
# shellcheck shell=bash

# How the server is reached and who may use it: without a door (checks_kubernetes has it), TLS with a certificate authority of this run, and tokens.
server_access=(--listen 0.0.0.0:50051 --without-door --tls-cert /run/secrets/tls.crt --tls-key /run/secrets/tls.key --require-token)

# make_certificate NAME ALTERNATIVE-NAME: NAME.crt and NAME.key, signed by ca.crt.
make_certificate() {
  (
    cd "$tls"
    openssl req -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -keyout "$1.key" -subj "/CN=$1" -out "$1.csr"
    openssl x509 -req -in "$1.csr" -CA ca.crt -CAkey ca.key -CAcreateserial -days 2 -out "$1.crt" -extfile <(echo "subjectAltName=$2")
  )
}
make_secrets() {
  mkdir -p "$tls"
  openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -keyout "$tls/ca.key" -out "$tls/ca.crt" -days 2 \
    -subj /CN=test-ca 2>&1
  make_certificate tls DNS:rollgaitd,DNS:rollgaitd-pod-0 2>&1
  # As orchestrators hand secrets over: readable by the container's user alone.
  chmod 0600 "$tls/tls.key"
  chown 10001:10001 "$tls/tls.key"
}
# A token for the clients, made in the server's container.
prepare_clients() {
  pod exec rollgaitd rollgaitd token create --data-dir /var/lib/rollgait "$@" --tenant test --scopes read,solve > "$work/token" 2> "$logs/token.log" ||
    { cat "$logs/token.log"; return 1; }
  chmod 0644 "$work/token"
}

# start_server NAME VOLUME
start_server() {
  run_in "$1" -v "$2:/var/lib/rollgait" "${server_mounts[@]}" "$image" \
    rollgaitd --data-dir /var/lib/rollgait "${server_access[@]}" --metrics-listen 0.0.0.0:9464 --solver-slots 2
}
healthy() { pod exec "$1" rollgait --server unix:/var/lib/rollgait/admin.sock --timeout 4 health; }
# The command that the image declares as its health check, run in the container.
health_says() {
  local -a command
  mapfile -t command < <(pod inspect --format '{{range .HealthCheck.Test}}{{println .}}{{end}}' "$image" | grep .)
  pod exec "$1" "${command[@]:1}"
}
metric_at_least() {  # NAME METRIC VALUE
  local value
  value=$(curl -sf "http://$(address_of "$1"):9464/metrics" |
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
# The image that is compiled has both solvers; scripts/test builds the other alone.
names_v3() { sed -n 's/^ *"solverBuild": //p' "$work/out/$1.json" | grep -q x86-64-v3 || { grep solverBuild "$work/out/$1.json"; return 1; }; }
# Events on standard output of `rollgait --json`: numbers 1, 2, 3 ..., and last the finished solve.
dense() {
  awk -F'"' '/^{"sequence":/ { if (/"heartbeat":/) next; if ($4 + 0 != last + 1) { print "after " last " comes " $4; bad = 1 } last = $4 + 0; final = 0 }
    /^{"name":.*"state":"SOLVE_STATE_SUCCEEDED"/ { final = 1 }
    END { if (!last || !final) { print "ends at " last " without a terminal event"; bad = 1 } exit bad }' "$work/out/$1"
}
iterations_seen() { [ "$(grep -c '"iteration":' "$work/out/$1" 2> /dev/null)" -ge "$2" ]; }
long_solve=(--model human29 --speed 1.3 --slope 0)

anonymous() {
  pod run --rm "${limits[@]}" "${unattended[@]}" --network "$network" "${hosts[@]}" "${confined[@]}" "${client_options[@]}" "$image" \
    rollgait --timeout 5 "$@"
}
# The client is refused: exit code not 0, and its message has the word.
refused_with() {
  local word=$1 output code=0
  shift
  output=$("$@" 2>&1) || code=$?
  [ $code != 0 ] && grep -q "$word" <<< "$output" || { echo "exit code $code: $output"; return 1; }
}

no_token_in_logs() { ! pod logs rollgaitd 2>&1 | grep -F "$(cat "$work/token")"; }

check_service() {
  tls=$work/tls
  server_mounts=(-v "$tls/tls.crt:/run/secrets/tls.crt:ro" -v "$tls/tls.key:/run/secrets/tls.key:ro")
  client_options=(-e ROLLGAIT_SERVER=rollgaitd:50051 -v "$tls/ca.crt:/run/secrets/ca.crt:ro" -v "$work/token:/run/secrets/token:ro")
  check "certificates of this run" make_secrets
  check "the server starts with a read-only root" start_server rollgaitd data
  check "it becomes healthy" until_true 60 healthy rollgaitd
  check "the image's own health check says so" health_says rollgaitd
  check "a token is made in its container" prepare_clients
  check "the client finds it by name, over TLS with a token" client server-info
  check "without a token it is refused" refused_with UNAUTHENTICATED anonymous --tls-ca /run/secrets/ca.crt list
  check "without the authority's certificate it is refused" refused_with certificate anonymous --token-file /run/secrets/token list
  check "in plain text it is refused" refused_with UNAVAILABLE anonymous --insecure list
  for slope in -10 0 10; do
    check "a gait at $slope degrees is optimal" client -q solve --model planar --slope "$slope" --speed 1.3 --output "/out/slope_$slope.json"
    check "  and its result says so" equal "$(result_field "slope_$slope" termination)" TERMINATION_OPTIMAL
  done
  if [ "$programs" = compile ] && grep -qw avx2 /proc/cpuinfo && grep -qw bmi2 /proc/cpuinfo && grep -qw fma /proc/cpuinfo; then
    check "it comes from the solver for x86-64-v3" names_v3 slope_0
  fi
  check "a request that cannot be met is refused by field" refused_by_field
  check "the events of a finished solve are dense, to the terminal one" watch_again
  check "metrics count three solves" metric_at_least rollgaitd 'rollgait_solves_created_total{source="queue"}' 3
  check "every line of its log is a JSON event" logs_are_json rollgaitd
  check "no log holds the token" no_token_in_logs
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
  know  # nobody: this server is to be started again
  check "a server on a new volume starts" start_server rollgaitd fresh
  check "it becomes healthy" until_true 60 healthy rollgaitd
  check "a token is made in its container" prepare_clients
  name=$(client solve "${long_solve[@]}" --detach | grep -o 'solves/[a-z0-9]*' | head -n 1 || true)
  check "a long solve is running: $name" test -n "$name"
  in_background long client --json watch --reconnect 120 "$name" --output /out/interrupted.json \
    > "$work/out/interrupted.jsonl" 2> "$logs/watch.log"
  check "its iterations arrive" until_true 120 iterations_seen interrupted.jsonl 5
  check "kill -9 of the server's container" kill_server
  local seen
  seen=$(sed -n 's/^{"sequence":"\([0-9]*\)".*/\1/p' "$work/out/interrupted.jsonl" | tail -n 1)
  check "the solve had not ended" sh -c "! grep -q '^{\"name\":' $work/out/interrupted.jsonl"
  check "the container starts again on its volume" pod start rollgaitd
  check "it becomes healthy again" until_true 60 healthy rollgaitd
  check "the watcher re-attaches by itself and sees the end" ended_well long
  pod logs rollgaitd > "$logs/started-again.log" 2>&1 || true
  check "it missed nothing and saw nothing twice" dense interrupted.jsonl
  check "the solve was run again" grep -q '"attempt":2' "$work/out/interrupted.jsonl"
  check "a second client takes up after number $seen" takes_up_after "$name" "$seen"
  for field in termination objective; do
    check "the result's $field is that of the uninterrupted run" equal "$(result_field interrupted $field)" "$(result_field reference $field)"
  done
  know_all
}
# in_background NAME COMMAND...: its exit code goes to a file, since check's subshell cannot wait for it.
in_background() {
  local name=$1
  shift
  { local code=0; "$@" || code=$?; echo $code > "$work/code.$name"; } &
}
ended_well() { until_true 240 test -s "$work/code.$1" && equal "$(cat "$work/code.$1")" 0; }
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
