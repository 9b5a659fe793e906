"""What the tests of penumbra plan, work and merge share."""

import json
import os

from pictures import scene
from support import TestCase

TINY = ("--size", "64x36")
COMPARED = (scene("steps"), scene("posts"), "--technique", "hard,pcss:pcss.filter_taps=4,slices_denoised", "--spp", "8",
            *TINY, "--set", "cascades.size=256", "--no-cache")


class Plans(TestCase):
    def setUp(self):
        super().setUp()
        os.environ.pop("SLURM_ARRAY_TASK_ID", None)
        self.plan = self.folder / "sweep.json"

    def make(self, *arguments, **options):
        result = self.succeed("plan", *arguments, "-o", self.plan, **options)
        return dict(line.split() for line in result.stdout.splitlines())

    def document(self):
        return json.loads(self.plan.read_text())

    def work(self, *arguments, **options):
        return self.succeed("work", self.plan, *arguments, **options).stdout

    def merge(self, into="merged"):
        self.succeed("merge", self.plan, "-o", self.folder / into)
        return self.contents(into)

    def contents(self, folder):
        base = self.folder / folder
        return {path.relative_to(base).as_posix(): path.read_bytes() for path in base.rglob("*") if path.is_file()}

    def results(self):
        return {path: data for path, data in self.contents("sweep.results").items() if path.endswith(".result")}
