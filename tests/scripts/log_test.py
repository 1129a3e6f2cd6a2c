#!/usr/bin/env python3
"""Durable logs through the program: what is written, what is found after a crash, and who may write.

Usage: log_test.py SESAME [--heavy]
"""

import json
import random
import re
import resource
import signal
import subprocess
import sys
import time
import unittest

from program_folder import HEADER, SESAME, ProgramFolder, simplex

HEAVY = "--heavy" in sys.argv


def steps(first, count):
    return "".join(simplex(f"s{k}", k % 3) for k in range(first, first + count))


class Logs(ProgramFolder):
    def replay(self, text, *arguments, **options):
        return self.run_in("replay", "-", "--quiet", "--log", "log", *arguments, text=text, **options)

    def verified(self, name="log", *flags):
        done = self.run_in("verify", name, "--json", *flags)
        return done.returncode, json.loads(done.stdout.splitlines()[-1])

    def test_a_log_is_verified_whole(self):
        for sync in ("always", "batch", "never"):
            self.assertEqual(self.replay(HEADER + steps(0, 50), "--sync", sync).returncode, 0)
            whole = {"steps": 50, "whole": True, "torn": 0, "damage": None}
            self.assertEqual(self.verified(), (0, whole))
            self.assertEqual(self.verified("log", "--laws"), (0, whole))
            self.log.unlink()

    def test_a_log_is_a_script_that_gives_the_same(self):
        self.replay(HEADER + steps(0, 20))
        results = [json.loads(self.run_in("replay", "-", "--json", text=text).stdout.splitlines()[-1])
                   for text in (HEADER + steps(0, 20), self.log.read_text())]
        for result in results:
            del result["seconds"]
        self.assertEqual(*results)
        for line in self.log.read_text().splitlines():
            if not line.startswith("#"):
                self.assertIn("xxh3", json.loads(line))

    def test_a_log_cut_at_any_byte_has_the_steps_before_and_can_be_gone_on_from(self):
        self.replay(HEADER + steps(0, 6))
        whole = self.log.read_bytes()
        for size in range(0, len(whole) + 1, 1 if HEAVY else 23):
            self.log.write_bytes(whole[:size])
            end = whole[:size].rfind(b"\n") + 1
            records = sum(line.startswith(b"{") for line in whole[:end].splitlines())
            status, found = self.verified()
            self.assertEqual((status, found["steps"], found["torn"], found["damage"]),
                             (0, max(records - 1, 0), size - end, None), size)
            self.assertEqual(found["whole"], size == end)
            if size % 5 == 0 or HEAVY:
                done = self.replay(HEADER + simplex("new"), "--append")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(self.verified()[1]["steps"], max(records - 1, 0) + 1)

    def test_what_is_torn_off_is_said(self):
        self.replay(HEADER + steps(0, 3))
        with open(self.log, "a", encoding="utf-8") as log:
            log.write('{"op":"simp')
        done = self.run_in("replay", "-", "--log", "log", "--append", text=HEADER + simplex("new"))
        self.assertEqual(done.returncode, 0)
        self.assertIn("log: the last 11 bytes, behind step 3, are no whole record, and are cut off\n", done.stderr)
        done = self.run_in("replay", "log")
        self.assertEqual(done.returncode, 0)

    def test_damage_is_found_said_and_never_passed_over(self):
        self.replay(HEADER + steps(0, 9))
        whole = self.log.read_bytes()
        lines = whole.splitlines(keepends=True)
        for record in range(10):
            byte = sum(map(len, lines[:record]))
            data = bytearray(whole)
            data[byte + 10] ^= 1
            self.log.write_bytes(data)
            status, found = self.verified()
            self.assertEqual((status, found["whole"], found["steps"]), (2, False, max(record - 1, 0)))
            self.assertEqual((found["damage"]["record"], found["damage"]["byte"]), (record, byte))
            place = f"record {record}, at byte {byte}"
            done = self.replay(HEADER + simplex("new"), "--append")
            self.assertEqual((done.returncode, self.log.read_bytes()), (2, bytes(data)))
            self.assertIn(f"log:{record + 1}: {place}", done.stderr)
            done = self.run_in("replay", "log", "--keep-going", "--quiet")
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"log:{record + 1}: ", done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)
            self.assertEqual(self.run_in("verify", "log", "--salvage", "new").returncode, 2)
            self.assertEqual((self.folder / "new").read_bytes(), whole[:byte])
            self.assertEqual(self.run_in("verify", "log", "--salvage", "new").returncode, 1)
            if record > 0:
                self.assertEqual(self.verified("new")[1]["steps"], record - 1)
                self.assertEqual(self.run_in("info", "log").returncode, 2)
            (self.folder / "new").unlink()

    def test_info_says_what_is_in_a_log(self):
        self.replay(HEADER + simplex("t", 2) + '{"op":"identify","pairs":[["t.0-1","t.1-2"],["t.0-1","t.0-2"]]}\n')
        done = self.run_in("info", "log", "--json")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        info = json.loads(done.stdout)
        expected = {"title": "test", "ring": "Z", "steps": 2, "operations": {"identify": 1, "simplex": 1},
                    "cells": [1, 1, 1], "betti": [1, 0, 0], "checksums": True, "synced": 2, "bound": 2,
                    "bytes": self.log.stat().st_size, "torn": 0, "damage": None}
        self.assertEqual({key: info[key] for key in expected}, expected)
        for flag in ([], ["--no-replay"]):
            self.assertEqual(self.run_in("info", "log", *flag).returncode, 0)

    def test_a_log_has_one_writer_and_many_readers(self):
        with subprocess.Popen([SESAME, "replay", "-", "--json", "--log", "log"], cwd=self.folder, text=True,
                              stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            process.stdin.write(HEADER + simplex("a"))
            process.stdin.flush()
            process.stdout.readline()
            for flag in ("--append", "--overwrite"):
                done = self.replay(HEADER + simplex("b"), flag)
                self.assertEqual(done.returncode, 1)
                self.assertRegex(done.stderr, f"another process, {process.pid}, is writing this log")
            self.assertEqual(self.verified()[1]["steps"], 1)
            self.assertEqual(self.run_in("replay", "log", "--quiet").returncode, 0)
            process.communicate(timeout=60)
        self.assertEqual(self.replay(HEADER + simplex("b"), "--append").returncode, 0)

    def test_a_script_that_was_changed_by_hand_is_a_log_until_a_checksum_says_otherwise(self):
        self.replay(HEADER + steps(0, 3))
        with open(self.log, "a", encoding="utf-8") as log:
            log.write("# by hand\n" + simplex("hand"))
        self.assertEqual(self.verified()[1], {"steps": 4, "whole": True, "torn": 0, "damage": None})
        self.assertEqual(self.replay(HEADER + simplex("more"), "--append").returncode, 0)
        self.assertEqual(self.verified()[1]["steps"], 5)
        self.log.write_text(self.log.read_text().replace("by hand", "by Hand"))
        self.assertEqual(self.verified()[0], 2)

    def test_a_full_disk_says_what_is_safe_and_leaves_whole_steps(self):
        for size in (300, 1000, 3000):
            done = self.replay(HEADER + steps(0, 60),
                               preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size)))
            self.assertEqual(done.returncode, 1)
            self.assertRegex(done.stderr, r"^cannot write log: File too large; .*step \d+")
            status, found = self.verified()
            self.assertEqual((status, found["torn"]), (0, 0))
            self.assertGreater(found["steps"], 0)
            rest = HEADER + steps(found["steps"], 60 - found["steps"])
            self.assertEqual(self.replay(rest, "--append").returncode, 0)
            self.assertEqual(self.verified()[1]["steps"], 60)
            self.log.unlink()

    def test_a_file_system_that_is_full_is_gone_on_from_when_it_has_room(self):
        place = self.folder / "small"
        place.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "none", str(place)], capture_output=True,
                                 check=False)
        if mounted.returncode != 0:
            self.skipTest("nothing can be mounted here")
        self.addCleanup(subprocess.run, ["umount", str(place)], check=False)
        for sync in ("always", "batch", "never"):
            (place / "log").unlink(missing_ok=True)
            subprocess.run(["mount", "-o", "remount,size=64k", str(place)], check=True)
            done = self.run_in("replay", "-", "--quiet", "--log", place / "log", "--sync", sync,
                               text=HEADER + steps(0, 2000))
            self.assertEqual(done.returncode, 1)
            self.assertIn("No space left on device; ", done.stderr)
            status, found = self.verified(place / "log")
            self.assertEqual((status, found["torn"]), (0, 0))
            self.assertTrue(0 < found["steps"] < 2000)
            subprocess.run(["mount", "-o", "remount,size=1m", str(place)], check=True)
            done = self.run_in("replay", "-", "--quiet", "--log", place / "log", "--append",
                               text=HEADER + steps(found["steps"], 2000 - found["steps"]))
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(self.verified(place / "log")[1]["steps"], 2000)

    def test_kill_at_any_moment_loses_no_step_that_was_reported(self):
        generator = random.Random(7)
        script, out = self.folder / "script", self.folder / "out"
        for _ in range(300 if HEAVY else 8):
            first = self.verified()[1]["steps"] if self.log.exists() else 0
            script.write_text(HEADER + steps(first, 4000))
            with open(out, "wb") as output:
                process = subprocess.Popen([SESAME, "replay", script, "--json", "--log", "log", "--append", "--every", "1",
                                            "--sync", generator.choice(["always", "batch", "never"])],
                                           cwd=self.folder, stdout=output, stderr=subprocess.PIPE)
                time.sleep(generator.random() * 0.3)
                process.kill()
                _, errors = process.communicate(timeout=60)
            self.assertEqual(errors, b"")
            reported = [int(match[1]) for match in re.finditer(r'^{"step":(\d+),.*}$', out.read_text(), re.M)]
            if self.log.exists():
                status, found = self.verified()
                self.assertEqual((status, found["damage"]), (0, None))
                self.assertGreaterEqual(found["steps"], max(reported, default=0))
                if found["steps"] > 12000:
                    self.log.unlink()

    def test_a_snapshot_makes_a_log_quicker_to_open_and_changes_nothing(self):
        self.replay(HEADER + steps(0, 12_000))
        snapshot = self.folder / "log.snapshot"
        self.assertTrue(snapshot.exists())
        self.assertIsNotNone(json.loads(self.run_in("info", "log", "--json").stdout)["snapshot"])
        log, whole = self.log.read_bytes(), snapshot.read_bytes()
        more = HEADER + '{"op":"undo","steps":11000}\n' + simplex("new", 2) + '{"op":"identify","pairs":[["new.0","s6"]]}\n'
        results = []
        for content, flags in ((whole, []), (whole, ["--no-snapshots"]), (whole[:1000], []), (b"", []), (None, [])):
            self.log.write_bytes(log)
            snapshot.unlink(missing_ok=True)
            if content is not None:
                snapshot.write_bytes(content)
            done = self.run_in("replay", "-", "--log", "log", "--append", "--json", "--generators", *flags, text=more)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            result = json.loads(done.stdout.splitlines()[-1])
            del result["seconds"]
            results.append((result, self.verified()))
        for result in results:
            self.assertEqual(result, results[0])

    def followed(self):
        process = subprocess.Popen([SESAME, "replay", "--json", "--follow", "log"], cwd=self.folder, text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.kill)
        return process

    def next_step(self, process):
        return json.loads(process.stdout.readline())["step"]

    def test_a_follower_survives_the_death_of_the_writer_and_sees_whole_records_only(self):
        self.replay(HEADER + simplex("a"))
        with self.followed() as process:
            self.assertEqual(self.next_step(process), 1)
            with open(self.log, "ab") as log:
                log.write(b'{"op":"simplex","na')  # the writer dies in the middle
                log.flush()
                time.sleep(0.3)
            self.assertEqual(self.replay(HEADER + simplex("b"), "--append").returncode, 0)  # cuts that off
            self.assertEqual(self.next_step(process), 2)
            process.send_signal(signal.SIGINT)
            out, errors = process.communicate(timeout=60)
        self.assertEqual((process.returncode, errors), (130, ""))
        self.assertEqual(json.loads(out.splitlines()[-1])["steps"], 2)

    def test_a_follower_survives_a_rotation(self):
        for way in ("moved", "replaced"):
            self.log.unlink(missing_ok=True)
            self.replay(HEADER + simplex("a"))
            with self.followed() as process:
                self.assertEqual(self.next_step(process), 1)
                if way == "moved":
                    self.log.rename(self.folder / "log.1")
                    self.assertEqual(self.replay(HEADER + steps(0, 2)).returncode, 0)
                else:
                    self.assertEqual(self.replay(HEADER + steps(0, 2), "--overwrite").returncode, 0)
                summary = json.loads(process.stdout.readline())
                self.assertEqual((summary.get("summary"), summary["steps"]), (True, 1))
                self.assertEqual([self.next_step(process), self.next_step(process)], [1, 2])
                process.send_signal(signal.SIGINT)
                _, errors = process.communicate(timeout=60)
            self.assertIn("another log has this name now", errors)

    def test_a_follower_never_passes_over_damage(self):
        self.replay(HEADER + simplex("a"))
        with self.followed() as process:
            self.assertEqual(self.next_step(process), 1)
            with open(self.log, "ab") as log:
                log.write(b'{"op":"note","text":"x","seq":2,"xxh3":"0123456789abcdef"}\n')
            _, errors = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 2)
        self.assertIn("its checksum does not fit", errors)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
