"""Reference cases of elastic bodies: their truths, their measures and the scenes that are measured."""

from __future__ import annotations

from .cases import ELASTIC_CASES

__all__ = ["ELASTIC_CASES"]
