"""A plan on a real Slurm: one node, whose daemons the test starts in a folder of its own, by scripts/slurm/penumbra.sbatch."""

import contextlib
import os
import pwd
import shutil
import signal
import socket
import subprocess
import time
import unittest

from pictures import scene
from support import PROGRAM, ROOT, TestCase, main, run

SCRIPT = ROOT / "scripts" / "slurm" / "penumbra.sbatch"
os.environ["PATH"] += ":/usr/sbin:/sbin"  # where Debian has the daemons

CONFIGURATION = """
ClusterName=penumbra
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
SlurmctldPort={controller}
SlurmdPort={node}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
ReturnToService=2
SchedulerType=sched/backfill
SchedulerParameters=bf_interval=1,sched_interval=1
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
MaxArraySize=1001
KillWait=5
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} RealMemory={memory} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(count):
    """Different ones, which nothing listens on."""
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(count)]
        for taken in sockets:
            taken.bind(("127.0.0.1", 0))
        return [taken.getsockname()[1] for taken in sockets]


class DaemonEnded(AssertionError):
    pass


class Cluster:
    """munged, slurmctld and slurmd, until `stop`."""

    def __init__(self, folder):
        for name in ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "sinfo", "scancel"):
            if not shutil.which(name):
                raise unittest.SkipTest(f"Slurm is not installed: there is no {name}")
        self.folder, self.daemons = folder, []
        folder.chmod(0o755)
        for name in ("state", "spool"):
            (folder / name).mkdir()
        key = folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        memory = int(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**20 * 0.9)
        controller, node = free_ports(2)
        text = CONFIGURATION.format(folder=folder, host=socket.gethostname().split(".")[0], cpus=os.cpu_count(),
                                    user=pwd.getpwuid(os.geteuid()).pw_name, memory=memory, controller=controller,
                                    node=node)
        (folder / "slurm.conf").write_text(text)
        (folder / "cgroup.conf").write_text("CgroupPlugin=cgroup/v1\n")
        self.environment = {**os.environ, "SLURM_CONF": str(folder / "slurm.conf")}
        self.environment.pop("SLURM_ARRAY_TASK_ID", None)

    def start(self):
        f = self.folder
        self.daemon("munged", "--foreground", "--force", f"--socket={f}/munge.socket", f"--key-file={f}/munge.key",
                    f"--pid-file={f}/munged.pid", f"--log-file={f}/munged.log", f"--seed-file={f}/munged.seed")
        self.wait(lambda: (f / "munge.socket").exists(), "munged")
        self.daemon("slurmctld", "-D", "-i", "-c")
        self.daemon("slurmd", "-D", "-c")
        self.wait(lambda: "idle" in self.command("sinfo", "-h", "-o", "%T"), "slurmctld and slurmd")

    def daemon(self, *command):
        log = open(self.folder / f"{command[0]}.out", "wb")
        # munged refuses folders that others may write to, as /tmp; --force makes a warning of it.
        self.daemons.append(subprocess.Popen(command, stdout=log, stderr=log, env=self.environment, cwd=self.folder))
        log.close()

    def wait(self, ready, what):
        ended, deadline = False, time.monotonic() + 120
        while time.monotonic() < deadline:
            if ready():
                return
            ended = any(daemon.poll() is not None for daemon in self.daemons)
            if ended:
                break
            time.sleep(0.1)
        logs = "\n".join(f"{path.name}: {path.read_text(errors='replace')[-600:]}"
                         for path in sorted(self.folder.glob("*.log")) + sorted(self.folder.glob("*.out")))
        if ended:
            raise DaemonEnded(f"{what}: a daemon ended: {logs}")
        raise AssertionError(f"{what} are not ready: {logs}")

    def command(self, *command):
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, timeout=60,
                              cwd=self.folder).stdout

    def finish(self, seconds=300):
        """Waits until no job is left."""
        end = time.monotonic() + seconds
        while self.command("squeue", "-h", "-o", "%i %T"):
            if time.monotonic() > end:
                raise AssertionError(self.command("squeue", "-o", "%i %T %r") + self.command("scontrol", "show", "job"))
            time.sleep(0.3)

    def stop(self):
        if all(daemon.poll() is None for daemon in self.daemons):
            self.command("scancel", "--full", f"--user={os.environ.get('USER', 'root')}")
        for daemon in reversed(self.daemons):
            daemon.send_signal(signal.SIGTERM)
        for daemon in reversed(self.daemons):
            try:
                daemon.wait(timeout=20)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()


class Slurm(TestCase):
    def setUp(self):
        super().setUp()
        try:
            self.start_cluster("slurm")
        except DaemonEnded:  # another program may have taken a port
            self.start_cluster("slurm_again")

    def start_cluster(self, name):
        (self.folder / name).mkdir()
        self.cluster = Cluster(self.folder / name)
        self.addCleanup(self.cluster.stop)
        self.cluster.start()

    def submit(self, *arguments, **environment):
        result = subprocess.run(["bash", SCRIPT, *map(str, arguments)], capture_output=True, text=True, timeout=60,
                                env={**self.cluster.environment, "PENUMBRA": PROGRAM, **environment}, cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def test_a_plan_is_drawn_by_an_array_job(self):
        plan = self.folder / "sweep.json"
        arguments = (scene("steps"), scene("posts"), "--technique", "hard,pcf,pcss", "--spp", "8", "--size", "64x36",
                     "--set", "cascades.size=256", "--no-cost", "--cache", self.folder / "cache")
        self.succeed("compare", *arguments, "-o", self.folder / "report")
        whole = {path.name: path.read_bytes() for path in (self.folder / "report").iterdir()}
        shutil.rmtree(self.folder / "report")
        self.succeed("plan", "compare", *arguments, "-o", plan)
        self.assertRegex(self.submit(plan, TASKS="4"), r"^Submitted batch job \d+\n$")
        self.cluster.finish()
        outputs = "".join(path.read_text() for path in self.folder.glob("slurm-*.out"))
        self.assertEqual(len(list(self.folder.glob("slurm-*.out"))), 3, "six items in shares of two")
        merged = run("merge", plan, "-o", self.folder / "report")
        self.assertEqual(merged.returncode, 0, merged.stdout + merged.stderr + outputs)
        self.assertEqual({path.name: path.read_bytes() for path in (self.folder / "report").iterdir()}, whole)

    def test_a_second_job_draws_what_the_first_left(self):
        plan = self.folder / "frames.json"
        self.succeed("plan", "render", scene("moving"), "--technique", "hard", "--set", "cascades.size=256", "--size",
                     "64x36", "--frames", "0:5", "--frames-per-item", "2", "-o", plan)
        # Slurm has no item for a task that is not in the array.
        self.submit(plan, "--array=0-1")
        self.cluster.finish()
        self.assertEqual(run("merge", plan, "-o", self.folder / "out").returncode, 1)
        self.submit(plan)
        self.cluster.finish()
        self.assertEqual(run("merge", plan, "-o", self.folder / "out").returncode, 0)
        self.assertEqual(len(list((self.folder / "out").iterdir())), 6)

    def test_memory_and_time_are_those_of_the_plan(self):
        plan = self.folder / "one.json"
        counts = dict(line.split() for line in
                      self.succeed("plan", "render", scene("steps"), "--size", "64x36", "-o", plan).stdout.splitlines())
        self.submit(plan, "--hold")
        asked = self.cluster.command("squeue", "-h", "-o", "%m %l").split()
        self.assertEqual(asked[0], f"{int(counts['memory_mib']) * 5 // 4}M")
        self.assertEqual(asked[1], f"{(int(counts['seconds']) * 3 + 119) // 60}:00")


if __name__ == "__main__":
    main()
