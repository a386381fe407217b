"""Write the mechanism file of N four-bar linkages, problem A02 of the IFToMM library, for scaling studies.

`python -m gudgeon.mechanisms.n_four_bar 40 > n_four_bar_40.yaml`; the shipped n_four_bar.yaml is N = 2.
"""

from __future__ import annotations

import sys

_TEXT = """\
# N coupled four-bar linkages, N = {n}: problem A02 of the IFToMM library of computational benchmark
# problems for multibody dynamics. {links} uniform bars of 1 m and 1 kg (I = m L^2/12), distance of the pivots 1 m. The
# cranks are vertical initially, and the tip of the first one moves at 1 m/s. When the cranks lie on the ground line,
# the linkage passes a singular position (bifurcation), in which each parallelogram can change its branch.
# Written by n_four_bar.py for any N.
format: gudgeon/1
name: {name}
title: N-four-bar, N = {n} (IFToMM A02)
gravity: [0, -9.81 m/s^2]

parameters:
  length: 1 m
  mass: 1 kg
  inertia: mass * length**2 / 12

bodies:
{bodies}

ground: {{{ground}}}

freedoms: 1

joints:
{joints}

start:
  set: {{crank0.theta: 90 deg}}
  guess: {{{guess}}}
  rates: {{crank0.omega: -1 rad/s}}

outputs:
  x: crank0.head.x
  y: crank0.head.y
"""


def text(n: int) -> str:
    """Return the text of the file for n squares: 2n + 1 bars, n + 1 of them cranks. Raises ValueError unless n ≥ 1."""
    if n < 1:
        raise ValueError(f"N is {n}: expected 1 or more")
    cranks, couplers = [f"crank{i}" for i in range(n + 1)], [f"coupler{i}" for i in range(1, n + 1)]
    joints = [f"O{i}: {{revolute: [ground.O{i}, {crank}.tail]}}" for i, crank in enumerate(cranks)]
    for i, coupler in enumerate(couplers):
        joints.append(f"A{i}: {{revolute: [{cranks[i]}.head, {coupler}.tail]}}")
        joints.append(f"B{i + 1}: {{revolute: [{coupler}.head, {cranks[i + 1]}.head]}}")
    pivots = ["O0: [0, 0]", "O1: [length, 0]", *(f"O{i}: [{i} * length, 0]" for i in range(2, n + 1))]
    guess = [f"{crank}.theta: 90 deg" for crank in cranks[1:]] + [f"{coupler}.theta: 0" for coupler in couplers]
    return _TEXT.format(
        n=n,
        name="n_four_bar" if n == 2 else f"n_four_bar_{n}",
        links=2 * n + 1,
        bodies="\n".join(f"  {bar}: {{length: length, mass: mass, inertia: inertia}}" for bar in cranks + couplers),
        ground=", ".join(pivots),
        joints="\n".join(f"  {joint}" for joint in joints),
        guess=", ".join(guess),
    )


if __name__ == "__main__":
    print(text(int(sys.argv[1]) if len(sys.argv) > 1 else 2), end="")
