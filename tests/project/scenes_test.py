"""The scenes in the tree are what their generator writes."""

import subprocess
import sys

import support


class Scenes(support.TestCase):
    def test_generated(self):
        result = subprocess.run([sys.executable, support.ROOT / "scenes" / "generate.py", "--check"], capture_output=True,
                                text=True)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)


if __name__ == "__main__":
    support.main()
