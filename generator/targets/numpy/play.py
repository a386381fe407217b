"""A joint with play in Python: its laws, and the force that it exerts where it is."""

from __future__ import annotations

from gudgeon.generator.kernels.play import Pin
from gudgeon.generator.kernels.shared import SharedCall
from gudgeon.generator.targets.numpy.layout import assigned, code, docstring, indented
from gudgeon.generator.targets.numpy.printer import lines, name

_DRY = ("F_n", "F_along_t_dry", "M_i_dry", "M_j_dry")
CONTOUR = '''\
def contour(depth, order, angle):
    """Depths at equal angles, polynomials of degree five between them; of order 1 and 2 its derivatives."""
    count = len(depth)
    x = count*(angle/(2*np.pi) - np.floor(angle/(2*np.pi)))
    k = min(int(x), count - 1)
    a, b, c, d = (depth[(k + shift) % count] for shift in (-1, 0, 1, 2))
    s, slope, bend, rest = x - k, 0.5*(c - a), (a - b) + (c - b), 3*(c - b) + (a - d)
    if order == 0:
        return b + s*(slope + s*(0.5*bend + s*rest*(1.5 + s*(s - 2.5))))
    if order == 1:
        return count/(2*np.pi)*(slope + s*(bend + s*rest*(4.5 + s*(5*s - 10))))
    return (count/(2*np.pi))**2*(bend + s*rest*(9 + s*(20*s - 30)))'''
_FILM = ("F_r", "F_along_t_film", "M_i_film", "M_j_film")


def pin(own: Pin) -> str:
    """`clearance_<joint>`. A contact is closed where bodies overlap."""
    joint, clearance = own.clearance.label, own.clearance
    told = f"Force of joint {clearance.name} on the journal, from the eccentricity e and its rate."
    if clearance.wall:
        told = f"Force on corner {clearance.name}, from where it is, seen from the guide's point, and its rate."
    body = [*docstring([told])]
    body += lines(own.gap)
    if clearance.normal is None:
        body += [*_film(own), "F = F_r, F_along_t_film, M_i_film, M_j_film", "v_t = 0.0"]
    elif clearance.film is None:
        acts = "latch.closed" if clearance.rigid else "delta > 0"
        body += ["F, v_t = (0.0, 0.0, 0.0, 0.0), 0.0", f"if {acts}:", *indented(_dry(own))]
    else:
        body += [*_film(own), "F, v_t = (F_r, F_along_t_film, M_i_film, M_j_film), 0.0", "if delta > 0:"]
        body += indented([*_dry(own), *lines(own.share), "if share < 1:", f"    film = {', '.join(_FILM)}",
                          "    F = tuple(b + share*(a - b) for a, b in zip(F, film))"])  # fmt: skip
    place, first = ("e*n_x, e*n_y", "F[2] + along*F[0]") if clearance.wall else ("e_x, e_y", "F[2]")
    body += ["out.Fx, out.Fy = F[0]*n_x - F[1]*n_y, F[0]*n_y + F[1]*n_x", "out.F_n, out.F_t, out.v_t = F[0], F[1], v_t",
             f"out.ex, out.ey, out.e, out.deltadot, out.delta = {place}, e, deltadot, delta",
             f"out.moment_first, out.moment_second, out.power = {first}, F[3], 0.0"]  # fmt: skip
    turned = ", n_x, n_y" if clearance.wall else ", theta_i" if clearance.contour else ""
    head = f"def clearance_{joint}_(e_x, e_y, de_x, de_y, omega_i, omega_j{turned}, latch, p, out):"
    return "\n".join([*code(head), *indented(body)])


def _dry(own: Pin) -> list[str]:
    """At δ > 0; before an onset is accepted the impact velocity is that of the moment: ratio 1."""
    ratio, states = "unclipped" if own.clearance.clip_ratio else "ratio", range(len(own.clearance.states))
    given, told = [f"latch.state[{k}]" for k in states], [f"out.state_rate[{k}]" for k in states]
    pressed = "F_N" if own.pressing else "F_n"
    rubs = _call(own.laws["friction"], pressed, "v_t", *given) if "friction" in own.laws else "0.0"
    return [
        f"{ratio} = deltadot / latch.deltadot_minus if latch.closed else 1.0", *lines(own.before_dry),
        *assigned("F_n", _call(own.laws["normal"], "delta", "ratio", *map(name, own.given)), is_call=True),
        *lines(own.pressing),
        *assigned(", ".join(["F_along_t_dry", *told]), rubs, is_call=True),
        *lines(own.after_dry), f"F = -{pressed}, {', '.join(_DRY[1:])}",
    ]  # fmt: skip


def _film(own: Pin) -> list[str]:
    film = assigned("F_r, F_along_t_film, T0", _call(own.laws["film"], "epsilon", "w_n", "w_t"), is_call=True)
    return [*lines(own.before_film), *film, *lines(own.after_film)]


def _call(call: SharedCall, *given: str) -> str:
    return f"{call.kernel.name}({', '.join([*given, *map(name, call.numbers)])})"
