"""kill.py MESOGEN [N]: SIGKILLs runs N times (by default 200) at random moments and resumes each until it is complete.

After each kill all frames and samples must be readable and be those of an unbroken run; at the end all numbers must be
the same, bit for bit. Threads change from one try to the next.
"""

import os
import random
import shutil
import subprocess
import sys
import tempfile
import time

import results


def main():
    mesogen, wanted = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 200
    chance = random.Random(20)
    with tempfile.TemporaryDirectory(prefix="mesogen-kill-") as parent:
        case = results.write_case(parent)
        begun = time.time()
        subprocess.run([mesogen, "run", case, "--output", os.path.join(parent, "unbroken"), "--quiet", "--threads", "1"],
                       check=True)
        duration = time.time() - begun
        whole = results.read(os.path.join(parent, "unbroken"))
        frames = len(whole["particles/fluid/position/step"])
        print(f"unbroken: {duration:.1f} s, {frames} frames, step {whole['particles/fluid/position/step'][-1]}", flush=True)

        kills = runs = unstarted = writing = 0
        seen = []
        while kills < wanted:
            folder = os.path.join(parent, "run")
            shutil.rmtree(folder, ignore_errors=True)
            runs += 1
            tries = 0
            while True:
                verb = ["resume", folder] if os.path.exists(folder) else ["run", case, "--output", folder]
                tries += 1
                # Some tens of milliseconds to start, then anywhere; longer with each try, so that every run ends.
                delay = chance.uniform(0.0, duration * 0.25 * (1.0 + 0.25 * tries))
                process = subprocess.Popen([mesogen, *verb, "--quiet", "--threads", str(chance.randint(1, 3))],
                                           stderr=subprocess.PIPE, text=True)
                try:
                    _, told = process.communicate(timeout=delay)
                    assert process.returncode == 0, told
                    break
                except subprocess.TimeoutExpired:
                    process.kill()
                    process.communicate()
                    if process.returncode == 0:
                        break
                kills += 1
                if not os.path.exists(folder):
                    unstarted += 1
                    continue
                seen.append(results.check_beginning(folder, whole))
                if os.path.exists(os.path.join(folder, "results.h5.tmp")):
                    writing += 1
            results.check_complete(folder, whole)
        print(f"{kills} kills in {runs} runs: all complete, all numbers those of the unbroken run, bit for bit")
        print(f"frames there after a kill: {min(seen)} to {max(seen)} of {frames}, each readable; {unstarted} kills before "
              f"the folder was made, {writing} while results.h5 was written")


if __name__ == "__main__":
    main()
