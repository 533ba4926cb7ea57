"""A reader of OpenAPI 3.0 that knows nothing of how the document is made: what is wrong with its structure, and whether an answer is
one that it describes. Debian 12 has no validator."""
import re

TYPES = {"string", "number", "integer", "boolean", "array", "object"}
VERBS = {"get", "put", "post", "delete", "options", "head", "patch", "trace"}
SCHEMA = {"type", "format", "description", "enum", "items", "properties", "additionalProperties", "required", "allOf", "$ref"}
OPERATION = {"operationId", "description", "parameters", "requestBody", "responses"}


def resolve(document, reference):
    node = document
    if not reference.startswith("#/"):
        raise KeyError(reference)
    for part in reference[2:].split("/"):
        node = node[part.replace("~1", "/").replace("~0", "~")]
    return node


def schema_problems(document, schema, where):
    found = [f"{where}: unknown key {key}" for key in set(schema) - SCHEMA]
    if "$ref" in schema:
        try:
            resolve(document, schema["$ref"])
        except KeyError:
            found.append(f"{where}: {schema['$ref']} names nothing")
        return found + ([f"{where}: keys beside $ref"] if len(schema) > 1 else [])
    for index, part in enumerate(schema.get("allOf", [])):
        found += schema_problems(document, part, f"{where}.allOf[{index}]")
    if "allOf" not in schema and schema.get("type") not in TYPES:
        found.append(f"{where}: type {schema.get('type')}")
    if schema.get("type") == "array":
        found += schema_problems(document, schema["items"], where + "[]") if "items" in schema else [f"{where}: an array of nothing"]
    for name, part in schema.get("properties", {}).items():
        found += schema_problems(document, part, f"{where}.{name}")
    if isinstance(schema.get("additionalProperties"), dict):
        found += schema_problems(document, schema["additionalProperties"], where + "{}")
    if "enum" in schema and (not schema["enum"] or len(set(schema["enum"])) != len(schema["enum"])):
        found.append(f"{where}: enum without values, or one twice")
    found += [f"{where}: required {name} is no property" for name in set(schema.get("required", [])) - set(schema.get("properties", {}))]
    return found


def content_problems(document, content, where):
    return [problem for kind, value in content.items() for problem in
            ([] if re.fullmatch(r"[\w.+-]+/[\w.+-]+", kind) else [f"{where}: media type {kind}"]) +
            schema_problems(document, value["schema"], f"{where} {kind}")]


def operation_problems(document, path, verb, operation, ids):
    where = f"{verb} {path}"
    found = [f"{where}: unknown key {key}" for key in set(operation) - OPERATION]
    if operation["operationId"] in ids:
        found.append(f"{where}: operationId {operation['operationId']} twice")
    ids.add(operation["operationId"])
    in_path, seen = set(re.findall(r"\{(\w+)\}", path)), set()
    for parameter in operation.get("parameters", []):
        key = (parameter["in"], parameter["name"])
        if key in seen or parameter["in"] not in ("path", "query", "header"):
            found.append(f"{where}: parameter {key}")
        seen.add(key)
        if parameter["in"] == "path" and not parameter.get("required"):
            found.append(f"{where}: {parameter['name']} of the path is not required")
        found += schema_problems(document, parameter["schema"], f"{where} {parameter['name']}")
    if {name for place, name in seen if place == "path"} != in_path:
        found.append(f"{where}: parameters of the path are not those of its parameters")
    if "requestBody" in operation:
        if verb in ("get", "delete"):
            found.append(f"{where}: a body")
        found += content_problems(document, operation["requestBody"]["content"], where)
    if not operation.get("responses"):
        found.append(f"{where}: no response")
    for status, response in operation.get("responses", {}).items():
        if not re.fullmatch(r"[1-5]\d\d|default", status) or not response.get("description"):
            found.append(f"{where}: response {status}")
        found += content_problems(document, response.get("content", {}), f"{where} {status}")
    return found


def problems(document):
    """One line for each thing that is wrong."""
    if not re.fullmatch(r"3\.0\.\d+", document.get("openapi", "")):
        return [f"openapi is {document.get('openapi')}"]
    found = [f"info has no {key}" for key in ("title", "version") if not document["info"].get(key)]
    ids = set()
    for path, operations in document["paths"].items():
        if not path.startswith("/") or not operations:
            found.append(f"{path}: is no path with operations")
        for verb, operation in operations.items():
            found += operation_problems(document, path, verb, operation, ids) if verb in VERBS else [f"{path}: {verb}"]
    for name, schema in document["components"]["schemas"].items():
        if not re.fullmatch(r"[\w.-]+", name):
            found.append(f"schema {name}: is no name")
        found += schema_problems(document, schema, name)
    for requirement in document.get("security", []):
        found += [f"security {name} is not declared" for name in set(requirement) - set(document["components"]["securitySchemes"])]
    return found


def mismatches(document, schema, value, where):
    """Where `value` is not what `schema` says."""
    if "$ref" in schema:
        return mismatches(document, resolve(document, schema["$ref"]), value, where)
    if "allOf" in schema:
        return [problem for part in schema["allOf"] for problem in mismatches(document, part, value, where)]
    kind = schema["type"]
    right = {"string": str, "boolean": bool, "integer": int, "number": (int, float), "array": list, "object": dict}[kind]
    special = kind == "number" and value in ("NaN", "Infinity", "-Infinity")
    if not special and (not isinstance(value, right) or (kind != "boolean" and isinstance(value, bool))):
        return [f"{where}: {value!r} is no {kind}"]
    if "enum" in schema and value not in schema["enum"]:
        return [f"{where}: {value!r} is not in the enum"]
    if schema.get("format") == "int64" and not re.fullmatch(r"-?\d+", value):
        return [f"{where}: {value!r} is no int64"]
    if schema.get("format") == "date-time" and not re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d+)?Z", value):
        return [f"{where}: {value!r} is no time"]
    if kind == "array":
        return [problem for index, one in enumerate(value) for problem in mismatches(document, schema["items"], one, f"{where}[{index}]")]
    found = []
    if kind == "object":
        for name, one in value.items():
            part = schema.get("properties", {}).get(name, schema.get("additionalProperties", True))
            if part is False:
                found.append(f"{where}: {name} is not described")
            elif isinstance(part, dict):
                found += mismatches(document, part, one, f"{where}.{name}")
    return found
