"""full_disk.py MESOGEN [N]: N runs (by default 50) that meet a full disk, at another place each.

Each gets a disk of which a filler leaves so much room; when that is used up the run must end with a clear error and all
that was written before must be readable. Then the filler goes, and `resume` must come to the numbers of an unbroken run,
bit for bit. The disk is a tmpfs where one may be mounted; elsewhere a limit on the size of files stands for it.
"""

import os
import resource
import shutil
import subprocess
import sys
import tempfile

import results

DISK = 16 << 20


def size_of(folder):
    return sum(os.path.getsize(os.path.join(where, name)) for where, _, names in os.walk(folder) for name in names)


class SmallDisk:
    """A tmpfs; every room is made by a filler."""

    def __init__(self, parent):
        self.folder = os.path.join(parent, "disk")
        os.mkdir(self.folder)
        self.works = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={DISK}", "tmpfs", self.folder],
                                    capture_output=True, check=False).returncode == 0

    def leave(self, room):
        with open(os.path.join(self.folder, "filler"), "wb") as file:
            os.posix_fallocate(file.fileno(), 0, DISK - room)
        return {}

    def free(self):
        os.remove(os.path.join(self.folder, "filler"))

    def clear(self):
        shutil.rmtree(os.path.join(self.folder, "run"), ignore_errors=True)

    def close(self):
        if self.works:
            subprocess.run(["umount", self.folder], check=True)


class SizeLimit(SmallDisk):
    """No file may become larger than a part of the room."""

    def __init__(self, parent):
        self.folder = os.path.join(parent, "limited")
        os.mkdir(self.folder)
        self.works = False

    def leave(self, room):
        return {"preexec_fn": lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (room // 4, resource.RLIM_INFINITY))}

    def free(self):
        pass


def main():
    mesogen, wanted = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 50
    with tempfile.TemporaryDirectory(prefix="mesogen-disk-") as parent:
        case = results.write_case(parent)
        unbroken = os.path.join(parent, "unbroken")
        subprocess.run([mesogen, "run", case, "--output", unbroken, "--quiet", "--threads", "1"], check=True)
        whole = results.read(unbroken)
        frames = len(whole["particles/fluid/position/step"])
        # While it is packed a run needs its results twice.
        most = 2 * size_of(unbroken)
        disk = SmallDisk(parent)
        if not disk.works:
            disk = SizeLimit(parent)
        print(f"unbroken: {frames} frames, at most {most} bytes; {type(disk).__name__}", flush=True)
        try:
            told, seen, again = {}, [], 0
            for n in range(wanted):
                disk.clear()
                folder = os.path.join(disk.folder, "run")
                how = disk.leave(int(most * (n + 0.5) / wanted) // 4096 * 4096)
                first = subprocess.run([mesogen, "run", case, "--output", folder, "--quiet", "--threads", "1"],
                                       capture_output=True, text=True, check=False, **how)
                if first.returncode != 0:
                    assert first.returncode in (1, 2), first
                    assert "No space left on device" in first.stderr or "File too large" in first.stderr, first.stderr
                    assert "make room, then `mesogen resume`" in first.stderr, first.stderr
                    what = os.path.basename(first.stderr.split("error: cannot ")[1].split(":")[0])
                    what = "a frame" if what[:6].isdigit() else what
                    told[what] = told.get(what, 0) + 1
                    seen.append(results.check_beginning(folder, whole) if os.path.exists(folder) else 0)
                disk.free()
                if os.path.exists(folder):
                    subprocess.run([mesogen, "resume", folder, "--quiet", "--threads", "1"], check=True)
                else:
                    again += 1
                    subprocess.run([mesogen, "run", case, "--output", folder, "--quiet", "--threads", "1"], check=True)
                results.check_complete(folder, whole)
        finally:
            disk.close()
        full = sum(told.values())
        assert full > 0.5 * wanted, f"only {full} of {wanted} runs met a full disk"
        print(f"{full} of {wanted} runs met a full disk: " + ", ".join(f"{what} {n}" for what, n in sorted(told.items())))
        print(f"frames there then: {min(seen)} to {max(seen)} of {frames}, each readable; {again} had no room for a folder")
        print("all complete when there was room: all numbers those of the unbroken run, bit for bit")


if __name__ == "__main__":
    main()
