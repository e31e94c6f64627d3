# SPDX-License-Identifier: BSD-2-Clause
"""Slurm only on this machine, without systemd and cgroups, in a folder of its own, on free ports,
for as long as a test runs."""
import contextlib
import os
import socket
import subprocess
import sys
import time
from pathlib import Path

START_SECONDS = 60

# Steps are bound to cores by task/affinity, as on a cluster. Requeued jobs wait for the lifetime of
# their credentials, 120 s by default.
CONFIGURATION = """\
ClusterName=squeal
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=10
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/affinity
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerParameters=sched_interval=2,bf_interval=2
MpiDefault=pmix
KillWait=30
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} RealMemory={megabytes} State=UNKNOWN
PartitionName=test Nodes=ALL Default=YES MaxTime=60 State=UP
"""


class Slurm:
    """A context: within it the commands of Slurm, called with `environment`, are those of this
    machine's cluster."""

    def __init__(self, folder):
        self.folder = Path(folder).absolute()
        self.environment = {**os.environ, "SLURM_CONF": str(self.folder / "slurm.conf")}
        self.daemons = []

    def __enter__(self):
        try:
            self._start()
        except BaseException:
            self.__exit__(*sys.exc_info())
            raise
        return self

    def __exit__(self, *_):
        with contextlib.suppress(subprocess.SubprocessError, OSError):
            jobs = self.call("squeue", "--noheader", "--format=%A").split()
            if jobs:
                self.call("scancel", "--signal=KILL", "--full", *set(jobs))
                self.call("scancel", *set(jobs))
            self.wait(lambda: not self.call("squeue", "--noheader"), 60, "the jobs to end")
        for daemon in reversed(self.daemons):
            daemon.terminate()
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()

    def call(self, *command, **how):
        """Returns what a command says."""
        run = subprocess.run(
            command, env=self.environment, text=True, capture_output=True, timeout=60, **how
        )
        if run.returncode != 0:
            raise subprocess.SubprocessError(
                f"{' '.join(map(str, command))}: exit code {run.returncode}: {run.stderr}"
            )
        return run.stdout.strip()

    def wait(self, done, seconds, what):
        end = time.monotonic() + seconds
        while not done():
            if time.monotonic() > end:
                raise TimeoutError(f"{what} was waited for {seconds} s in vain\n{self.logs()}")
            time.sleep(0.2)

    def logs(self):
        return "\n".join(
            f"--- {path.name}\n{path.read_text(errors='replace')[-3000:]}"
            for path in sorted(self.folder.glob("*.log"))
        )

    def _start(self):
        # Of a name with dots Slurm takes the part before the first.
        host = socket.gethostname().split(".")[0]
        controller_port, node_port = free_ports(2)
        memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") // 2**20
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        (self.folder / "slurm.conf").write_text(
            CONFIGURATION.format(
                host=host,
                folder=self.folder,
                controller_port=controller_port,
                node_port=node_port,
                cores=len(os.sched_getaffinity(0)),
                megabytes=memory * 9 // 10,
            )
        )
        # Its folders in /tmp are named after jobs, whose numbers another cluster on this machine
        # may have as well.
        (self.folder / "mpi.conf").write_text(f"PMIxCliTmpDirBase={self.folder}\n")
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        files = [
            f"--{name}-file={self.folder}/munge.{name}" for name in ("key", "log", "pid", "seed")
        ]
        self._daemon(
            "munged", "--foreground", "--force", f"--socket={self.folder}/munge.socket", *files
        )
        self.wait((self.folder / "munge.socket").exists, START_SECONDS, "the socket of munge")
        self._daemon("slurmctld", "-D", "-f", self.folder / "slurm.conf")
        self._daemon("slurmd", "-D", "-f", self.folder / "slurm.conf")
        self.wait(self._idle, START_SECONDS, "an idle node")

    def _daemon(self, program, *words):
        with (self.folder / f"{program}.out.log").open("w") as log:
            command = [f"/usr/sbin/{program}", *words]
            self.daemons.append(
                subprocess.Popen(
                    command, env=self.environment, stdout=log, stderr=log, stdin=subprocess.DEVNULL
                )
            )

    def _idle(self):
        for daemon in self.daemons:
            if daemon.poll() is not None:
                raise RuntimeError(
                    f"{daemon.args[0]} has ended with exit code {daemon.returncode}\n{self.logs()}"
                )
        try:
            return "idle" in self.call("sinfo", "--noheader", "--format=%T").split()
        except subprocess.SubprocessError:
            return False


def free_ports(count):
    """Returns numbers of ports that nobody listens on."""
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        return [one.getsockname()[1] for one in sockets]
