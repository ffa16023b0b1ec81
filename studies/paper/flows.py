"""Weakly compressible SPH beside the flow without sound."""

from mesogen.claims import agrees, over_seeds

TITLE = "Weakly compressible or without sound"
FIGURE = "(none: why the study may use the cheaper flow)"
SWEEPS = ["flows"]
QUANTITIES = (("flow", "vorticity_rms", "vorticity rms, 1/s"), ("nematic", "mean_order", "mean order"),
              ("defects", "count_plus", "+1/2 defects"))


def write(section):
    runs = section.runs("flows")
    end = runs.value("time.end")
    found, seconds = {}, {}
    for flow in ("incompressible", "wcsph"):
        some = runs.where(physics__flow__type=flow)
        found[flow] = [some.estimate(observer, quantity, 0.5 * end) for observer, quantity, _ in QUANTITIES]
        costs = []
        for one in some.runs:
            with one.open() as run:
                costs.append(run.cost.cpu_seconds)
        seconds[flow] = over_seeds(costs)
    section.table(("flow", *(name for *_, name in QUANTITIES), "processor time of a run, s"),
                  [(flow, *(e.text() for e in found[flow]), seconds[flow].text(2)) for flow in found])
    spectral, particles = found["incompressible"][0], found["wcsph"][0]
    section.claim("Both flows give the same turbulence.", agrees(particles, spectral.mean, 0.06 * spectral.mean),
                  f"vorticity rms {particles.text()} by weakly compressible SPH, {spectral.text()} without sound, at "
                  f"{seconds['wcsph'].mean / seconds['incompressible'].mean:.0f} times the processor time",
                  "At 64 particles across its second-order error is some per cent.")
