"""docs/techniques.md lists the techniques and parameters that the program has."""

import subprocess
import sys

import support


class Tables(support.TestCase):
    def test_documented(self):
        result = subprocess.run([sys.executable, support.ROOT / "scripts" / "tables.py", support.PROGRAM],
                                capture_output=True, text=True)
        self.assertEqual(result.returncode, 0, result.stderr)


if __name__ == "__main__":
    support.main()
