# To be sourced by run: the pods of docker/kubernetes as podman can play them, with the PostgreSQL of checks_postgres. What only a cluster
# has (services, policies, the autoscaler) is checked by check_deployments.py alone.
# shellcheck shell=bash

# kubernetes_secret NAME FILE...: what `kubectl create secret generic NAME --from-file` makes.
kubernetes_secret() {
  local name=$1 file field=stringData
  shift
  [[ $(pod --version) != *" 4.3."* ]] || field=data  # which that version hands on as it is, base64 or not
  {
    printf 'apiVersion: v1\nkind: Secret\nmetadata: {name: %s}\n%s:\n' "$name" "$field"
    for file in "$@"; do
      printf '  %s: |\n' "${file##*/}"
      sed 's/^/    /' "$file"
    done
  } | pod secret create "$name" -
}
make_kubernetes_secrets() {
  kubernetes_secret rollgait-tls "$tls/tls.crt" "$tls/tls.key" && kubernetes_secret rollgait-postgres "$work/postgres-secrets/pgpass"
}
play_kubernetes() {
  python3 $here/kubernetes_for_podman.py "$image" "$store_url" "${places[postgres]}" > "$work/kubernetes.yaml" || return 1
  printf '[containers]\ndefault_ulimits = ["nofile=10000:10000", "nproc=4000:4000"]\n' > "$work/containers.conf"
  CONTAINERS_CONF=$work/containers.conf pod play kube --network "$network" --ip "${places[rollgaitd-pod-0]}" --ip "${places[rollgait-agent-pod-0]}" \
    "$work/kubernetes.yaml"
}
in_pod() { pod exec rollgaitd-pod-0-rollgaitd "$@"; }
pod_is_confined() {
  equal "$(in_pod id -u)" 10001 && in_pod grep -q '^NoNewPrivs:[[:space:]]*1' /proc/self/status &&
    in_pod grep -q '^CapBnd:[[:space:]]*0000000000000000' /proc/self/status && ! in_pod touch /usr/local/bin/x
}

check_kubernetes() {
  local client_options=("${client_options[@]}" -e ROLLGAIT_SERVER=rollgaitd-pod-0:50051)
  pod rm -f -t 0 rollgaitd slurm > /dev/null
  check "its secrets" make_kubernetes_secrets
  check "podman plays the manifest" play_kubernetes
  check "the front end becomes healthy, by the command of its probes" until_true 60 healthy rollgaitd-pod-0-rollgaitd
  check "its pod runs as user 10001, without capabilities, on a read-only root" pod_is_confined
  check "a token of the database admits the client, and the agent's pod solves" \
    client -q solve --model planar --slope 4 --speed 1.22 --output /out/kubernetes.json
  check "  and the result is optimal" equal "$(result_field kubernetes termination)" TERMINATION_OPTIMAL
  check "SIGTERM ends the agent with exit code 0 within 30 s" stops_cleanly rollgait-agent-pod-0-rollgait-agent
  check "SIGTERM ends the front end with exit code 0 within 30 s" stops_cleanly rollgaitd-pod-0-rollgaitd
}
