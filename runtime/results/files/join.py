"""Results of several scenes side by side: one Dataset with the coordinate `scene`."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from gudgeon.errors import BadValueError, GudgeonError
from gudgeon.language.wanted import listed
from gudgeon.results.batch import Batch
from gudgeon.results.results import Result

if TYPE_CHECKING:
    import xarray


def join(runs: Iterable[Result | Batch]) -> xarray.Dataset:
    """Series over `scene` and `time` (of batches over `run` too) of results of scenes of one mechanism.

    What a scene does not have is NaN, and so are times that only others have. BadValueError for two results of one
    scene: those are a batch.
    """
    kinds: Any = (Result, Batch)
    found: list[Result | Batch] = listed(runs, "runs", kinds, "a list of results, one a scene")
    scenes = [run.source.scene for run in found]
    if not scenes or len({*map(type, found)}) > 1:
        raise BadValueError("join: expected results, or batches, of one scene or more")
    if twice := [scene for scene in scenes if scenes.count(scene) > 1]:
        hint = "runs of one scene with other numbers are a batch: simulate_many"
        raise BadValueError(f"join: two results are of the scene {twice[0]!r}", hint=hint)
    if len(names := list(dict.fromkeys(run.source.mechanism for run in found))) > 1:
        raise BadValueError(f"join: {names[0]!r} and {names[1]!r} are two mechanisms", hint="join scenes of one")
    try:
        import pandas
        import xarray
    except ModuleNotFoundError as error:
        raise GudgeonError("Datasets need xarray: pip install 'gudgeon[xarray]'") from error
    _check_times(found)
    parts, along = [run.to_xarray() for run in found], pandas.Index(scenes, name="scene")
    attributes = {"mechanism": names[0], "title": found[0].source.title}
    joined: xarray.Dataset = xarray.concat(
        parts, along, data_vars="all", coords="different", compat="equals", join="outer", combine_attrs="drop_conflicts"
    )
    return joined.assign_attrs(attributes)


def _check_times(found: list[Result | Batch]) -> None:
    """BadValueError for batches whose samples do not lie side by side: runs with times of their own."""
    forms = {run.t.shape[1:] for run in found}
    if len(forms) > 1:
        own = next(run for run in found if run.t.ndim == 2)
        raise BadValueError(
            f"join: the runs of scene {own.source.scene!r} have times of their own, and not as many as those of others",
            hint="join batches over common times, or of as many samples each",
        )
