#!/usr/bin/env python3
"""What threads share is clean under the thread sanitizer: thread_sanitizer_test.py SOURCE BUILD COMPILER.

Configures the preset `tsan` in BUILD, builds the tests there that have threads, of logs, snapshots and views, of replays that
others take part in and of the server of their pages, and runs them. The first time that takes minutes.
"""
import os
import subprocess
import sys

TARGETS = {"test_engine_sessions": "engine", "test_shared_replay": "replay", "test_live_server": "tools"}


def main():
    source, build, compiler = sys.argv[1:]
    subprocess.run(["cmake", "--preset", "tsan", "-S", source, "-B", build, "-D", "SESAME_TESTS=ON", "-D",
                    "SESAME_UNITY=ON", "-D", f"CMAKE_CXX_COMPILER={compiler}"], cwd=source, check=True,
                   stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", build, "--target", *TARGETS, "-j", str(os.cpu_count())], check=True,
                   stdout=subprocess.DEVNULL)
    # A race ends the run with this status, and its report is on standard error.
    environment = dict(os.environ, TSAN_OPTIONS="exitcode=66:halt_on_error=1")
    for target, folder in TARGETS.items():
        ran = subprocess.run([f"{build}/tests/{folder}/{target}"], env=environment, capture_output=True, text=True)
        print(ran.stdout[-2000:], ran.stderr[-8000:])
        if ran.returncode != 0:
            sys.exit(f"{target} under the thread sanitizer: status {ran.returncode}")
        if "All tests passed" not in ran.stdout:
            sys.exit(f"{target}: no tests ran")


if __name__ == "__main__":
    main()
