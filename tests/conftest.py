"""What every test shares: where the tree is, and how Hypothesis behaves."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from hypothesis import settings

pytest_plugins = ["pytester"]  # tests of the fixtures themselves

ROOT = Path(__file__).resolve().parent.parent

# No deadline: the machine that runs the tests may be busy. In CI the examples are the same each
# time, so that a red build is about the change; on a developer's machine they are new each time.
settings.register_profile("dev", deadline=None, print_blob=True)
settings.register_profile("ci", parent=settings.get_profile("dev"), derandomize=True)
settings.load_profile("ci" if os.environ.get("CI") else "dev")


@pytest.fixture(scope="session")
def root() -> Path:
    """The root of the source tree."""
    return ROOT
