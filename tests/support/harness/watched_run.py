# SPDX-License-Identifier: BSD-2-Clause
"""Runs of the program that a test watches by their events, and kills."""
import json
import os
import signal
import subprocess
import time
from pathlib import Path


class WatchedRun:
    """A run of the program in a folder of its own, with its events. `command` starts the program on
    some ranks; `options` are its options."""

    def __init__(self, folder, command, options):
        self.folder, self.log = Path(folder), Path(f"{folder}.jsonl")
        self.output = Path(f"{folder}.log")
        self.log.unlink(missing_ok=True)
        words = [*command, *options, "-report_dir", folder, "-log_json", self.log]
        with open(self.output, "w") as output:
            self.process = subprocess.Popen(
                [str(word) for word in words], stdout=output, stderr=subprocess.STDOUT
            )

    def events(self):
        lines = self.log.read_text().split("\n")[:-1] if self.log.exists() else []
        return [json.loads(line) for line in lines]

    def wait_for(self, wanted, seconds=60):
        """Returns once an event is as wanted."""
        end = time.monotonic() + seconds
        while time.monotonic() < end and self.process.poll() is None:
            if any(wanted(event) for event in self.events()):
                return
            time.sleep(0.002)
        raise AssertionError(f"the event did not come: {self.text()}")

    def kill_ranks(self):
        """Kills the ranks outright, as a machine does that has no memory left."""
        children = subprocess.run(
            ["pgrep", "-P", str(self.process.pid)], capture_output=True, text=True
        ).stdout.split()
        for child in children:
            try:
                os.kill(int(child), signal.SIGKILL)
            except ProcessLookupError:
                pass

    def finish(self, seconds=300):
        """Returns the exit code."""
        return self.process.wait(seconds)

    def finish_well(self):
        """Returns the run itself, which must succeed."""
        if self.finish() != 0:
            raise AssertionError(self.text())
        return self

    def text(self):
        return self.output.read_text()

    def stages(self):
        return {event["stage"] for event in self.events() if event["event"] == "stage_end"}
