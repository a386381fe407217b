"""Random machines as wide as the format, compared with an independent simulator and with themselves in other forms.

    python -m tests.random_machines --count N --seed S [--family crank] [--minimal]

A *design* is a mechanism file in which every number is a parameter; it is derived and compiled once. A *machine* is a
design with one set of numbers. Relations that only change numbers (mirror, rotate with gravity, change units, move the
origins of bodies, scale a unit of time) cost a run; those that change the file (permute and rename, split a body into
welded ones, the full formulation) cost a derivation. `oracle.py` simulates the same file in absolute coordinates and
shares no code with the generator or the engine.

Which knob (`draw.py`) makes which kind of fault that was found before (the first word is the family):

    contacts missed, dense output, phantom contacts    crank: `play` of 1 to 3 joints, rtol 1e-4 to 1e-10
    switches of driven chains, cams by coordinate       cam: `curve`, `follower`, events on free coordinates
    inertia small beside m L², zero                     graph, crank, swing: `inertia` of 1e-14 to 1e2 kg m²
    thin films                                          crank: `film` with c/R of 1/200 to 1/10,000
    switches by rounding                                graph: `drag` abs(u)*u, on bodies that joints hold
    rigid guides, rigid pins                            slide, crank: `rigid`
    events on velocities that stick                     slide: `stick`
    units or names in products                          every family: `renamed` by UNIT_NAMES
    change points                                       parallelogram
    follower on a cam's angle, curves                   cam: `curve` over the angle of a driven shaft
    names of files and of generated code                every family: `renamed` by CODE_NAMES
    symmetric starts, taylor                            swing: `pause_garbage_collector`, `horizontal`
    lost events of a surface that lets go               slide: `hill`
    unbounded second rates of drives                    graph, crank: `root`
    subnormal forces                                    slide, swing: `pulse`
    what was printed or run before                      every family: `batch`, `again`

Files of other programs have a search of their own (tests/exchange/test_import_mutated.py), and so have messages and
expressions (tests/fuzz).
"""
