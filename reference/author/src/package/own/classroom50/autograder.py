#!/usr/bin/env python3
"""Grades the checkout in the current folder, and leaves result.json and release-body.md there.

classroom50 runs this for each submission, and shows the second of these files on the page of the run
as well. The grader is the one beside this file, never the one in the checkout, which students can
change. Exit code 0: graded, whatever the score.
"""

import os
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path


def main():
    checkout = Path.cwd()
    own = os.environ.get("CLASSROOM50_BUNDLE_DIR") or Path(__file__).resolve().parent
    environment = dict(os.environ, GITHUB_WORKSPACE=str(checkout))
    environment.setdefault("OWNER", os.environ.get("USERNAME", ""))
    environment.setdefault("ASSIGNMENT_TYPE", "individual")
    environment.setdefault("REVIEW_URL", os.environ.get("COMMIT_URL", ""))
    environment.setdefault("SUBMITTED_AT", committed(checkout))
    with tempfile.TemporaryDirectory() as folder:
        with zipfile.ZipFile(Path(own) / "pathtracing.zip") as archive:
            archive.extractall(folder)
        grader = Path(folder) / "pathtracing"
        command = ["cargo", "run", "--release", "--locked", "--package", "grader", "--"]
        command += [str(checkout), "--untrusted", "--out", str(Path(folder) / "graded")]
        command += ["--policy", str(grader / "policy.toml"), "--format"]
        command += [f"classroom50={checkout / 'result.json'}"]
        command += [f"github={checkout / 'release-body.md'}"]
        return subprocess.run(command, cwd=grader, env=environment).returncode


def committed(checkout):
    """The graded commit's date, which stays when it is graded again."""
    command = ["git", "-C", str(checkout), "log", "-1", "--format=%cd"]
    command += ["--date=format-local:%Y-%m-%dT%H:%M:%SZ"]
    environment = dict(os.environ, TZ="UTC")
    return subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout.strip()


if __name__ == "__main__":
    sys.exit(main())
