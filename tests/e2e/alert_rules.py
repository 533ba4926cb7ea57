"""Alert rules of Prometheus, evaluated on two scrapes: as much of its language as docker/observability/alerts.yml uses.

The rate of a counter is its growth between the scrapes; `sum` has nothing to do, as every selector is summed. A selector that nothing
matches has no value, and a rule with one does not fire. `job`, which a scrape configuration adds, is left out. What is not known here raises.
"""
import re
import urllib.request

SELECTOR = r"(?P<name>[a-z_]+)(?:\{(?P<labels>[^}]*)\})?"
OPERATORS = {"sum", "max", "by", "and", "or"}


class Absent(Exception):
    """Nothing matches a selector."""


def scrape(*addresses):
    """The samples of several servers, `name{labels}` to value."""
    samples = {}
    for address in addresses:
        with urllib.request.urlopen(f"http://{address}/metrics", timeout=60) as answer:
            for line in answer.read().decode().splitlines():
                if line and not line.startswith("#"):
                    name, value = line.rsplit(" ", 1)
                    samples[name] = float(value)
    return samples


def rules(path):
    """Name to expression."""
    with open(path, encoding="utf-8") as file:
        found = re.findall(r"- alert: (\w+)\n +expr: (.*)\n", file.read())
    return dict(found)


def matches(sample, name, wanted):
    if sample != name and not sample.startswith(name + "{"):
        return False
    labels = dict(re.findall(r'(\w+)="([^"]*)"', sample))
    for label, operator, value in re.findall(r'(\w+)(=~|=)"([^"]*)"', wanted or ""):
        if label == "job":
            continue
        if not (re.fullmatch(value, labels.get(label, "")) if operator == "=~" else labels.get(label, "") == value):
            return False
    return True


def value_of(samples, name, labels):
    values = [value for sample, value in samples.items() if matches(sample, name, labels)]
    if not values:
        raise Absent(name)
    return sum(values)


def fires(expression, before, after, seconds):
    """Whether the rule holds for what grew in so many seconds."""
    def growth(match):
        grown = value_of(after, match["name"], match["labels"])
        try:
            grown -= value_of(before, match["name"], match["labels"])
        except Absent:
            pass  # a series that began meanwhile
        return repr(grown / seconds)

    def gauge(match):
        return match[0] if match["name"] in OPERATORS else repr(value_of(after, match["name"], match["labels"]))

    text = re.sub(r"\b(sum|max) by \([^)]*\)", r"\1", expression)
    try:
        text = re.sub(rf"rate\({SELECTOR}\[\w+\]\)", growth, text)
        text = re.sub(rf"(?<![\w.]){SELECTOR}(?!\w)", gauge, text)
    except Absent:
        return False
    if not re.fullmatch(r"(?:[-\d.e+*/<>=() ]|sum|max|and|or)+", text):
        raise ValueError(f"this is beyond alert_rules.py: {expression}: {text}")
    return bool(eval(text, {"__builtins__": {}}, {"sum": float, "max": float}))  # pylint: disable=eval-used
