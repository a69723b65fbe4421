"""What is installed, pinned and cited agrees with what is declared."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest
import yaml
from packaging.requirements import Requirement

import ruledlab


@pytest.fixture(scope="module")
def project(root: Path) -> dict[str, Any]:
    return tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["project"]


@pytest.fixture(scope="module")
def pins(root: Path) -> dict[str, str]:
    lines = (root / "binder" / "requirements.txt").read_text(encoding="utf-8").splitlines()
    wanted = [line for line in lines if line and not line.startswith(("#", "."))]
    assert all("==" in line for line in wanted)
    return dict(line.split("==") for line in wanted)


def test_binder_pins_every_direct_dependency_within_its_range(
    project: dict[str, Any], pins: dict[str, str]
) -> None:
    for text in [*project["dependencies"], *project["optional-dependencies"]["lab"]]:
        wanted = Requirement(text)
        assert pins[wanted.name] in wanted.specifier, text


def test_binder_installs_this_checkout_with_the_lab(root: Path) -> None:
    text = (root / "binder" / "requirements.txt").read_text(encoding="utf-8")
    assert text.splitlines()[-1] == ".[lab]"
    assert "://" not in text  # no index, no other place
    assert "--" not in text


def test_binders_python_is_new_enough(root: Path, project: dict[str, Any]) -> None:
    runtime = (root / "binder" / "runtime.txt").read_text(encoding="utf-8").strip()
    assert runtime.startswith("python-")
    python = Requirement("python" + project["requires-python"])
    assert runtime.removeprefix("python-") in python.specifier


def test_the_citation_is_of_this_version(root: Path, project: dict[str, Any]) -> None:
    citation = yaml.safe_load((root / "CITATION.cff").read_text(encoding="utf-8"))
    assert str(citation["version"]) == ruledlab.__version__
    assert citation["license"] == project["license"]
    (paper,) = citation["references"]
    assert paper["authors"][0]["family-names"] == "Taş"


def test_the_changelog_has_this_version(root: Path) -> None:
    text = (root / "CHANGELOG.md").read_text(encoding="utf-8")
    assert f"\n## [{ruledlab.__version__}]" in text
    assert "\n## [Unreleased]" in text


def test_the_readme_names_the_commands_that_exist(root: Path) -> None:
    readme = (root / "README.md").read_text(encoding="utf-8")
    makefile = (root / "Makefile").read_text(encoding="utf-8")
    for target in ("lab", "test"):
        assert f"make {target}" in readme
        assert f"\n{target}:" in makefile
    for command in ("lab", "lessons", "check"):
        assert f"ruledlab {command}" in readme
