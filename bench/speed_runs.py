"""Measurements of bench/speed.py: passes by the program `passes`, whole runs by the command, PySPH beside it.

Runs are measured by their traces: the median step, so that neither a sorting nor a neighbour on the machine counts,
and the least of the rounds. All that is compared takes turns.
"""

import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

PROJECT = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(PROJECT / "python"), str(PROJECT / "bench" / "peers")]

STEP = 5e-5  # s: within every limit of the paper's scene; what a step costs does not hang on it
SPACING = 0.02  # m, of the paper's scene
SKIPPED = 2  # steps at the beginning that are not counted


def tell(text):
    print(text, file=sys.stderr, flush=True)


def call(command, folder, **environment):
    done = subprocess.run([str(part) for part in command], cwd=folder, text=True, capture_output=True, check=False,
                          env={**os.environ, **environment})
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}:\n{done.stdout}{done.stderr}")
    return done.stdout


class Run:
    """Some steps of a run, as its trace tells of them; s."""

    def __init__(self, trace):
        events = [event for event in trace["traceEvents"] if event["ph"] == "X"]
        steps = [event for event in events if event["name"] == "framework: step"][SKIPPED:]
        self.step = 1e-6 * statistics.median(event["dur"] for event in steps)
        begin, end = steps[0]["ts"], steps[-1]["ts"] + steps[-1]["dur"]
        self.shares = {}  # by name, a step
        for event in events:
            if begin <= event["ts"] < end and event["name"] != "framework: step" and \
                    not event["name"].startswith(("observers.", "output: ")):
                self.shares[event["name"]] = self.shares.get(event["name"], 0.0) + 1e-6 * event["dur"] / len(steps)
        orderings = [event["dur"] for event in events if event["name"] == "framework: neighbours, sorting"]
        self.sorting = 1e-6 * max(orderings)


def instruction_set(mesogen):
    """What the plugin loader picks of the sets that plugins are built for."""
    return json.loads(call([mesogen, "plugin", "info", "wcsph", "--json"], None))["plugins"][0]["instruction_set"]


def paper_case():
    """The paper's scene without its observers: only what a step takes is of interest."""
    text = (PROJECT / "cases/active_turbulence/paper.toml").read_text(encoding="utf-8")
    return re.sub(r"\[observers\..*?(?=\n\[)", "", text, flags=re.DOTALL)


def run_paper(mesogen, across, steps, threads, settings):
    """Run of the paper's scene, the box as large as `across` particles along each edge ask for."""
    edge = across * SPACING
    with tempfile.TemporaryDirectory(prefix="mesogen-") as folder:
        folder = pathlib.Path(folder)
        (folder / "case.toml").write_text(paper_case(), encoding="utf-8")
        command = [mesogen, "run", "case.toml", "--quiet", "--output", "out", "--trace", "trace.json", "--threads",
                   threads]
        for setting in (f"domain.size=[{edge}, {edge}]", f"time.step={STEP}", f"time.end={(SKIPPED + steps) * STEP}",
                        *settings):
            command += ["--set", setting]
        call(command, folder)
        return Run(json.loads((folder / "trace.json").read_text(encoding="utf-8")))


def device_name(mesogen):
    """The CUDA device that runs compute on here; None if there is none."""
    with tempfile.TemporaryDirectory(prefix="mesogen-") as folder:
        case = pathlib.Path(folder) / "case.toml"
        case.write_text(paper_case(), encoding="utf-8")
        command = [mesogen, "run", "case.toml", "--output", "out"]
        for setting in ("run.device=auto", "domain.size=[1.0, 1.0]", f"time.step={STEP}", f"time.end={2 * STEP}"):
            command += ["--set", setting]
        done = subprocess.run([str(part) for part in command], cwd=folder, capture_output=True, text=True, check=True)
        found = re.search(r"computing on (?!the host)(.+)", done.stderr)
        return found.group(1) if found else None


def told_seconds(log):
    """Wall time of a step, s, and the number of steps, as a run's log tells them."""
    found = re.search(r"(\d+) steps in \S+ s: (\S+) ms a step", log)
    if found is None:
        sys.exit(f"the log of a run tells no time of a step:\n{log}")
    return 1e-3 * float(found[2]), int(found[1])


def device_seconds(mesogen, across, steps, settings):
    """Wall time of a step on the device, without a trace, which would wait for each piece of work; s. Two runs, so
    that what a run begins and ends with does not count."""
    def stepping(number):
        with tempfile.TemporaryDirectory(prefix="mesogen-") as folder:
            folder = pathlib.Path(folder)
            (folder / "case.toml").write_text(paper_case(), encoding="utf-8")
            command = [mesogen, "run", "case.toml", "--quiet", "--output", "out"]
            for setting in (f"domain.size=[{across * SPACING}, {across * SPACING}]", f"time.step={STEP}",
                            f"time.end={number * STEP}", "run.device=cuda", 'output.fields=["position"]', *settings):
                command += ["--set", setting]
            call(command, folder)
            seconds, done = told_seconds((folder / "out/run.log").read_text(encoding="utf-8"))
            return seconds * done
    few = max(2, steps // 10)
    for _ in range(3):
        seconds = (stepping(few + steps) - stepping(few)) / steps
        if seconds > 0.0:
            return seconds
    sys.exit(f"no time of a step can be told: three times {few + steps} steps took no longer than {few}")


def best_of(rounds, variants, measure):
    """variants: {name: arguments of measure}. All take turns; for each name the run with the shortest step, and of its
    sortings the shortest of all rounds."""
    best = {}
    for number in range(rounds):
        for name, arguments in variants.items():
            run = measure(*arguments)
            tell(f"  round {number + 1} of {rounds}: {name}: {1e3 * run.step:.3g} ms a step")
            sorting = min(run.sorting, best.get(name, run).sorting)
            if name not in best or run.step < best[name].step:
                best[name] = run
            best[name].sorting = sorting
    return best


def measure_passes(program, across, repetitions, seconds, only="."):
    """What Google Benchmark counted, the best of the repetitions: {name: counters}. `only`: a regular expression."""
    told = json.loads(call([program, f"--across={across}", "--benchmark_format=json", f"--benchmark_min_time={seconds}",
                            f"--benchmark_filter={only}",
                            f"--benchmark_repetitions={repetitions}", "--benchmark_enable_random_interleaving=true"],
                           None, OMP_NUM_THREADS="1"))
    best = {}
    for one in told["benchmarks"]:
        name = one["run_name"].removesuffix("/real_time")
        if one["run_type"] == "iteration" and (name not in best or one["real_time"] < best[name]["real_time"]):
            best[name] = one
    return best


def peer_seconds(mesogen, across, steps, name, arguments):
    """Processor time of a step of the Taylor-Green vortices, s."""
    import mesogen as results
    import taylor_green
    with tempfile.TemporaryDirectory(prefix="mesogen-") as folder:
        folder = pathlib.Path(folder)
        if name.startswith("PySPH"):
            command = [sys.executable, "-m", "pysph.examples.taylor_green", "--nx", across, "--re", "100", "--pfreq",
                       "1000000", "--perturb", "0.2", *arguments]
            command = [str(part) for part in command]
            taylor_green.processor_seconds([*command, "--max-steps", "1", "-d", "compiled"], folder)
            few = taylor_green.processor_seconds([*command, "--max-steps", "2", "-d", "few"], folder)
            many = taylor_green.processor_seconds([*command, "--max-steps", str(steps + 2), "-d", "many"], folder)
            return (many - few) / steps
        case = PROJECT / "cases/accuracy/taylor_green/case.toml"
        command = [mesogen, "run", case, "--quiet", "--threads", "1", "--output", "out"]
        step = 0.03 / across
        for setting in (f"particles.spacing={1.0 / across!r}", f"time.step={step}", f"time.end={steps * step}",
                        "particles.arrangement=jittered", "particles.jitter=0.1", *arguments):
            command += ["--set", setting]
        call(command, folder)
        with results.open(folder / "out") as run:
            return run.cost.cpu_seconds / run.cost.steps
