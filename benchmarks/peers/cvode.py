"""Integrate hand-written equations of the nine-bar press by CVODE (BDF), called from Python or from C.

There are three ways:

- `sundae`: scikit-sundae as its users call it, CVODE's own difference quotients for the Jacobian;
- `sundae_jacobian`: the same, differences of all 48 columns in C by one call;
- `in_c`: the libraries of scikit-sundae called directly, right-hand side and Jacobian never leave C. This is the
  strongest form of the peer: no Python between two outputs. With contact, CVODE's own root finding locates
  onsets and separations and the run restarts there (CVodeReInit), as `press.with_events` does.

Each takes (work, rtol) and returns (samples, cost, right-hand sides).
"""

from __future__ import annotations

import ctypes
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from cffi import FFI

from benchmarks.peers.press import OUTPUTS, Kernel, Run, Samples, Work, switch
from benchmarks.peers.press import work as press_work
from benchmarks.peers.timing import CallTimer

ATOL = 1e-3  # of rtol: lengths of a clearance are a thousandth of a metre
MAX_STEPS = 10**6
NONE = (np.empty(0), np.empty(0))
BDF, NORMAL, ROOT = 2, 1, 2
DECLARATIONS = """
int SUNContext_Create(int, void **);  int SUNContext_Free(void **);
void *N_VMake_Serial(SUNINDEX, double *, void *);  double *N_VGetArrayPointer(void *);  void N_VDestroy(void *);
void *SUNDenseMatrix(SUNINDEX, SUNINDEX, void *);  double *SUNDenseMatrix_Data(void *);  void SUNMatDestroy(void *);
void *SUNLinSol_Dense(void *, void *, void *);  int SUNLinSolFree(void *);
void *CVodeCreate(int, void *);  void CVodeFree(void **);
int CVodeInit(void *, int (*)(double, void *, void *, void *), double, void *);
int CVodeReInit(void *, double, void *);
int CVodeSStolerances(void *, double, double);
int CVodeSetUserData(void *, void *);  int CVodeSetMaxNumSteps(void *, long);
int CVodeSetLinearSolver(void *, void *, void *);
int CVodeSetJacFn(void *, int (*)(double, void *, void *, void *, void *, void *, void *, void *));
int CVodeRootInit(void *, int, int (*)(double, void *, double *, void *));
int CVodeSetRootDirection(void *, int *);  int CVodeGetRootInfo(void *, int *);
int CVode(void *, double, void *, double *, int);
"""


def sundae(work: Work, rtol: float, jacobian: bool = False) -> Run:
    """Run CVODE by scikit-sundae; without contact only. Raises FloatingPointError."""
    from sksundae.cvode import CVODE

    kernel = Kernel(work)

    def columns(t: float, y: np.ndarray, dy: np.ndarray, matrix: np.ndarray) -> None:
        """Write the Jacobian into `matrix`."""
        matrix[:] = kernel.jacobian(t, y)

    options: dict[str, Any] = {"jacfn": columns} if jacobian else {}
    timer = CallTimer()
    solver = CVODE(kernel.into, method="BDF", rtol=rtol, atol=ATOL * rtol, max_num_steps=MAX_STEPS, **options)
    kernel.peer.calls = 0
    with timer.engine:
        solution = solver.solve(work.times, kernel.y0)
    timer.stop()
    if not solution.success:
        raise FloatingPointError(solution.message)
    return Samples(np.ascontiguousarray(solution.y[:, :24]), NONE), timer, int(kernel.peer.calls)


def sundae_jacobian(work: Work, rtol: float) -> Run:
    """Run CVODE by scikit-sundae with the Jacobian from C."""
    return sundae(work, rtol, jacobian=True)


@cache
def sundials() -> tuple[FFI, dict[str, Any]]:
    """Return the functions of DECLARATIONS from scikit-sundae's shared libraries. Raises ImportError without it."""
    import sksundae.cvode

    home = Path(sksundae.__file__).parents[1] / "scikit_sundae.libs"
    ffi, found = FFI(), {}
    ffi.cdef(DECLARATIONS.replace("SUNINDEX", _index_type(Path(sksundae.__file__).parent)))
    opened = []
    for name in ("core", "nvecserial", "sunmatrixdense", "sunlinsoldense", "cvode"):
        files = sorted(home.glob(f"libsundials_{name}-*"))
        if not files:
            raise ImportError("scikit-sundae's wheel holds no libsundials here")
        ctypes.CDLL(str(files[0]), mode=ctypes.RTLD_GLOBAL)
        opened.append(ffi.dlopen(str(files[0])))
    for name in dir(opened[-1]):
        for library in opened:
            try:
                found[name] = getattr(library, name)
                break
            except AttributeError:
                continue
    return ffi, found


def _index_type(folder: Path) -> str:
    """Return the C type of SUNDIALS' indices in the wheel."""
    text = (folder / "py_config.pxi").read_text() if (folder / "py_config.pxi").exists() else "int64"
    return "int" if "int32" in text else "long"


class InC:
    """A CVODE integrator with its vectors and its dense matrix; `close` frees them."""

    def __init__(self, kernel: Kernel, rtol: float, own_jacobian: bool = True) -> None:
        """Create the integrator."""
        self.ffi, self.f = sundials()
        self.kernel, f, ffi = kernel, self.f, self.ffi
        self.context, self.y = ffi.new("void **"), kernel.y0.copy()
        f["SUNContext_Create"](0, self.context)
        context = self.context[0]
        self.vector = f["N_VMake_Serial"](48, ffi.from_buffer("double[]", self.y), context)
        self.matrix = f["SUNDenseMatrix"](48, 48, context)
        self.solver = f["SUNLinSol_Dense"](self.vector, self.matrix, context)
        self.memory = ffi.new("void **", f["CVodeCreate"](BDF, context))
        c, peer = kernel.c, kernel.peer
        peer.array = kernel.ffi.cast("double *(*)(void *)", int(ffi.cast("intptr_t", f["N_VGetArrayPointer"])))
        peer.matrix = kernel.ffi.cast("double *(*)(void *)", int(ffi.cast("intptr_t", f["SUNDenseMatrix_Data"])))
        rhs = self.pointer("int (*)(double, void *, void *, void *)", c, "peer_cvode_rhs")
        self.call("CVodeInit", rhs, 0.0, self.vector)
        self.call("CVodeSStolerances", rtol, ATOL * rtol)
        self.call("CVodeSetUserData", ffi.cast("void *", int(kernel.ffi.cast("intptr_t", peer))))
        self.call("CVodeSetMaxNumSteps", MAX_STEPS)
        self.call("CVodeSetLinearSolver", self.solver, self.matrix)
        if own_jacobian:
            kind = "int (*)(double, void *, void *, void *, void *, void *, void *, void *)"
            self.call("CVodeSetJacFn", self.pointer(kind, c, "peer_cvode_jacobian"))

    def pointer(self, kind: str, library: Any, name: str) -> Any:
        """Return a function of the press as a pointer of this cffi instance."""
        function = self.kernel.ffi.addressof(library, name)
        return self.ffi.cast(kind, int(self.kernel.ffi.cast("intptr_t", function)))

    def call(self, name: str, *arguments: Any) -> int:
        """Call a CVODE function. Raises FloatingPointError if it returns a negative status."""
        answer = int(self.f[name](self.memory[0], *arguments))
        if answer < 0:
            raise FloatingPointError(f"{name}: {answer}")
        return answer

    def locate(self, closed: list[bool]) -> None:
        """Set the directions of the next possible zero crossings."""
        self.call("CVodeSetRootDirection", self.ffi.new("int[2]", [-1 if c else 1 for c in closed]))

    def close(self) -> None:
        """Free all memory of C."""
        self.f["CVodeFree"](self.memory)
        self.f["SUNLinSolFree"](self.solver)
        self.f["SUNMatDestroy"](self.matrix)
        self.f["N_VDestroy"](self.vector)
        self.f["SUNContext_Free"](self.context)


def in_c(work: Work, rtol: float) -> Run:
    """Run CVODE completely in C, with its root finding."""
    kernel = Kernel(work)
    timer = CallTimer()
    solver = InC(kernel, rtol)
    try:
        kernel.peer.calls = 0
        with timer.engine:
            samples = _run(solver, work)
        return samples, timer.stop(), int(kernel.peer.calls)
    finally:
        solver.close()


def _run(solver: InC, work: Work) -> Samples:
    """Return the outputs, with a restart after every onset and separation."""
    kernel, closed, times = solver.kernel, [False, False], work.times
    onsets: tuple[list[float], list[float]] = ([], [])
    dry = work.press.film == 0.0
    if dry:
        gaps = solver.pointer("int (*)(double, void *, double *, void *)", kernel.c, "peer_cvode_gaps")
        solver.call("CVodeRootInit", 2, gaps)
        solver.locate(closed)
    kernel.peer.stored = [0.0, 0.0]
    rows, now, info = np.empty((len(times), 24)), solver.ffi.new("double *"), solver.ffi.new("int[2]")
    rows[0] = solver.y[:24]
    for row, t in enumerate(times[1:], 1):
        while solver.call("CVode", t, solver.vector, now, NORMAL) == ROOT:
            solver.call("CVodeGetRootInfo", info)
            for joint in (0, 1):
                if info[joint]:
                    switch(kernel, work, solver.y, joint, closed, onsets[joint], now[0])
            solver.call("CVodeReInit", now[0], solver.vector)
            solver.locate(closed)
        rows[row] = solver.y[:24]
    return Samples(rows, (np.array(onsets[0]), np.array(onsets[1])))


def sweep_works(c: np.ndarray, omega: np.ndarray) -> list[Work]:
    """Return a lubricated work for each pair of a clearance (m) and a speed (rad/s)."""
    plain = press_work("lubricated")
    return [
        replace(plain, press=replace(plain.press.at_speed(float(speed)), clearance=float(gap)))
        for gap, speed in zip(c, omega, strict=True)
    ]


def sweep(all_works: list[Work], rtol: float) -> tuple[np.ndarray, float, float]:
    """Run `in_c` on one work after the other, in one thread.

    Return the slider's y (runs, OUTPUTS), m, and the seconds of all runs: integration, whole calls.
    """
    y, seconds, call = np.empty((len(all_works), OUTPUTS)), 0.0, 0.0
    for k, work in enumerate(all_works):
        samples, timer, _ = in_c(work, rtol)
        y[k], seconds, call = samples.q[:, 22], seconds + timer.engine.seconds, call + timer.call
    return y, seconds, call
