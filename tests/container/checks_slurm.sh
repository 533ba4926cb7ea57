# To be sourced by run: docker/slurm/agents.sbatch on a Slurm cluster of one node, with the PostgreSQL of checks_postgres.
# shellcheck shell=bash

build_slurm() {
  pod build --isolation chroot --network host "${limits[@]}" --format docker -f tests/container/slurm.Dockerfile \
    -t localhost/slurm:test --build-arg "IMAGE=$image" tests/container > "$logs/build-slurm.log" 2>&1 ||
    { tail -n 20 "$logs/build-slurm.log"; return 1; }
}
# The daemons of Slurm start jobs as other users, and ask for a user's environment in a namespace of processes, so this container alone
# is not confined.
start_slurm() {
  pod run -d --name slurm --hostname slurm --cap-add SYS_ADMIN "${limits[@]}" "${unattended[@]}" --network "$network" --ip "${places[slurm]}" \
    "${hosts[@]}" "${pgpass[@]}" -v "$PWD/docker/slurm/agents.sbatch:/agents.sbatch:ro" localhost/slurm:test > /dev/null
}
# As the user whose solves run there.
slurm() { pod exec --user 10001 -e HOME=/var/lib/rollgait -w /var/lib/rollgait slurm "$@"; }
node_is_idle() { equal "$(slurm sinfo -h -o %T)" idle; }
submit() { slurm sbatch --parsable --array=1-2 --cpus-per-task=1 "--export=ALL,ROLLGAIT_STORE=$store_url" /agents.sbatch; }
submit_with_password() {
  local code=0
  slurm timeout 60 sbatch --wait --array=1 "--export=ALL,ROLLGAIT_STORE=${store_url/@/:secret@}" /agents.sbatch || code=$?
  equal "$code" 2 || { slurm scontrol show job; return 1; }
  slurm sh -c 'cat rollgait-agent-*.log' | grep 'ROLLGAIT_STORE holds a password'
}
jobs_are() { equal "$(slurm squeue -h -r -t "$1" | wc -l)" "$2"; }
agents_stopped() {
  slurm sh -c 'cat rollgait-agent-*.log' > "$logs/slurm-agents.log"
  equal "$(grep -c '"event":"agent.stopped"' "$logs/slurm-agents.log")" "$1"
}

check_slurm() {
  local name
  pod rm -f -t 0 rollgaitd agent1 agent2 > /dev/null
  check "an image of Slurm" build_slurm
  check "a cluster of one node starts" start_slurm
  check "the node is idle" until_true 60 node_is_idle
  check "a server without agents starts" start_front_end
  check "it becomes healthy" until_true 60 healthy rollgaitd
  check "a token is made in its container" prepare_clients "--store=$store_url"
  check "a password in the job's environment is refused" submit_with_password
  check "an array of two agents is submitted" submit
  check "both run" until_true 60 jobs_are RUNNING 2
  check "they solve" client -q solve --model planar --slope 3 --speed 1.21 --output /out/slurm.json
  check "  and the result is optimal" equal "$(result_field slurm termination)" TERMINATION_OPTIMAL
  name=$(client solve --model human29 --speed 1.21 --slope 0 --detach | grep -o 'solves/[a-z0-9]*' | head -n 1 || true)
  in_background scancelled client --json watch "$name" > "$work/out/scancelled.jsonl" 2> "$logs/watch-scancelled.log"
  check "a long solve runs: $name" until_true 120 iterations_seen scancelled.jsonl 5
  check "scancel reaches agents and solvers alike" slurm scancel --user rollgait
  check "  the jobs end" until_true 60 jobs_are PENDING,RUNNING,COMPLETING 0
  check "  by themselves: both agents have given their solves back" agents_stopped 2
  check "  and nobody took the solve's end from that: $name is queued" count_is QUEUED 1
  check "the array is submitted again" submit
  check "it runs the solve again, and the watcher sees the end" ended_well scancelled
  check "it missed nothing and saw nothing twice" dense scancelled.jsonl
  check "SIGTERM ends the server with exit code 0 within 30 s" stops_cleanly rollgaitd
}
