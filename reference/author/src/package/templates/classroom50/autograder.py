#!/usr/bin/env python3
"""Grades the checkout in the current folder and writes result.json and release-body.md there.

classroom50 runs this script for each submission and shows release-body.md on the page of the run.
The grader comes from the archive beside this file, never from the checkout, which students can
change. Exit code 0 means that the submission was graded, regardless of its score.
"""

import os
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path


def main():
    checkout = Path.cwd()
    package = os.environ.get("CLASSROOM50_BUNDLE_DIR") or Path(__file__).resolve().parent
    environment = dict(os.environ, GITHUB_WORKSPACE=str(checkout))
    environment.setdefault("OWNER", os.environ.get("USERNAME", ""))
    environment.setdefault("ASSIGNMENT_TYPE", "individual")
    environment.setdefault("REVIEW_URL", os.environ.get("COMMIT_URL", ""))
    environment.setdefault("SUBMITTED_AT", commit_date(checkout))
    with tempfile.TemporaryDirectory() as folder:
        with zipfile.ZipFile(Path(package) / "pathtracing.zip") as archive:
            archive.extractall(folder)
        grader = Path(folder) / "pathtracing"
        command = ["cargo", "run", "--release", "--locked", "--package", "grader", "--"]
        command += [str(checkout), "--untrusted", "--out", str(Path(folder) / "graded")]
        command += ["--assignment", "ASSIGNMENT_ID"]
        command += ["--policy", str(grader / "policy.toml"), "--format"]
        command += [f"classroom50={checkout / 'result.json'}"]
        command += [f"github={checkout / 'release-body.md'}"]
        return subprocess.run(command, cwd=grader, env=environment).returncode


def commit_date(checkout):
    """Returns the date of the graded commit, which stays the same if the commit is graded again."""
    command = ["git", "-C", str(checkout), "log", "-1", "--format=%cd"]
    command += ["--date=format-local:%Y-%m-%dT%H:%M:%SZ"]
    environment = dict(os.environ, TZ="UTC")
    return subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout.strip()


if __name__ == "__main__":
    sys.exit(main())
