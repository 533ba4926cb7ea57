"""Generates the messages from proto/ before anything is built. Everything else is in pyproject.toml."""
import pathlib
import sys

from setuptools import setup

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from make_messages import make_messages  # noqa: E402

make_messages()
setup()
