"""Checks what is deployed: docker/compose*.yaml, docker/kubernetes, docker/slurm, docker/observability.

    python3 tests/container/check_deployments.py DIRECTORY [CERTIFICATE]

The files parse; every service and pod is confined as docs/how-to/operations.md says; flags that they give to programs exist (DIRECTORY
holds what `--help` of rollgaitd, rollgait-agent and rollgait-gateway prints, in files of these names); haproxy takes the door's configuration
(with CERTIFICATE, name.crt beside its name.key); names that refer to each other agree.
Prints one line a problem; exit code 1 if there is one.
"""
import json
import pathlib
import re
import subprocess
import sys

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCKER = ROOT / "docker"
problems = []


def expect(holds, where, what):
    if not holds:
        problems.append(f"{where}: {what}")


def flags_of(program):
    flags = set(re.findall(r"--[a-z][a-z0-9-]*", (pathlib.Path(sys.argv[1]) / program).read_text()))
    expect("--log-level" in flags, program, "its --help names no flags")
    return flags


FLAGS = {program: flags_of(program) for program in ("rollgaitd", "rollgait-agent", "rollgait-gateway")}


def check_command(where, command):
    if command[:1] == ["haproxy"]:
        expect(command[1:] == ["-W", "-db", "-f", "/etc/rollgait/door.cfg"], where, "does not start the door as docs/explanation/door.md says")
        return
    expect(command and command[0] in FLAGS, where, f"the program {command[:1]} is none of {sorted(FLAGS)}")
    for argument in command[1:]:
        flag = argument.split("=")[0]
        if flag.startswith("--"):
            expect(flag in FLAGS[command[0]], where, f"{command[0]} has no flag {flag}")
        expect(not re.search(r"://[^/@]*:[^/@]*@", argument), where, "a password stands in an argument")


def check_compose(path):
    compose = yaml.safe_load(path.read_text())
    secrets, volumes = compose.get("secrets", {}), compose.get("volumes", {})
    for name, service in compose["services"].items():
        where = f"{path.name}, {name}"
        for secret in service.get("secrets", []):
            expect(secret in secrets, where, f"the secret {secret} is not declared")
        for volume in service.get("volumes", []):
            source = volume.split(":")[0]
            expect(source.startswith("/") or source in volumes, where, f"the volume {source} is not declared")
        expect("no-new-privileges:true" in service.get("security_opt", []), where, "no-new-privileges is missing")
        if name == "postgres":
            continue
        check_command(where, service["command"])
        expect(service.get("read_only") is True, where, "read_only is missing")
        expect(service.get("cap_drop") == ["ALL"], where, "cap_drop: [ALL] is missing")
        expect("mem_limit" in service and "pids_limit" in service, where, "limits of memory and processes are missing")
        expect("stop_grace_period" in service, where, "stop_grace_period is missing: the default kills after 10 s")


def check_pod(where, spec, volume_names):
    security = spec["securityContext"]
    expect(security.get("runAsNonRoot") is True and security.get("runAsUser") == 10001, where, "runs as root or as another user")
    expect(security.get("seccompProfile", {}).get("type") == "RuntimeDefault", where, "no seccomp profile")
    expect(spec.get("automountServiceAccountToken") is False, where, "a service account's token is mounted")
    for container in spec.get("initContainers", []) + spec["containers"]:
        inner = f"{where}, {container['name']}"
        security = container["securityContext"]
        expect(security.get("allowPrivilegeEscalation") is False, inner, "may gain privileges")
        expect(security.get("readOnlyRootFilesystem") is True, inner, "may write to its root")
        expect(security.get("capabilities") == {"drop": ["ALL"]}, inner, "keeps capabilities")
        expect("memory" in container["resources"]["limits"], inner, "no limit of memory")
        for mount in container.get("volumeMounts", []):
            expect(mount["name"] in volume_names, inner, f"mounts {mount['name']}, which the pod does not have")
        if "args" in container:
            check_command(inner, container["args"])


def check_kubernetes(path):
    documents = [document for document in yaml.safe_load_all(path.read_text()) if document]
    deployments = {d["metadata"]["name"]: d for d in documents if d["kind"] == "Deployment"}
    for document in documents:
        where = f"{path.name}, {document['kind']} {document['metadata']['name']}"
        spec = document.get("spec", {})
        if document["kind"] != "Namespace":
            expect(document["metadata"].get("namespace") == "rollgait", where, "is in no namespace, or in another one")
        if document["kind"] == "Deployment":
            pod = spec["template"]
            expect(spec["selector"]["matchLabels"] == pod["metadata"]["labels"], where, "selects other pods than it makes")
            check_pod(where, pod["spec"], {volume["name"] for volume in pod["spec"]["volumes"]})
        selector = spec.get("selector", {}) if document["kind"] == "Service" else spec.get("selector", spec.get("podSelector", {}))
        labels = selector.get("matchLabels", selector)
        if document["kind"] in ("Service", "PodDisruptionBudget", "NetworkPolicy"):
            expect(any(labels == d["spec"]["template"]["metadata"]["labels"] for d in deployments.values()), where, "selects nothing")
        if document["kind"] == "HorizontalPodAutoscaler":
            target = spec["scaleTargetRef"]["name"]
            expect(target in deployments, where, f"scales {target}, which is not there")
            expect("replicas" not in deployments[target]["spec"], where, "its deployment sets replicas too")
    kinds = {document["kind"] for document in documents}
    for kind in ("Deployment", "Service", "PodDisruptionBudget", "HorizontalPodAutoscaler", "NetworkPolicy"):
        expect(kind in kinds, path.name, f"holds no {kind}")


for compose_file in sorted(DOCKER.glob("compose*.yaml")):
    check_compose(compose_file)
check_kubernetes(DOCKER / "kubernetes/rollgait.yaml")
for yaml_file in sorted((DOCKER / "observability").glob("*.yml")):
    yaml.safe_load(yaml_file.read_text())
json.loads((DOCKER / "observability/dashboard.json").read_text())
door = subprocess.run(["haproxy", "-c", "-f", DOCKER / "door/haproxy.cfg"], capture_output=True, text=True,
                      env={"PATH": "/usr/sbin:/usr/bin:/bin", "ROLLGAIT_DOOR_CERTIFICATE": sys.argv[2]}) if len(sys.argv) > 2 else None
expect(door is None or door.returncode == 0 and "WARNING" not in door.stderr, "haproxy.cfg", door and door.stderr.strip())
for unit in (DOCKER / "systemd").glob("*.service"):
    for line in re.findall(r"^ExecStart=(.*)$", unit.read_text().replace("\\\n", " "), re.M):
        words = line.split()
        if pathlib.Path(words[0]).name in FLAGS:
            check_command(unit.name, [pathlib.Path(words[0]).name, *words[1:]])
for script in (DOCKER / "slurm/agents.sbatch", DOCKER / "runtime-packages"):
    checked = subprocess.run(["bash", "-n", script], capture_output=True, text=True)
    expect(checked.returncode == 0, script.name, checked.stderr.strip())
slurm = (DOCKER / "slurm/agents.sbatch").read_text()
for slurm_flag in re.findall(r"^\"\$agent\" (.*)$", slurm, re.M)[0].split():
    if slurm_flag.startswith("--"):
        expect(slurm_flag in FLAGS["rollgait-agent"], "agents.sbatch", f"rollgait-agent has no flag {slurm_flag}")

print("\n".join(problems) or "The deployment files agree with the programs and with each other.")
sys.exit(1 if problems else 0)
