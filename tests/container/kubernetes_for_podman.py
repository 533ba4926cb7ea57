"""Prints docker/kubernetes/rollgait.yaml as `podman play kube` of Debian 12 can run it.

    python3 tests/container/kubernetes_for_podman.py IMAGE STORE_URL POSTGRES_ADDRESS

What podman has no notion of goes: namespaces, services, policies, the autoscaler. One pod a deployment, no port of the machine, volumes
with names of their own (podman shares those of one name between pods), init containers that are not started again once they have ended.
Image and URL of the store are the test's, as an operator would set them; the name of its database server is in /etc/hosts. All else stays: users, capabilities, read-only roots, secrets,
arguments, init containers.
"""
import pathlib
import sys

import yaml

IMAGE, STORE_URL, POSTGRES_ADDRESS = sys.argv[1:]
MANIFEST = pathlib.Path(__file__).resolve().parents[2] / "docker/kubernetes/rollgait.yaml"

kept = []
for document in yaml.safe_load_all(MANIFEST.read_text()):
    if document["kind"] == "ConfigMap":
        document["data"]["store"] = STORE_URL
    elif document["kind"] == "Deployment":
        document["spec"]["replicas"] = 1
        pod = document["spec"]["template"]["spec"]
        pod["restartPolicy"] = "OnFailure"
        pod["hostAliases"] = [{"ip": POSTGRES_ADDRESS, "hostnames": ["postgres"]}]
        own = document["metadata"]["name"] + "-"
        for volume in pod["volumes"]:
            volume["name"] = own + volume["name"]
        for container in pod["initContainers"] + pod["containers"]:
            container["image"] = IMAGE
            container.pop("ports", None)
            for mount in container["volumeMounts"]:
                mount["name"] = own + mount["name"]
    else:
        continue
    kept.append(document)
# Without anchors: podman reads one document at a time.
yaml.SafeDumper.ignore_aliases = lambda *_: True
print(yaml.safe_dump_all(kept))
