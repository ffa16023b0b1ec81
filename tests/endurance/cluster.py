"""A Slurm cluster of this one machine, with all its files in a folder: slurmctld, slurmd and munged of the caller."""

import getpass
import os
import shutil
import socket
import subprocess
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scancel")
CORES = 2

CONFIGURATION = """\
ClusterName=mesogen
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
SlurmdPort={daemon}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
SlurmUser={user}
SlurmdUser={user}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=1,batch_sched_delay=0
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
KillWait=10
SlurmdParameters=config_overrides
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def missing():
    """Programs that are not installed. The daemons of Debian are in /usr/sbin."""
    return [name for name in PROGRAMS if shutil.which(name, path=_path()) is None]


def _path():
    return os.environ.get("PATH", "") + ":/usr/sbin:/sbin"


class Cluster:
    """Use as a context manager. environment: of commands that are to find it."""

    def __init__(self, folder):
        self.folder = folder
        self.environment = {**os.environ, "SLURM_CONF": os.path.join(folder, "slurm.conf"), "PATH": _path()}
        self._daemons = []

    def __enter__(self):
        try:
            self._start()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for daemon in reversed(self._daemons):
            daemon.terminate()
        for daemon in reversed(self._daemons):
            try:
                daemon.wait(timeout=30)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()

    def _start(self):
        os.chmod(self.folder, 0o755)
        for name in ("state", "spool"):
            os.mkdir(os.path.join(self.folder, name))
        with open(os.path.join(self.folder, "munge.key"), "wb") as key:
            os.fchmod(key.fileno(), 0o600)
            key.write(os.urandom(1024))
        host = socket.gethostname().partition(".")[0]
        with open(self.environment["SLURM_CONF"], "w", encoding="utf-8") as file:
            file.write(CONFIGURATION.format(folder=self.folder, host=host, user=getpass.getuser(), cores=CORES,
                                            controller=_free_port(), daemon=_free_port()))
        here = self.folder + "/munge."
        self._daemon("munged", "--foreground", "--force", f"--socket={here}socket", f"--key-file={here}key",
                     f"--pid-file={here}pid", f"--log-file={here}log", f"--seed-file={here}seed")
        self._until(lambda: os.path.exists(here + "socket"), "munged did not make its socket")
        self._daemon("slurmctld", "-D", "-f", self.environment["SLURM_CONF"])
        self._daemon("slurmd", "-D", "-f", self.environment["SLURM_CONF"], "-N", host)
        self._until(lambda: self.ask("sinfo", "--noheader", "--format=%t").strip() == "idle",
                    "the node did not become idle")

    def _daemon(self, *words):
        with open(os.path.join(self.folder, words[0] + ".out"), "wb") as out:
            self._daemons.append(subprocess.Popen(words, env=self.environment, stdin=subprocess.DEVNULL, stdout=out,
                                                  stderr=subprocess.STDOUT))

    def _until(self, holds, otherwise, seconds=60):
        deadline = time.time() + seconds
        while not holds():
            if time.time() > deadline or any(daemon.poll() is not None for daemon in self._daemons):
                raise RuntimeError(f"{otherwise}:\n{self._logs()}")
            time.sleep(0.1)

    def _logs(self):
        text = ""
        for name in sorted(os.listdir(self.folder)):
            if name.endswith((".log", ".out")):
                with open(os.path.join(self.folder, name), encoding="utf-8", errors="replace") as file:
                    text += f"{name}:\n{file.read()[-1500:]}\n"
        return text

    def ask(self, *words):
        """What a command of Slurm says."""
        return subprocess.run(words, env=self.environment, capture_output=True, text=True, check=False).stdout

    def wait(self, seconds=300):
        """Until no job is in the queue."""
        self._until(lambda: not self.ask("squeue", "--noheader").strip(), "jobs did not end", seconds)


def _free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]
