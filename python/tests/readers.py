# SPDX-License-Identifier: MIT
"""Programs that are not of this project, and read and write files of meshes."""

from __future__ import annotations

import importlib
import os
from typing import Any

import pytest


def reader(name: str) -> Any:
    """Import a reader. Without it the tests are skipped; in CI that is a failure."""
    try:
        return importlib.import_module(name)
    except (ImportError, OSError) as error:  # the latter where libraries of the system are missing
        if os.environ.get("CI") == "true":
            raise
        pytest.skip(f"{name} is missing: {error}", allow_module_level=True)
