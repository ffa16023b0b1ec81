"""What the device is: the driver, the card, its memory, how fast it copies and how long a start of a kernel takes."""

import json
import shutil
import subprocess

from place import EMULATED, add_libraries_of_this_machine
from speed_tables import number_text
from verdicts import FAIL, PASS, NotRun

NO_DEVICE = 77  # exit code of device_look


def look(place, out, report):
    """Runs device_look and keeps what it tells in OUT/look.json."""
    for name in add_libraries_of_this_machine(place.kit):
        report.line("libraries", FAIL, f"{name} is missing: the kit has no room for it, and it is neither in a CUDA "
                                       "toolkit of this machine (/usr/local/cuda*, CUDA_HOME) nor in LD_LIBRARY_PATH. "
                                       f"Install the CUDA toolkit that has {name}, or add its folder to "
                                       "LD_LIBRARY_PATH")
    if not EMULATED and shutil.which("nvidia-smi"):
        print(subprocess.run(["nvidia-smi"], capture_output=True, text=True, check=False).stdout)
    done = subprocess.run([str(place.program("device_look"))], capture_output=True, text=True, check=False)
    print(done.stdout + done.stderr, flush=True)
    if done.returncode not in (0, NO_DEVICE):
        report.line("the device", FAIL, f"device_look ended with exit code {done.returncode}: {done.stderr.strip()}")
        return
    told = json.loads(done.stdout)
    (out / "look.json").write_text(json.dumps(told, indent=2) + "\n", encoding="utf-8")
    if "problem" in told:
        report.line("the device", FAIL, f"there is no CUDA device here ({told['problem']}): run this on a machine with "
                                        "an NVIDIA GPU, or let the host play the device by MESOGEN_CUDA_ON_HOST=1")
        return
    if EMULATED:
        report.line("the device", PASS, f"{told['device']}; {gigabytes(told, 'on_device')} copied", **numbers(told))
        return
    free, total = (1e-9 * told[f"memory_{which}_bytes"] for which in ("free", "total"))
    report.line("the device", PASS, f"{told['device']}, compute capability {told['compute_capability']}, a driver for "
                                    f"CUDA {version(told['driver_cuda'])}, built with {version(told['runtime_cuda'])}, "
                                    f"{free:.1f} of {total:.1f} GB free", **numbers(told))
    report.line("copies", PASS, f"{gigabytes(told, 'to_device')} to the device, {gigabytes(told, 'from_device')} from "
                                f"it, {gigabytes(told, 'on_device')} read and written on it")
    report.line("starts of kernels", PASS, f"{told['launch_us']:.2f} us each in a row, "
                                           f"{told['launch_and_wait_us']:.2f} us with a wait")
    apart, graph, unchanged = (told[f"step_of_30_kernels{how}_us"]
                               for how in ("", "_in_a_graph", "_in_an_unchanged_graph"))
    report.line("30 kernels and a wait", PASS,
                f"{apart:.0f} us started one by one, {graph:.0f} us in a CUDA graph that is brought up to date, "
                f"{unchanged:.0f} us in one that is not")


def gigabytes(told, which):
    return f"{number_text(1e-9 * told[which + '_bytes_per_second'])} GB/s"


def version(number):
    """13010 -> "13.1"."""
    return f"{int(number) // 1000}.{int(number) % 1000 // 10}"


def numbers(told):
    return {name: value for name, value in told.items() if isinstance(value, (int, float)) and name != "emulated"}


def seen(out):
    """What the stage `look` told; nothing if it did not run."""
    file = out / "look.json"
    return json.loads(file.read_text(encoding="utf-8")) if file.exists() else {}


def need_device(out):
    """Raises NotRun where the stage `look` found that there is no device."""
    problem = seen(out).get("problem")
    if problem and not EMULATED:
        raise NotRun(f"there is no CUDA device here ({problem})")
