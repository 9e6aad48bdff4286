"""Reference cases of elastic bodies: their truths, their measures and the scenes that are measured."""

from __future__ import annotations

from . import beam_cases, body_cases

ELASTIC_CASES = (
    beam_cases.AxialBar,
    beam_cases.ClassicAxialBar,
    beam_cases.AxialBar3DCase,
    beam_cases.CantileverCase,
    beam_cases.LargeCantileverCase,
    beam_cases.Cantilever3DCase,
    beam_cases.PredictionCase,
    beam_cases.TurekHronCase,
    body_cases.BlockCase,
    body_cases.NeoHookeanBlockCase,
    body_cases.Block3DCase,
    body_cases.TwoDiscsCase,
    body_cases.SpinningDiscCase,
    body_cases.InvarianceCase,
    body_cases.FloatingBlockCase,
)
"""The cases in the order in which they are listed."""

__all__ = ["ELASTIC_CASES"]
