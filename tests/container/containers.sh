# To be sourced by run: podman with storage of its own, and how a check is written down.
# shellcheck shell=bash

passed=0
failed=0
step() { echo; echo "==> $*"; }
# check SENTENCE COMMAND...: runs the command; the sentence says what is true when it succeeds.
check() {
  local sentence=$1
  shift
  local output
  if output=$("$@" 2>&1); then
    passed=$((passed + 1))
    echo "  ok    $sentence"
  else
    failed=$((failed + 1))
    echo "  FAIL  $sentence"
    sed 's/^/        | /' <<< "$output" | tail -n 20
  fi
}
equal() { [ "$1" = "$2" ] || { echo "is '$1', expected '$2'"; return 1; }; }
# until_true SECONDS COMMAND...: tries every half second.
until_true() {
  local end=$((SECONDS + $1))
  shift
  until "$@" > /dev/null 2>&1; do
    [ $SECONDS -lt $end ] || { "$@"; return 1; }
    sleep 0.5
  done
}

# What is asked of every container; the limits are those that runc may set in a sandboxed CI.
limits=(--ulimit nofile=10000:10000 --ulimit nproc=4000:4000)
# podman has health checks run by systemd, which a container or CI has not; the test runs the image's own.
unattended=(--no-healthcheck)
# As docker/compose.yaml has it.
confined=(--read-only --tmpfs /tmp:rw,size=64m --cap-drop ALL --security-opt no-new-privileges)

# know NAME...: containers of these names get fixed addresses, which the others have in their /etc/hosts: podman's name server for a
# network now and then gives no answer for half a minute after a container has come or gone. Who is not known is found by the name
# server; a container that is to be started again must be, since at its old address the others do not reach it then.
declare -A places
know() {
  local name
  places=()
  hosts=()
  for name in "$@"; do
    places[$name]=${subnet%.*}.$((240 + ${#places[@]}))  # others get addresses from 2 on, one a start
    hosts+=(--add-host "$name:${places[$name]}")
  done
}
know_all() { know postgres rollgaitd agent1 agent2 slurm rollgaitd-pod-0 rollgait-agent-pod-0; }
address_of() { pod inspect --format "{{(index .NetworkSettings.Networks \"$network\").IPAddress}}" "$1"; }

set_up_containers() {
  work=$(mktemp -d /var/tmp/rollgait-containers.XXXXXX)
  logs=build/container-logs
  rm -rf $logs
  mkdir -p $logs "$work/out"
  chmod 0777 "$work/out"
  image=localhost/rollgait:test
  network=rollgait-test
  pod network create $network > "$logs/network.log" 2>&1 ||
    { cat "$logs/network.log" >&2; fail "podman cannot make a network here; the container tests cannot run"; }
  subnet=$(pod network inspect --format '{{range .Subnets}}{{.Subnet}}{{end}}' $network)
  know_all
}

# No command of podman's may hang the run; the longest but for the image takes two minutes. pod_limit=S pod ... for another limit.
pod() {
  timeout --kill-after=10 "${pod_limit:-600}" podman --runtime runc --root "$work/storage" --runroot "$work/run" --tmpdir "$work/tmp" \
    --network-config-dir "$work/networks" --cgroup-manager cgroupfs --events-backend file "$@"
}

tear_down_containers() {
  for container in $(pod ps -aq 2> /dev/null); do
    pod logs "$container" > "$logs/$(pod inspect --format '{{.Name}}' "$container").log" 2>&1 || true
  done
  [ "${failed:-0}" = 0 ] || echo "Logs of the containers are in $logs."
  pod pod rm -fa -t 0 > /dev/null 2>&1 || true
  pod rm -fa -t 0 > /dev/null 2>&1 || true
  pod network rm -f $network > /dev/null 2>&1 || true
  umount -qR "$work/storage/overlay" 2> /dev/null || true  # after an interruption layers are mounted below it
  rm -rf --one-file-system "$work" || true
}

# run_in NAME ARGUMENTS...: a container in the background.
run_in() {
  local name=$1
  shift
  pod run -d --name "$name" "${limits[@]}" "${unattended[@]}" --network "$network" ${places[$name]:+--ip "${places[$name]}"} "${hosts[@]}" \
    "${confined[@]}" "$@" > /dev/null
}
# client ARGUMENTS...: the client in a container that ends with it, over the network; /out is $work/out.
client() {
  pod run --rm "${limits[@]}" "${unattended[@]}" --network "$network" "${hosts[@]}" "${confined[@]}" -v "$work/out:/out" \
    "${client_options[@]}" "$image" rollgait --tls-ca /run/secrets/ca.crt --token-file /run/secrets/token "$@"
}

make_base_image() {
  local root=$work/root
  make_bare_root "$1"
  cp -a "$roots/$1.base" "$root"
  give_apt_settings "$1" "$root"
  tar -C "$root" -c . | pod import - "localhost/debian:$1" > "$logs/import.log" 2>&1 ||
    { cat "$logs/import.log" >&2; fail "podman cannot import an image here; the container tests cannot run"; }
  rm -rf "$root"
  base=localhost/debian:$1
  pod run --rm "${limits[@]}" --network none "$base" true > "$logs/first.log" 2>&1 ||
    { cat "$logs/first.log" >&2; fail "podman cannot run a container here; runc's reason is above"; }
}

# Programs from elsewhere, where the image can be built from: only what lies in this repository can.
take_programs() {
  local from=$1 program
  for program in rollgait rollgaitd rollgait-agent rollgait-solve rollgait-simulate rollgait-gateway; do
    [ -x "$from/$program" ] || fail "--programs $from holds no program $program"
  done
  [ -s "$from/runtime-packages" ] ||
    fail "--programs $from has no list of packages; where they were built: docker/runtime-packages $from > $from/runtime-packages"
  rm -rf build/container-programs
  mkdir -p build/container-programs
  cp "$from"/rollgait "$from"/rollgaitd "$from"/rollgait-* "$from/runtime-packages" build/container-programs/
}

build_image() {
  local -a arguments=(--build-arg "BASE=$base")
  local advice=""
  case $1 in
    prebuilt)
      [ -x build/release/bin/rollgaitd ] || fail "build/release/bin holds no programs; run scripts/build first"
      docker/runtime-packages build/release/bin > build/release/runtime-packages
      arguments+=(--build-arg PROGRAMS=prebuilt)
      ;;
    */*)
      take_programs "$1"
      arguments+=(--build-arg PROGRAMS=prebuilt --build-arg PREBUILT=build/container-programs
        --build-arg PACKAGES=build/container-programs/runtime-packages)
      advice="; were the programs in $1 built on Debian $suite?"
      ;;
    compile) arguments+=(--build-arg PROGRAMS=compile) ;;
  esac
  local begun=$SECONDS program
  pod_limit=2400 pod build --isolation chroot --network host "${limits[@]}" --format docker -f docker/Dockerfile -t "$image" \
    "${arguments[@]}" . > "$logs/build.log" 2>&1 ||
    { tail -n 30 "$logs/build.log" >&2; fail "the image could not be built; the end of $logs/build.log is above$advice"; }
  for program in rollgait rollgaitd rollgait-agent rollgait-solve rollgait-simulate rollgait-gateway; do
    pod run --rm "${limits[@]}" "${unattended[@]}" --network none "$image" $program --version > "$logs/first-start.log" 2>&1 ||
      { cat "$logs/first-start.log" >&2; fail "$program does not start in the image; its reason is above$advice"; }
  done
  echo "  built in $((SECONDS - begun)) s"
}
