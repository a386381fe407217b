"""Results as gudgeon-result/1 stored them: every array at the root, impacts, events and parameters too."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import h5py
import numpy as np

from gudgeon.results.files.netcdf import EVENTS, IMPACTS
from gudgeon.results.results import Result

DIMENSIONS = ("time", "impact", "event", "slot", "prepared")
NO_VARIABLE = "This is a netCDF dimension but not a netCDF variable.%10d"


def save_old(run: Result, path: Path) -> None:
    """Write `run` in the layout of before the groups."""
    arrays: dict[str, tuple[str, Any]] = {
        f"{'output.' * (name in DIMENSIONS)}{name}": ("time", run[name]) for name in run.names
    }
    arrays |= {f"impact.{name}": ("impact", run.impacts[name]) for name in IMPACTS}
    arrays |= {f"event.{name}": ("event", run.events[name]) for name in EVENTS}
    arrays["parameters.prepared"] = "prepared", run.p
    arrays["parameters.given"] = "slot", run.given
    arrays["parameters.is_given"] = "slot", run.is_given.astype(np.int8)
    sizes = (len(run.t), len(run.impacts), len(run.events), len(run.given), len(run.p))
    with h5py.File(path, "w", track_order=True) as file:
        for index, (name, size) in enumerate(zip(DIMENSIONS, sizes, strict=True)):
            scale = file.create_dataset(name, data=np.zeros(size, ">f4") if index else run.t)
            scale.make_scale(NO_VARIABLE % size if index else name)
            scale.attrs["_Netcdf4Dimid"] = np.int32(index)
        for name, (dimension, values) in arrays.items():
            stored = file.create_dataset(name, data=np.ascontiguousarray(values))
            stored.dims[0].attach_scale(file[dimension])
            stored.attrs["units"], stored.attrs["long_name"] = "1", name
        file.attrs["gudgeon"] = "gudgeon-result/1"
        for name in ("title", "mechanism", "scene"):
            file.attrs[name] = getattr(run.source, name)
        file.attrs["joints_with_play"] = " ".join(joint.name for joint in run.source.clearances)
        file.attrs["events"] = " ".join(event.name for event in run.source.events)
        file.attrs["diagnostics"] = run.diagnostics.to_json()
        later = ("overrides",)  # no key of the source then
        source = {key: value for key, value in json.loads(run.source.to_json()).items() if key not in later}
        file.attrs["source"] = json.dumps(source, ensure_ascii=False, indent=1)
