"""A folder that is the root of a system which has nothing but some Debian packages, and what these depend on."""

import os
import pathlib
import re
import shutil
import stat
import subprocess

FIELDS = "${Package}\\t${Essential}\\t${Pre-Depends}, ${Depends}\\t${Provides}\\n"


def _names(relations):
    """The alternatives of each relation: "a (>= 1) | b, c" is [["a", "b"], ["c"]]."""
    groups = [[re.sub(r"\(.*?\)|:\w+", "", name).strip() for name in group.split("|")] for group in relations.split(",")]
    return [[name for name in group if name] for group in groups if any(group)]


class Installed:
    """The packages of this machine."""

    def __init__(self):
        self.depends, self.providers, self.essential = {}, {}, []
        for line in subprocess.run(["dpkg-query", "-W", "-f", FIELDS], capture_output=True, text=True,
                                   check=True).stdout.splitlines():
            name, essential, depends, provides = line.split("\t")
            self.depends[name] = _names(depends)
            if essential == "yes":
                self.essential.append(name)
            for provided in _names(provides):
                self.providers.setdefault(provided[0], name)

    def closure(self, relations):
        """Essential packages, those named, and all that they depend on. Raises KeyError for one that is not installed."""
        done, todo = set(), [[name] for name in self.essential] + _names(relations)
        while todo:
            group = todo.pop()
            name = next((name for name in group if name in self.depends), None) or next(
                (self.providers[name] for name in group if name in self.providers), None)
            if name is None:
                raise KeyError(" | ".join(group))
            if name not in done:
                done.add(name)
                todo += self.depends[name]
        return done


def _place(path, target):
    """A file in the root: its folders, links and files as they are; files as hard links where that is possible."""
    status = path.lstat()
    if stat.S_ISDIR(status.st_mode):
        target.mkdir(parents=True, exist_ok=True)
    elif not os.path.lexists(target):
        target.parent.mkdir(parents=True, exist_ok=True)
        linked = path.parts[1] == "usr" and not stat.S_ISLNK(status.st_mode)  # dpkg and ldconfig write only elsewhere
        try:
            os.link(path, target) if linked else shutil.copy2(path, target, follow_symlinks=False)
        except OSError:
            shutil.copy2(path, target, follow_symlinks=False)


def _link_alternatives(root):
    """The links that Debian's alternatives make, which belong to no package: awk, liblapack.so.3."""
    for record in pathlib.Path("/var/lib/dpkg/alternatives").iterdir():
        link = pathlib.Path(record.read_text().splitlines()[1])
        target = link.resolve()
        if (root / target.relative_to("/")).exists() and not os.path.lexists(root / link.relative_to("/")):
            (root / link.relative_to("/")).symlink_to(target)


def make(root, relations):
    """Makes the folder, from the files of this machine's packages, and returns their names."""
    names = sorted(Installed().closure(relations))
    for folder in ("bin", "sbin", "lib", "lib64"):  # links into /usr, which belong to no package
        link = pathlib.Path("/", folder)
        if link.is_symlink():
            (root / "usr" / folder).mkdir(parents=True)
            (root / folder).symlink_to(os.readlink(link))
    for folder in ("usr", "tmp", "dev", "proc", "var/lib/dpkg/info", "var/lib/dpkg/updates", "etc"):
        (root / folder).mkdir(parents=True, exist_ok=True)
    files = subprocess.run(["dpkg", "-L", *names], capture_output=True, text=True, check=True).stdout.splitlines()
    for file in files:
        path = pathlib.Path(file)
        if file.startswith("/") and not file.startswith("/usr/share/doc/") and os.path.lexists(path):
            _place(path, root / path.relative_to("/"))
    _link_alternatives(root)
    status = subprocess.run(["dpkg-query", "-s", *names], capture_output=True, text=True, check=True).stdout
    (root / "var/lib/dpkg/status").write_text(status)
    for path in pathlib.Path("/var/lib/dpkg/info").iterdir():
        if path.suffix == ".list" and path.stem.split(":")[0] in names:
            shutil.copy2(path, root / "var/lib/dpkg/info" / path.name)
    (root / "etc/passwd").write_text("root:x:0:0:root:/tmp:/bin/sh\n")
    (root / "dev/null").touch()
    subprocess.run(["ldconfig", "-r", root], check=True, capture_output=True)
    return names


def run(root, *command, **options):
    """Runs a command in the root; the result has returncode, stdout and stderr."""
    environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/tmp", "LC_ALL": "C.UTF-8"}
    return subprocess.run(["chroot", root, *map(str, command)], capture_output=True, text=True, env=environment,
                          timeout=300, **options)
