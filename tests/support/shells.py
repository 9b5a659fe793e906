"""A shell with a terminal, in which a test types and presses Tab."""

import os
import pathlib
import pty
import re
import select
import shutil
import signal
import time
import unittest

COMMANDS = {"bash": ["bash", "--norc", "--noprofile", "-i"], "zsh": ["zsh", "-f", "-i"]}


class Shell:
    """Starts `name` in `folder`; skips the test where that shell is not installed."""

    def __init__(self, name, folder):
        if not shutil.which(name):
            raise unittest.SkipTest(f"{name} is not installed")
        environment = {"PATH": os.environ["PATH"], "HOME": str(folder), "TERM": "dumb", "LC_ALL": "C.UTF-8",
                       "INPUTRC": "/dev/null", "PS1": "$ "}
        self.output, self.commands = "", 0
        self.process, self.terminal = pty.fork()
        if self.process == 0:
            os.chdir(folder)
            os.execvpe(name, COMMANDS[name], environment)
        self.run("stty columns 1000")  # so that no line of the editor is broken

    def close(self):
        os.kill(self.process, signal.SIGKILL)
        os.waitpid(self.process, 0)
        os.close(self.terminal)

    def read_until(self, pattern, seconds=60):
        """What the shell wrote up to the pattern, since the last call."""
        end = time.monotonic() + seconds
        while not (found := re.search(pattern, self.output)):
            if time.monotonic() > end:
                raise AssertionError(f"no {pattern!r} in {self.output!r}")
            if select.select([self.terminal], [], [], 0.1)[0]:
                self.output += os.read(self.terminal, 65536).decode(errors="replace")
        text, self.output = self.output[:found.start()], self.output[found.end():]
        return text

    def type(self, text):
        os.write(self.terminal, text.encode())

    def run(self, command):
        """What a command prints, and the echo of what was typed."""
        self.commands += 1
        self.type(f"{command}\n echo END$(({self.commands}+1000))\n")
        return self.read_until(f"END{self.commands + 1000}")

    def completed(self, line):
        """The words of a command line after Tab was pressed at its end."""
        self.type(line + "\t")
        self.type("\x01printf 'WORD<%s>\\n' \x05")  # Ctrl-A, Ctrl-E: to the line's start, and to its end
        return re.findall(r"(?m)^WORD<([^%\n]*)>\r?$", self.run(""))


def load_completion(shell, name, folder):
    """Reads the script as a login shell would that finds it in the installed folder."""
    if name == "bash":
        shell.run(f"source {pathlib.Path(folder) / 'penumbra.bash'}")
    else:
        shell.run(f"fpath=({folder} $fpath); autoload -U compinit; compinit -u -D")
