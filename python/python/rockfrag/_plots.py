"""Pictures of responses and probabilities, by matplotlib where it is installed."""

from __future__ import annotations

import html
import io
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ._arrays import Floats, Response

#: Colours of the overturning structure, of the limit state, of the ground and of marks.
OVERTURNING, FAILURE, GROUND, MARK = "#b3342c", "#d98f2b", "#5b6770", "#22303c"


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
            rotation.plot(at, theta, marker, color=MARK, ms=7, label=f"{event} ({len(at)})" if event == "impact" else event)
    if of.events:
        rotation.legend(frameon=False, fontsize="small", ncols=3, loc="upper right")
    if of.outcome == "overturning":
        # It falls on; what comes before shows only on this scale.
        rotation.set_ylim(-1.6, 1.6)
    rotation.set_ylabel("rotation / slenderness")
    rotation.set_title(f"{of!r}", fontsize="medium", loc="left")
    ground.plot(of.time, of.ground_acceleration, color=GROUND, lw=0.8)
    ground.set_ylabel("ground, m/s²")
    ground.set_xlabel("time, s")
    return on


def curves(
    x: Floats, label: str, named: Sequence[tuple[str, Floats, Floats, Floats]], on: Any = None
) -> Any:
    """Probabilities over an intensity, each with its limits as a band."""
    if on is None:
        on = axes(figsize=(6.0, 3.8))
    order = np.argsort(x)
    for (name, p, low, high), color in zip(named, (OVERTURNING, FAILURE, MARK), strict=False):
        on.fill_between(x[order], low[order], high[order], color=color, alpha=0.18, lw=0)
        on.plot(x[order], p[order], color=color, lw=1.6, label=name)
    on.set_xlabel(label)
    on.set_ylabel("probability")
    on.set_ylim(0.0, 1.0)
    on.legend(frameon=False)
    return on


#: The limit states, in words.
STATES = {"p_rocking": "rocks", "p_failure": "overturns, or rocks too far", "p_overturning": "overturns"}


def fragility(x: Floats, label: str, of: Any, on: Any = None) -> Any:
    """The probabilities of overturning and of failure, with their limits."""
    ends = ("", "_low", "_high")
    states = ("p_overturning", "p_failure")
    named: Any = [(STATES[p], *(np.ravel(getattr(of, p + end)) for end in ends)) for p in states]
    return curves(x, label, named, on)


def line(of: Any, name: str) -> str:
    """A probability, or the least and the largest of several, with the outermost limits."""
    p, low, high = (np.ravel(getattr(of, name + end, np.nan)) for end in ("", "_low", "_high"))
    p, low, high = p[~np.isnan(p)], low[~np.isnan(low)], high[~np.isnan(high)]
    ends = " to ".join(sorted({f"{p.min():.3g}", f"{p.max():.3g}"}, key=float)) if p.size else "none"
    limits = f"  (95 % limits {low.min():.3g} to {high.max():.3g})" if low.size else ""
    return f"{name:13} {STATES[name]:<27} {ends}{limits}"


class Shown:
    """What a notebook shows as text, and below it as a picture where there is one and matplotlib is installed."""

    plot: Any

    def _repr_html_(self) -> str:
        shown = f"<pre>{html.escape(repr(self))}</pre>"
        try:
            drawn = self.plot()
        except (ImportError, ValueError):
            return shown
        from matplotlib import pyplot

        figure, svg = np.ravel(drawn)[0].figure, io.StringIO()
        figure.savefig(svg, format="svg")
        pyplot.close(figure)
        return shown + svg.getvalue()[svg.getvalue().index("<svg") :]
