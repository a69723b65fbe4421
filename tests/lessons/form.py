"""What a lesson's notebook must look like: thin, clean, and able to open anywhere."""

from __future__ import annotations

import ast
import copy
import warnings
from collections.abc import Iterator
from typing import Any

import nbformat

LONGEST_CELL = 15
EXERCISE = "exercise"
ALLOWED = {"ruledlab"}
ALLOWED_IN_EXERCISES = ALLOWED | {"numpy"}

NOT_THIN = {
    ast.FunctionDef: "def",
    ast.AsyncFunctionDef: "def",
    ast.ClassDef: "class",
    ast.Lambda: "lambda",
    ast.For: "for",
    ast.AsyncFor: "for",
    ast.While: "while",
    ast.comprehension: "for",
}


def faults(notebook: Any) -> list[str]:
    """Every breach of the rules, each with the cell's number."""
    found = list(_notebook_faults(notebook))
    for number, cell in enumerate(notebook.cells):
        found += [f"cell {number}: {fault}" for fault in _cell_faults(cell)]
    return found


def _notebook_faults(notebook: Any) -> Iterator[str]:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # it repairs ids and warns; they are looked at below
            nbformat.validate(copy.deepcopy(notebook))
    except nbformat.ValidationError as error:
        yield f"not valid: {str(error).splitlines()[0]}"
    if notebook.metadata.get("kernelspec", {}).get("name") != "python3":
        yield "no kernelspec python3: JupyterLab would ask for a kernel and run nothing"
    if notebook.metadata.get("widgets"):
        yield "has saved widget state"
    if not notebook.cells or notebook.cells[0].cell_type != "markdown":
        yield "does not begin with prose"
    ids = [cell.get("id") for cell in notebook.cells]
    if len(set(ids)) != len(ids):
        yield "cell ids repeat"


def _cell_faults(cell: Any) -> Iterator[str]:
    if not cell.get("id"):
        yield "no id"
    if cell.cell_type != "code":
        return
    if cell.get("outputs"):
        yield "has outputs"
    if cell.get("execution_count") is not None:
        yield "has an execution count"
    if len(cell.source.splitlines()) > LONGEST_CELL:
        yield f"is longer than {LONGEST_CELL} lines"
    yield from _code_faults(cell.source, EXERCISE in cell.metadata.get("tags", []))


def _code_faults(source: str, exercise: bool) -> Iterator[str]:
    try:
        tree = ast.parse(source)
    except SyntaxError as error:
        yield f"is not plain Python: {error.msg}"
        return
    for node in ast.walk(tree):
        if not exercise and type(node) in NOT_THIN:
            yield f"holds a {NOT_THIN[type(node)]}"
        for module in _imported(node):
            if module not in (ALLOWED_IN_EXERCISES if exercise else ALLOWED):
                yield f"imports {module}"


def _imported(node: ast.AST) -> list[str]:
    if isinstance(node, ast.Import):
        return [alias.name.partition(".")[0] for alias in node.names]
    if isinstance(node, ast.ImportFrom):
        return [(node.module or "").partition(".")[0]]
    return []
