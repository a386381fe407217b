"""Results as NetCDF 4 files, through xarray and h5netcdf.

A file holds every series under its own name, so that it can be read with any NetCDF tool, and as
attributes the kernel source and the diagnostics, so that gudgeon can read all of it back bit for
bit without a compiled library. It holds no date: the same run gives the same bytes.
"""

from __future__ import annotations

import os
import threading
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from gudgeon.diagnostics import Diagnostics
from gudgeon.errors import GudgeonError, InputError
from gudgeon.kernel_source import KernelSource
from gudgeon.results import IMPACT_DTYPE, Array, Result

try:
    import xarray
except ModuleNotFoundError as error:
    raise GudgeonError("NetCDF files and Datasets need xarray and h5netcdf: pip install 'gudgeon[xarray]'") from error

FORMAT = "gudgeon-result/1"
DIMENSIONS = ("time", "impact", "slot", "prepared")
IMPACT_UNITS = {"joint": "", "t_on": "s", "t_off": "s", "deltadot": "m/s", "F_peak": "N", "t_peak": "s"}
IMPACT_MEANINGS = {
    "joint": "index of the joint with play",
    "t_on": "onset of the contact",
    "t_off": "separation, NaN: still closed",
    "deltadot": "rate of the penetration at the onset",
    "F_peak": "largest force of the contact",
    "t_peak": "time of the largest force",
}


def dataset(run: Result) -> xarray.Dataset:
    """All series of `run` over `time`, its impacts over `impact`, its run-time numbers over `slot`."""
    series = {_variable(name): ("time", run[name], _about(run.unit(name), run.meaning(name))) for name in run.names}
    impacts = {
        f"impact.{name}": ("impact", np.ascontiguousarray(run.impacts[name]), _about(unit, IMPACT_MEANINGS[name]))
        for name, unit in IMPACT_UNITS.items()
    }
    numbers = {
        "parameters.prepared": ("prepared", run.p, _about("", "slots, then what was derived from them, SI")),
        "parameters.given": ("slot", run.given, _about("", "overridden slots, SI")),
        "parameters.is_given": ("slot", run.is_given.astype(np.int8), _about("", "1 where a slot was overridden")),
    }
    return xarray.Dataset(
        series | impacts | numbers,  # type: ignore[arg-type]
        coords={"time": ("time", run.t, _about("s", "time"))},
        attrs={
            "gudgeon": FORMAT,
            "title": run.source.title,
            "mechanism": run.source.mechanism,
            "scene": run.source.scene,
            "joints_with_play": " ".join(joint.name for joint in run.source.clearances),
            "diagnostics": run.diagnostics.to_json(),
            "source": run.source.to_json(),
        },
    )


def save(run: Result, path: str | os.PathLike[str]) -> None:
    """Write `run` to `path`; a run that is killed while writing leaves an older file as it was."""
    path = Path(path)
    aside = path.with_name(f".{path.name}.{os.getpid()}.{threading.get_ident()}.part")
    data = dataset(run)
    plain = {name: {"_FillValue": None} for name in data.variables}  # no masking: NaN is a value here
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        data.to_netcdf(aside, engine="h5netcdf", format="NETCDF4", encoding=plain)
        os.replace(aside, path)
    except OSError as error:
        raise GudgeonError(f"cannot write {path}: {error.strerror or error}") from error
    finally:
        with suppress(OSError):
            aside.unlink()


def read(path: str | os.PathLike[str]) -> Result:
    """The result in a file that `save` wrote; InputError for a missing file or one that is not a result."""
    if not Path(path).is_file():
        raise InputError(f"there is no file {os.fspath(path)}")
    try:
        with xarray.open_dataset(path, engine="h5netcdf", decode_cf=False) as file:
            data = file.load()
    except (OSError, ValueError) as error:
        raise InputError(f"{os.fspath(path)} is no NetCDF 4 file: {error}") from error
    found = data.attrs.get("gudgeon")
    if found != FORMAT:
        hint = f"expected the attribute gudgeon = {FORMAT!r}, found {found!r}"
        raise InputError(f"{os.fspath(path)} holds no result of gudgeon", hint=hint)
    return _result(data)


def _result(data: xarray.Dataset) -> Result:
    source = KernelSource.from_json(data.attrs["source"])
    stored = {str(name): variable.to_numpy() for name, variable in data.data_vars.items() if "time" in variable.dims}
    stored = {name.removeprefix("output."): _read_only(values) for name, values in stored.items()}
    samples = data.sizes["time"]
    impacts = np.empty(data.sizes["impact"], IMPACT_DTYPE)
    for name in IMPACT_UNITS:
        impacts[name] = data[f"impact.{name}"].to_numpy()
    motion = [_motion(source, stored, samples, order) for order in range(3)]
    return Result(
        compiled=None,
        source=source,
        p=data["parameters.prepared"].to_numpy(),
        given=data["parameters.given"].to_numpy(),
        is_given=data["parameters.is_given"].to_numpy().astype(bool),
        t=data["time"].to_numpy(),
        q=motion[0],
        v=motion[1],
        a=motion[2],
        state=_columns(stored, [f"{joint.name}.state" for joint in source.clearances], samples, np.int8),
        memory=_columns(stored, [f"{joint.name}.deltadot_minus" for joint in source.clearances], samples),
        work=_columns(stored, ["work.drives", "work.forces", "work.clearances"], samples),
        impacts=impacts,
        diagnostics=Diagnostics.from_json(data.attrs["diagnostics"]),
        stored=stored,
    )


def _motion(source: KernelSource, stored: dict[str, Array], samples: int, order: int) -> Array:
    """q, q̇ or q̈ (order 0, 1, 2) from the bodies' series."""
    from gudgeon.series import MOTION

    values = np.empty((samples, 3 * len(source.bodies)))
    for body in source.bodies:
        for axis, names in enumerate(MOTION):
            values[:, body.index + axis] = stored[f"{body.name}.{names[order]}"]
    return values


def _columns(stored: dict[str, Array], names: list[str], samples: int, dtype: Any = float) -> Array:
    values = np.empty((samples, len(names)), dtype)
    for column, name in enumerate(names):
        values[:, column] = stored[name]
    return values


def _variable(name: str) -> str:
    """An output may be called like a dimension; no other name can, for they all have a dot."""
    return f"output.{name}" if name in DIMENSIONS else name


def _read_only(values: Array) -> Array:
    values.flags.writeable = False
    return values


def _about(unit: str, meaning: str) -> dict[str, str]:
    return {"units": unit or "1", "long_name": meaning}
