"""Pictures of responses and probabilities, by matplotlib where it is installed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from ._objects import Fragility, Response

#: Colours of the overturning structure, of the limit state, of the ground and of marks.
OVERTURNING, FAILURE, GROUND, MARK = "#cf5412", "#0069a8", "#5b6770", "#22303c"


def axes(rows: int = 1, **options: Any) -> Any:
    """New axes, below each other, which share time or intensity."""
    try:
        from matplotlib import pyplot
    except ImportError as missing:
        raise ImportError("matplotlib is not installed: pip install matplotlib") from missing
    return pyplot.subplots(rows, sharex=True, layout="constrained", **options)[1]


def response(of: Response, on: Any = None) -> Any:
    """Rotation over slenderness with its events, above the acceleration of the ground."""
    if on is None:
        on = axes(2, figsize=(7.0, 4.2), height_ratios=[2, 1])
    rotation, ground = on
    rotation.axhline(0.0, color=GROUND, lw=0.6)
    for limit in (-1.0, 1.0):
        rotation.axhline(limit, color=GROUND, lw=0.8, ls=":")
    rotation.plot(of.time, of.theta_over_alpha, color=OVERTURNING if of.outcome == "overturning" else MARK, lw=1.2)
    for event, marker in (("uplift", "^"), ("impact", "|"), ("overturn", "X")):
        at = [time for time, name in of.events if name == event]
        if at:
            theta = np.interp(at, of.time, of.theta_over_alpha)
            rotation.plot(at, theta, marker, color=MARK, ms=7, label=event)
    if of.events:
        rotation.legend(frameon=False, fontsize="small", ncols=3, loc="upper right")
    if of.outcome == "overturning":
        # It falls on; what comes before shows only on this scale.
        rotation.set_ylim(-1.6, 1.6)
    rotation.set_ylabel("rotation / α")
    rotation.set_title(f"{of!r}", fontsize="medium", loc="left")
    ground.plot(of.time, of.ground_acceleration, color=GROUND, lw=0.8)
    ground.set_ylabel("ground, m/s²")
    ground.set_xlabel("time, s")
    return on


def fragility(of: Fragility, on: Any = None) -> Any:
    """The probabilities of overturning and of failure over the peak, each with its limits as a band."""
    if on is None:
        on = axes(figsize=(6.0, 3.8))
    for name, words, color in (
        ("p_overturning", "overturns", OVERTURNING),
        ("p_failure", "overturns, or rocks too far", FAILURE),
    ):
        p, low, high = (getattr(of, name + end) for end in ("", "_low", "_high"))
        on.fill_between(of.intensity, low, high, color=color, alpha=0.18, lw=0)
        on.plot(of.intensity, p, color=color, lw=1.6, label=words)
    on.set(xlabel=of.label, ylabel="probability", ylim=(0.0, 1.0))
    on.legend(frameon=False)
    return on
