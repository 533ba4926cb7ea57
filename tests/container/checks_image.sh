# To be sourced by run: what the image holds and may do.
# shellcheck shell=bash

in_image() { pod run --rm "${limits[@]}" "${unattended[@]}" --network none "${confined[@]}" "$image" "$@"; }
# The command fails, and not because it is missing.
refused() {
  local code=0
  in_image "$@" || code=$?
  [ $code != 0 ] && [ $code != 127 ] && [ $code != 126 ]
}
deployments_are_right() {
  local program
  mkdir -p "$work/help"
  for program in rollgaitd rollgait-agent rollgait-gateway; do in_image $program --help > "$work/help/$program" || return 1; done
  python3 $here/check_deployments.py "$work/help"
}
no_compiler() { ! in_image sh -c 'command -v gcc g++ cc ld make cmake python3 curl'; }
inspect() { pod inspect --format "$1" "$image"; }

check_image() {
  local base_size size
  base_size=$(pod inspect --format '{{.Size}}' "$base")
  size=$(inspect '{{.Size}}')
  echo "  size: $((size / 1000000)) MB, of which $((base_size / 1000000)) MB are the base"
  check "the programs run: $(in_image rollgaitd --version || true)" in_image rollgaitd --version
  for program in rollgait-agent rollgait-solve rollgait-simulate rollgait-gateway rollgait; do
    check "$program finds its libraries" in_image $program --version
  done
  check "it runs as user 10001 without privileges" equal "$(in_image id -u):$(in_image id -g)" 10001:10001
  check "no process may gain privileges" in_image grep -q '^NoNewPrivs:[[:space:]]*1' /proc/self/status
  check "no capability is left" in_image grep -q '^CapBnd:[[:space:]]*0000000000000000' /proc/self/status
  check "the root file system cannot be written" refused touch /etc/x /usr/local/bin/x /x
  check "the data directory is the user's alone" equal "$(in_image stat -c '%u:%g %a' /var/lib/rollgait)" '10001:10001 700'
  check "it holds no compiler and no download tool" no_compiler
  check "a health check is declared" equal "$(inspect '{{index .HealthCheck.Test 1}}')" rollgait
  check "SIGTERM stops it" equal "$(inspect '{{.Config.StopSignal}}')" SIGTERM
}
