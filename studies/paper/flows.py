"""Weakly compressible SPH beside the flow without sound."""

from mesogen.study import agrees, ratio

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
        seconds[flow] = some.processor_seconds()
    section.table(("flow", *(name for *_, name in QUANTITIES), "processor time of a run, s"),
                  [(flow, *(e.text() for e in found[flow]), seconds[flow].text(2)) for flow in found])
    spectral, particles = found["incompressible"][0], found["wcsph"][0]
    section.claim("Both flows give the same turbulence.", agrees(ratio(particles, spectral), 1.0, 0.06),
                  f"vorticity rms {particles.text()} by weakly compressible SPH, {spectral.text()} without sound, at "
                  f"{seconds['wcsph'].mean / seconds['incompressible'].mean:.0f} times the processor time",
                  f"Particles {runs.value('particles.spacing'):.2g} m apart; the error of weakly compressible SPH is of second "
                  "order in that: 9 % at 0.16 m.")
