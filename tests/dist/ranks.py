"""What the tests of slosh-dist share: its programs, and the settings of Open MPI under which they run anywhere."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PATIENCE = 120  # s, for what takes one: on a machine that is busy with others, ranks that share a processor wait for each other
SLOSH, DIST, MPIRUN = (sys.argv.pop(1) for _ in range(3))
ENVIRONMENT = os.environ | dict(
    OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
    OMPI_MCA_mpi_yield_when_idle="1", OMPI_MCA_hwloc_base_binding_policy="none", OMPI_MCA_btl="self,vader", OMPI_MCA_pml="ob1",
    OMPI_MCA_odls_base_sigkill_timeout="0")  # s that mpirun gives the other ranks, twice


class RanksCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def start(self, ranks, *args):
        ran = subprocess.Popen([MPIRUN, "-n", str(ranks), DIST, *map(str, args)], env=ENVIRONMENT, text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(self.stop, ran)
        return ran

    def stop(self, ran):
        """With its ranks, which would outlive an mpirun that is killed."""
        if ran.poll() is None:
            ran.terminate()
            ran.communicate(timeout=PATIENCE)

    def end(self, ran):
        """Its code, output and errors."""
        out, errors = ran.communicate(timeout=PATIENCE)
        return ran.returncode, out, errors

    def works(self, ranks, *args):
        """Its output."""
        code, out, errors = self.end(self.start(ranks, *args))
        self.assertEqual(code, 0, errors)
        return out

    def alone(self, *args):
        """slosh-dist without mpirun: its code, output and errors."""
        said = subprocess.run([DIST, *map(str, args)], env=ENVIRONMENT, capture_output=True, text=True, timeout=PATIENCE)
        return said.returncode, said.stdout, said.stderr
