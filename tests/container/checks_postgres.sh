# To be sourced by run: the layout of docker/compose.postgres.yaml with two agents, by plain podman.
# shellcheck shell=bash

store_url=postgresql://rollgait@postgres:5432/postgres

build_postgres() {
  pod build --isolation chroot --network host "${limits[@]}" --format docker -f tests/container/postgres.Dockerfile \
    -t localhost/postgres:test --build-arg "BASE=$base" tests/container > "$logs/build-postgres.log" 2>&1 ||
    { tail -n 20 "$logs/build-postgres.log"; return 1; }
}
# A password that only files know: the server reads it as user postgres, the others through libpq's password file.
make_password() {
  local secrets=$work/postgres-secrets
  mkdir -p "$secrets"
  password=$(openssl rand -hex 16)
  echo "$password" > "$secrets/postgres_password"
  echo "postgres:5432:*:rollgait:$password" > "$secrets/pgpass"
  chmod 0644 "$secrets/postgres_password"
  chmod 0600 "$secrets/pgpass"
  chown 10001:10001 "$secrets/pgpass"
  pgpass=(-v "$secrets/pgpass:/run/secrets/pgpass:ro" -e PGPASSFILE=/run/secrets/pgpass)
}
start_postgres() {
  run_in postgres -v pgdata:/var/lib/postgresql -v "$work/postgres-secrets/postgres_password:/run/secrets/postgres_password:ro" \
    localhost/postgres:test
}
start_agent() {
  run_in "$1" "${pgpass[@]}" -v "$1:/var/lib/rollgait" "$image" \
    rollgait-agent "--store=$store_url" --work-dir=/var/lib/rollgait --slots=1 --lease-s=5 --metrics-listen=0.0.0.0:9464
}
start_front_end() {
  run_in rollgaitd -v front:/var/lib/rollgait "${pgpass[@]}" "${server_mounts[@]}" "$image" \
    rollgaitd --data-dir /var/lib/rollgait "--store=$store_url" "${server_access[@]}" --metrics-listen 0.0.0.0:9464
}
solves_of() {
  curl -sf "http://$(address_of "$1"):9464/metrics" | awk '/^rollgait_solves_total\{.*succeeded/ {sum += $2} END {print sum + 0}'
}
both_worked() {
  local first second
  first=$(solves_of agent1)
  second=$(solves_of agent2)
  [ "$first" -ge 1 ] && [ "$second" -ge 1 ] || { echo "agent1 solved $first, agent2 $second"; return 1; }
}
# So many solves of the server are in this state.
count_is() { equal "$(client --json list --limit 100 | grep -c "\"SOLVE_STATE_$1\"")" "$2"; }
holder_of_lease() {
  for agent in agent1 agent2; do
    if metric_at_least $agent rollgait_leases 1 > /dev/null; then echo $agent; return; fi
  done
  return 1
}
no_password_in_logs() {
  for container in rollgaitd agent1 agent2; do
    ! pod logs $container 2>&1 | grep "$password" || return 1
  done
}

check_postgres() {
  local names=() name holder
  pod rm -fa -t 0 > /dev/null
  check "an image of PostgreSQL" build_postgres
  make_password
  check "PostgreSQL starts" start_postgres
  check "it accepts connections" until_true 60 pod exec postgres pg_isready -h 127.0.0.1
  check "a server without agents of its own starts" start_front_end
  check "an agent starts" start_agent agent1
  check "and another" start_agent agent2
  check "the server becomes healthy" until_true 60 healthy rollgaitd
  check "a token is made in its container, stored in PostgreSQL" prepare_clients "--store=$store_url"
  for slope in 1 2 3 4 5 6 7 8; do
    names+=("$(client solve --model planar --slope $slope --speed 1.3 --detach | grep -o 'solves/[a-z0-9]*' | head -n 1 || true)")
  done
  for name in "${names[@]}"; do client --json watch "$name" > /dev/null || true; done
  check "eight solves succeed" count_is SUCCEEDED 8
  check "both agents worked" both_worked
  name=$(client solve "${long_solve[@]}" --detach | grep -o 'solves/[a-z0-9]*' | head -n 1 || true)
  in_background moved client --json watch "$name" > "$work/out/moved.jsonl" 2> "$logs/watch-moved.log"
  check "a long solve runs: $name" until_true 120 iterations_seen moved.jsonl 5
  holder=$(holder_of_lease || true)
  check "kill -9 of the agent that works on it: $holder" pod kill -s KILL "${holder:-none}"
  check "the other agent takes it over, and the watcher sees the end" ended_well moved
  check "it missed nothing and saw nothing twice" dense moved.jsonl
  check "no log holds the password" no_password_in_logs
  check "SIGTERM ends an agent with exit code 0 within 30 s" stops_cleanly "$([ "$holder" = agent1 ] && echo agent2 || echo agent1)"
  check "SIGTERM ends the server with exit code 0 within 30 s" stops_cleanly rollgaitd
}
