#!/usr/bin/env python3
"""Builds the targets of tests/fuzz with libFuzzer and runs them: fuzz.py [--seconds N] [TARGET...].

Exit status 0: nothing was found; 1: something was, and lies in BUILD/found/TARGET; 77: what it takes is not here. What
was learnt is kept in BUILD/corpus/TARGET, from where the next run goes on; with --fresh it begins with the seeds only.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FUZZ = ROOT / "tests" / "fuzz"
COMPILER = "clang++-14"
# Longest input of each target, in bytes: longer ones say nothing new, and take longer.
LONGEST = {"scripts": 2048, "names": 512, "towers": 768, "zigzags": 768, "barcodes": 768, "meshes": 1536, "map_files": 1536, "gzip": 512, "logs": 1024,
           "snapshots": 4096, "engine_steps": 400}
# Inputs that others have, too.
FURTHER_SEEDS = {"scripts": [ROOT / "replay/examples"], "towers": [ROOT / "replay/examples"], "zigzags": [ROOT / "replay/examples"],
                 "meshes": [ROOT / "tests/golden/meshes"], "map_files": [ROOT / "tests/golden/maps"]}


def why_not():
    """What is missing, or None."""
    if shutil.which(COMPILER) is None:
        return f"there is no {COMPILER} here; tools/install_dependencies --heavy installs it"
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "empty.cpp"
        source.write_text("#include <cstddef>\n#include <cstdint>\n"
                          'extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t*, std::size_t) { return 0; }\n')
        command = [COMPILER, "-fsanitize=fuzzer,address,undefined", str(source), "-o", str(source.with_suffix(""))]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0:
            return f"{COMPILER} has no libFuzzer here: {done.stderr.strip().splitlines()[-1]}"
    return None


def build(folder, targets, jobs):
    subprocess.run(["cmake", "--preset", "fuzz", "-B", str(folder), "-D", "SESAME_UNITY=ON"], cwd=ROOT, check=True,
                   stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", str(folder), "-j", str(jobs), "--target", *[f"fuzz_{t}" for t in targets]],
                   cwd=ROOT, check=True)


def run(target, folder, options):
    """Runs a target. Returns whether it found nothing, and the line that says what it did."""
    corpus, found = folder / "corpus" / target, folder / "found" / target
    if options.fresh:
        shutil.rmtree(corpus, ignore_errors=True)
    for each in (corpus, found):
        each.mkdir(parents=True, exist_ok=True)
    seeds = [FUZZ / "seeds" / target, *FURTHER_SEEDS.get(target, [])]
    command = [str(folder / "tests/fuzz" / f"fuzz_{target}"), str(corpus), *[str(s) for s in seeds if s.is_dir()],
               f"-seed={options.seed}", f"-max_total_time={options.seconds}", f"-max_len={LONGEST[target]}",
               "-timeout=10", "-rss_limit_mb=2048", "-malloc_limit_mb=256", f"-artifact_prefix={found}/",
               "-print_final_stats=1", "-reload=0", "-entropic=0"]  # whose bookkeeping takes longer than our targets
    with open(found / "log", "w", encoding="utf-8", errors="replace") as log:
        # Short stacks of allocations and a small quarantine: twice as many runs.
        environment = {"ASAN_OPTIONS": "malloc_context_size=2:quarantine_size_mb=8", **os.environ}
        status = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, cwd=found, env=environment).returncode
    text = (found / "log").read_text(encoding="utf-8", errors="replace")
    states = re.findall(r"^#(\d+)\s+\w+\s+cov: (\d+) ft: (\d+) corp: (\d+)/(\S+)", text, re.M)
    runs = re.findall(r"stat::number_of_executed_units: (\d+)", text)
    speed = re.findall(r"stat::average_exec_per_sec:\s+(\d+)", text)
    last = states[-1] if states else ("0", "0", "0", "0", "0")
    line = (f"{target:<14}{runs[-1] if runs else last[0]:>10} runs{speed[-1] if speed else '?':>7}/s   "
            f"cov {last[1]:>6}   ft {last[2]:>7}   corpus {last[3]:>6}   {'' if status == 0 else 'FAILED'}")
    if status != 0:
        print("\n".join(text.splitlines()[-60:]))
        print(f"{target}: the input lies in {found}")
    return status == 0, line


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("targets", nargs="*", metavar="TARGET", help="all, when none is given: " + ", ".join(LONGEST))
    parser.add_argument("--seconds", type=int, default=60, help="for each target")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--build", type=Path, default=ROOT / "build" / "fuzz")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--fresh", action="store_true", help="forget what earlier runs have learnt")
    options = parser.parse_args()
    targets = options.targets or list(LONGEST)
    if unknown := [t for t in targets if t not in LONGEST]:
        parser.error(f"there is no target {unknown[0]}")
    if reason := why_not():
        print(f"skipped: {reason}")
        return 77
    folder = options.build.resolve()
    build(folder, targets, options.jobs)
    lines, all_went_well = [], True
    for target in targets:
        went_well, line = run(target, folder, options)
        all_went_well &= went_well
        lines.append(line)
        print(line, flush=True)
    return 0 if all_went_well else 1


if __name__ == "__main__":
    sys.exit(main())
