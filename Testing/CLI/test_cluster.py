# SPDX-License-Identifier: BSD-3-Clause
"""The recipes of Utilities/Cluster under Slurm, Open MPI and GNU parallel, which the test starts and ends itself, on this machine alone."""
import os
import re
import shutil
import signal
import socket
import subprocess
import time
import unittest

from harness import DGTK, main
from many_runs import ManyCase

SOURCE = os.environ["DGTK_SOURCE"]
DEMO = os.path.join(SOURCE, "Data", "Scenes", "demo.json")
OPTIONS = ("--layers", "depth,objects", "--size", "48x36")
CONF = """ClusterName=dgtk
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmctldPort={port}
SlurmdPort={node_port}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
MpiDefault=none
ReturnToService=2
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SchedulerParameters=batch_sched_delay=0
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
MaxArraySize=100001
MinJobAge=300
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
NodeName={host} NodeAddr=127.0.0.1 CPUs=16 State=UNKNOWN
PartitionName=p Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def recipe(name):
    return os.path.join(SOURCE, "Utilities", "Cluster", name)


class Cluster(ManyCase):
    def setUp(self):
        super().setUp()
        self.whole = self.path("whole")
        self.dgtk("render", DEMO, "-o", self.whole, *OPTIONS, "--quiet")

    def script(self, *command, environment=None):
        done = subprocess.run(command, capture_output=True, text=True, timeout=400, env={**os.environ, "DGTK": DGTK, **(environment or {})})
        self.assertEqual(done.returncode, 0, f"{command}\n{done.stdout}\n{done.stderr}")
        return done.stdout

    def test_gnu_parallel(self):
        self.script(recipe("parallel.sh"), "4", DEMO, "-o", self.path("run"), *OPTIONS)
        self.assert_same_files(self.whole, self.path("run"))
        export = ("--format", "imagefolder")
        dataset = self.path("pictures")
        self.dgtk("render", DEMO, "-o", dataset, "--for", "imagefolder", "--size", "48x36", "--quiet")
        self.dgtk("export", dataset, *export, "-o", self.path("exported"), "--quiet")
        self.script(recipe("parallel.sh"), "2", dataset, *export, "-o", self.path("shared"), environment={"DGTK_COMMAND": "export"})
        self.assert_same_files(self.path("exported"), self.path("shared"))

    def test_open_mpi(self):
        # As root, and on a machine with fewer cores than processes
        self.script(recipe("mpirun.sh"), "3", DEMO, "-o", self.path("run"), *OPTIONS,
                    environment={"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_plm": "^rsh"})
        self.assert_same_files(self.whole, self.path("run"))

    @unittest.skipUnless(os.geteuid() == 0, "left out: Slurm's daemons are started as root only")
    def test_slurm(self):
        slurm = Slurm(self)
        try:
            slurm.start()
            self.array(slurm)
            self.srun(slurm)
        finally:
            slurm.stop()

    def array(self, slurm):
        """An array job, of which one task is put back into the queue while it runs."""
        folder = self.path("array")
        job = slurm.submit("--array=0-3", recipe("slurm_array.sh"), DEMO, "-o", folder, *OPTIONS)
        slurm.run("scontrol", "requeue", f"{job}_2", check=False)
        slurm.wait(job)
        self.dgtk("merge", folder)
        self.assert_same_files(self.whole, folder)
        # Parts that are lost are made by an array that merge names.
        folder = self.path("again")
        slurm.wait(slurm.submit("--array=0-2", recipe("slurm_array.sh"), DEMO, "-o", folder, *OPTIONS))
        for block in ("000000", "000002"):
            shutil.rmtree(os.path.join(folder, ".dgtk-parts", block))
        missing = self.refused("merge", folder, status=1, says=("2 of 6 blocks", "shares 0,2 of 3"))
        array = re.search(r"--array=\S+?(?=\))", missing).group()
        self.assertEqual(array, "--array=0-1")
        slurm.wait(slurm.submit(array, recipe("slurm_array.sh"), DEMO, "-o", folder, *OPTIONS))
        self.dgtk("merge", folder)
        self.assert_same_files(self.whole, folder)

    def srun(self, slurm):
        folder = self.path("srun")
        slurm.wait(slurm.submit("--ntasks=3", "--cpus-per-task=1", recipe("slurm_srun.sh"), DEMO, "-o", folder, *OPTIONS))
        self.assert_same_files(self.whole, folder)


class Slurm:
    """munged, slurmctld and slurmd with folders, ports and a key of their own."""

    def __init__(self, case):
        self.case = case
        self.folder = case.path("slurm")
        self.daemons = []
        self.environment = {**os.environ, "SLURM_CONF": os.path.join(self.folder, "slurm.conf"), "DGTK": DGTK}

    def start(self):
        for name in ("", "state", "spool"):
            os.makedirs(os.path.join(self.folder, name), exist_ok=True)
        os.chmod(self.folder, 0o755)
        host = socket.gethostname().split(".")[0]
        with open(os.path.join(self.folder, "slurm.conf"), "w", encoding="utf-8") as conf:
            conf.write(CONF.format(folder=self.folder, host=host, port=free_port(), node_port=free_port()))
        with open(os.path.join(self.folder, "cgroup.conf"), "w", encoding="utf-8") as conf:
            conf.write("CgroupPlugin=cgroup/v1\n")
        key = os.path.join(self.folder, "munge.key")
        with open(key, "wb") as file:
            file.write(os.urandom(128))
        os.chmod(key, 0o400)
        self.daemon("munged", "--foreground", "--force", f"--key-file={key}", f"--socket={self.folder}/munge.socket",
                    f"--pid-file={self.folder}/munged.pid", f"--log-file={self.folder}/munged.log", f"--seed-file={self.folder}/munge.seed")
        self.until(lambda: os.path.exists(os.path.join(self.folder, "munge.socket")), "munged")
        conf = self.environment["SLURM_CONF"]
        self.daemon("slurmctld", "-D", "-i", "-f", conf)
        self.daemon("slurmd", "-D", "-f", conf)
        self.until(lambda: "idle" in self.run("sinfo", "-h", "-o", "%T", check=False), "slurmd")

    def daemon(self, name, *arguments):
        log = open(os.path.join(self.folder, name + ".out"), "w", encoding="utf-8")
        self.case.addCleanup(log.close)
        path = shutil.which(name, path=os.environ.get("PATH", "") + ":/usr/sbin:/sbin")
        self.case.assertIsNotNone(path, f"{name} is not installed (Utilities/Setup/packages.txt)")
        self.daemons.append(subprocess.Popen([path, *arguments], stdout=log, stderr=log, env=self.environment, cwd=self.folder))

    def until(self, holds, what, seconds=200):
        end = time.monotonic() + seconds
        while not holds():
            if time.monotonic() > end:
                logs = ""
                for name in ("munged", "slurmctld", "slurmd"):
                    path = os.path.join(self.folder, name + ".out")
                    logs += open(path, encoding="utf-8").read()[-2000:] if os.path.exists(path) else ""
                self.case.fail(f"{what} is not ready after {seconds} s\n{logs}")
            time.sleep(0.2)

    def run(self, *command, check=True):
        done = subprocess.run(command, capture_output=True, text=True, env=self.environment, cwd=self.folder, timeout=200)
        if check:
            self.case.assertEqual(done.returncode, 0, f"{command}\n{done.stderr}")
        return done.stdout

    def submit(self, *words):
        return self.run("sbatch", "--parsable", *words).strip().split(";")[0]

    def wait(self, job):
        self.until(lambda: not self.run("squeue", "-h", "-j", job, "-t", "PD,R,CG,RQ,S", check=False).strip(), f"job {job}", 300)

    def stop(self):
        for daemon in reversed(self.daemons):
            daemon.send_signal(signal.SIGTERM)
            try:
                daemon.wait(timeout=20)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()


if __name__ == "__main__":
    main()
