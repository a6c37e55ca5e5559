"""Ctrl-C stops long calls and the command."""

import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

from asperity.noise import Fbm, SparseConvolution


@pytest.fixture(autouse=True)
def interrupts():
    """Background jobs of a shell ignore SIGINT, and so do their children."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.parametrize("threads", [1, None])
def test_keyboard_interrupt_stops_an_array_call(threads):
    field = Fbm(SparseConvolution(1, impulses=4), octaves=16)
    main = threading.main_thread().ident
    timer = threading.Timer(0.3, signal.pthread_kill, (main, signal.SIGINT))
    started = time.monotonic()
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        field.grid((4096, 4096, 8), 0.01, threads=threads)
    # The whole call takes hours.
    assert time.monotonic() - started < 30


def test_other_threads_run_during_a_call():
    field, ticks, done = Fbm(SparseConvolution(1), octaves=8), [0], threading.Event()

    def tick():
        while not done.is_set():
            ticks[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    points = np.random.default_rng(1).uniform(size=(400_000, 3)).astype(np.float32)
    before = ticks[0]
    field(points, threads=1)
    during = ticks[0] - before
    done.set()
    thread.join()
    assert during > 20


def test_keyboard_interrupt_stops_the_command(tmp_path):
    words = ["bake", "--noise", "sparse", "--size", "16384", "--octaves", "16", "--out", str(tmp_path)]
    command = subprocess.Popen(
        [sys.executable, "-m", "asperity", *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    time.sleep(3)
    command.send_signal(signal.SIGINT)
    _, errors = command.communicate(timeout=120)
    assert command.returncode == 1
    assert errors.startswith("error: interrupted: ") and errors.count("\n") == 1, errors


def test_pool_works_in_a_child_of_fork():
    import os

    field = Fbm(SparseConvolution(1), octaves=2)
    points = np.zeros((50_000, 2), np.float32)
    field(points)
    child = os.fork()
    if child == 0:
        field(points)
        os._exit(7)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 7
